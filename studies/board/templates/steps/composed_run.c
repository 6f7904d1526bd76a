/* The filter on the record. */
static void steps_test(void)
{
    filter_start(record_x0, record_P0);
    begin("steps");
    for (int j = 0; j <= RECORD_STEPS; j++) {
        if (j > 0) {
            filter_step($u);
        }
$measured        filter_update();
        compare(filter_state(), record_x[j], STATES);
    }
    end();
}

