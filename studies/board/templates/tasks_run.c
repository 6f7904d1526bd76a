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
        if (j % CYCLE_STEPS == 0) {
            (void)lr_receive();
        }
        if (j % CYCLE_STEPS == DELAY_STEPS && j / CYCLE_STEPS < RECORD_MEASURED) {
            lr_measure(record_y[j / CYCLE_STEPS]);
        }
    }
    end();
}

