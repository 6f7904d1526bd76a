/* Prints the last state of the record where the second measurement is lost, or the first correction is late. */
#include <stdio.h>

#include "record.h"
#include "tasks.h"

static int step;
static unsigned events;

static void hr(int last)
{
    while (step < last) {
        events |= hr_step(record_u[step]);
        step++;
    }
}

int main(void)
{
    (void)record_x;
    tasks_start(record_x0, record_P0);
    (void)lr_receive();
#ifdef LATE
    hr(CYCLE_STEPS + 1);
    lr_measure(record_y[0]);
#else
    hr(DELAY_STEPS);
    lr_measure(record_y[0]);
    hr(CYCLE_STEPS);
    (void)lr_receive();
    lr_lost();
#endif
    hr(2 * CYCLE_STEPS);
    const int k = lr_receive();
    hr(k + DELAY_STEPS);
    lr_measure(record_y[k / CYCLE_STEPS]);
    hr(RECORD_STEPS);
    printf("%d\n", (events & HR_SKIPPED) != 0u);
    for (int i = 0; i < STATES; i++) {
        printf("%a\n", (double)hr_state()[i]);
    }
    return 0;
}
