/* The two tasks as threads, on the record: an example for POSIX, and a check that it runs.

   cc -std=c99 -O2 -ffp-contract=off filter.c tasks.c posix.c -lm -lpthread

   HR runs in each period of PERIOD_US; LR waits until it is told of a k, and until the measurement arrives. Where both
   are given real-time priorities (SCHED_FIFO, HR above LR) this is the schedule that `sched-sim simulate` simulates. Ends
   with status 0 if all states are Python's but for TOLERANCE, in units of the last place of the largest; without the
   priorities a busy machine may keep LR from its processor, and corrections land later than those of Python. */
#define _POSIX_C_SOURCE 200809L

#include <float.h>
#include <math.h>
#include <pthread.h>
#include <semaphore.h>
#include <stdbool.h>
#include <stdio.h>
#include <time.h>

#include "record.h"
#include "tasks.h"

#ifndef PERIOD_US
#define PERIOD_US 2000
#endif

#ifndef TOLERANCE
#define TOLERANCE $tolerance
#endif

static sem_t sent;    /* by HR at k */
static sem_t arrived; /* the measurement, at m */
static int landed;
static double off;
static double largest;

static void *hr_thread(void *unused)
{
    struct timespec next;
$awaited    (void)unused;
    (void)clock_gettime(CLOCK_MONOTONIC, &next);
    for (int j = 0; j <= RECORD_STEPS; j++) {
        if (j > 0) {
            const unsigned events = hr_step($u);
            if ((events & HR_SENT) != 0u) {
                (void)sem_post(&sent);
$await            }
            landed += (events & HR_LANDED) != 0u;
        }
        for (int i = 0; i < STATES; i++) {
            const double found = (double)hr_state()[i];
            const double expected = (double)record_x[j][i];
            off = isfinite(found) ? fmax(off, fabs(found - expected)) : (double)INFINITY;
            largest = fmax(largest, fabs(expected));
        }
        if ($arrives) {
$arrived            (void)sem_post(&arrived);
        }
        next.tv_nsec += PERIOD_US * 1000L;
        while (next.tv_nsec >= 1000000000L) {
            next.tv_nsec -= 1000000000L;
            next.tv_sec++;
        }
        (void)clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, NULL);
    }
    return NULL;
}

static void *lr_thread(void *unused)
{
    (void)unused;
    for (;;) {
        (void)sem_wait(&sent);
        const int k = lr_receive();
        (void)sem_wait(&arrived);
        if (k / CYCLE_STEPS < RECORD_MEASURED) {
            lr_measure(record_y[k / CYCLE_STEPS]);
        } else {
            lr_lost();
        }
    }
    return NULL;
}

int main(void)
{
    pthread_t hr;
    pthread_t lr;
    tasks_start(record_x0, record_P0);
    if (sem_init(&sent, 0, 1u) != 0 || sem_init(&arrived, 0, 0u) != 0 || /* step 0 is a k */
        pthread_create(&lr, NULL, lr_thread, NULL) != 0 || pthread_create(&hr, NULL, hr_thread, NULL) != 0) {
        return 2;
    }
    (void)pthread_join(hr, NULL);
    const double most = TOLERANCE * (sizeof(real) == sizeof(float) ? (double)FLT_EPSILON : DBL_EPSILON) * largest;
    printf("%d of %d corrections have landed; from Python's states off by %g, of at most %g\n", landed, RECORD_MEASURED,
           off, most);
    return off > most;
}
