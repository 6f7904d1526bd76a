/* Prints the last state of the record where the second measurement is lost. */
#include <stdio.h>

#include "record.h"
#include "steps.h"

#ifdef EACH
static int measured_at(int j)
{
    return j;
}
#else
static int measured_at(int j)
{
    const int k = j - DELAY_STEPS;
    return k >= 0 && k % CYCLE_STEPS == 0 && k / CYCLE_STEPS < RECORD_MEASURED ? k / CYCLE_STEPS : 1;
}
#endif

static void measure(int j)
{
    if (measured_at(j) != 1) {
        filter_measure(record_y[measured_at(j)]);
    }
}

int main(void)
{
    (void)record_x;
    filter_start(record_x0, record_P0);
    for (int j = 0; j <= RECORD_STEPS; j++) {
#ifdef BEFORE
        measure(j);
#endif
        if (j > 0) {
            filter_step(record_u[j - 1]);
        }
#ifndef BEFORE
        measure(j);
#endif
#ifdef TAKES
        if (j % CYCLE_STEPS == 0 && j / CYCLE_STEPS < RECORD_MEASURED && j / CYCLE_STEPS != 1) {
            filter_take();
        }
#endif
    }
    for (int i = 0; i < STATES; i++) {
        printf("%a\n", filter_state()[i]);
    }
    return 0;
}
