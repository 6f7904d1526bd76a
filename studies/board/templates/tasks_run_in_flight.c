/* The tasks, one after the other, on the record. */
static void tasks_test(void)
{
    tasks_start(record_x0, record_P0);
    begin("tasks");
    for (int j = 0; j <= RECORD_STEPS; j++) {
        if (j > 0) {
            (void)hr_step($u);
        }
        compare(hr_state(), record_x[j], STATES);
        if (j >= DELAY_STEPS && (j - DELAY_STEPS) % CYCLE_STEPS == 0 &&
            (j - DELAY_STEPS) / CYCLE_STEPS < RECORD_MEASURED) {
            const int k = lr_receive();
            lr_measure(record_y[k / CYCLE_STEPS]);
        }
    }
    end();
}

