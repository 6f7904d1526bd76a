/* Whole runs in which HR preempts LR: where a function begins or ends within a job of LR, HR does the steps that it can.

   filter.c and tasks.c are compiled with -finstrument-functions. Of each place in the jobs and each way to spread the
   HR steps between k and l over them a run is done, and all states compared with those of record.h to the bit. */
#include <stdio.h>
#include <string.h>

#include "record.h"
#include "tasks.h"

static real states[RECORD_STEPS + 1][STATES];
static int step, until, entry, entries, most, in_job;
static unsigned events;

static void __attribute__((no_instrument_function)) hr(int last)
{
    while (step < last && step < RECORD_STEPS) {
        const int outer = in_job;
        in_job = 0;
        events |= hr_step(record_u[step]);
        step++;
        memcpy(states[step], hr_state(), sizeof states[step]);
        in_job = outer;
    }
}

void __attribute__((no_instrument_function)) __cyg_profile_func_enter(void *function, void *site);
void __attribute__((no_instrument_function)) __cyg_profile_func_exit(void *function, void *site);

void __cyg_profile_func_enter(void *function, void *site)
{
    (void)function;
    (void)site;
    if (in_job) {
        most = entries >= most ? entries + 1 : most;
        if (entries++ == entry) {
            hr(until);
        }
    }
}

void __cyg_profile_func_exit(void *function, void *site)
{
    __cyg_profile_func_enter(function, site);
}

/* One run; the HR steps up to `before` of each cycle are done in the first job, at that entry, others in the second. */
static void run(int before)
{
    memset(states, 0, sizeof states);
    step = 0;
    tasks_start(record_x0, record_P0);
    memcpy(states[0], hr_state(), sizeof states[0]);
    for (int cycle = 0; cycle < RECORD_MEASURED; cycle++) {
        const int k = cycle * CYCLE_STEPS;
        hr(k);
        entries = 0;
        until = k + before;
        in_job = 1;
        (void)lr_receive();
        in_job = 0;
        hr(k + DELAY_STEPS);
        if (step < k + DELAY_STEPS) {
            break;
        }
        entries = 0;
        until = k + LANDING_STEPS - 1;
        in_job = 1;
        lr_measure(record_y[cycle]);
        in_job = 0;
    }
    hr(RECORD_STEPS);
}

int main(void)
{
    int wrong = 0;
    for (entry = 0; entry == 0 || entry < most; entry++) {
        for (int before = 0; before < LANDING_STEPS; before++) {
            run(before);
            wrong += memcmp(states, record_x, sizeof states) != 0;
        }
    }
    printf("%d places, %d wrong, %s\n", most, wrong, (events & HR_SKIPPED) ? "skipped" : "none skipped");
    return wrong != 0;
}
