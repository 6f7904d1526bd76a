/* The two tasks of the dual rate filter as SCHED_FIFO threads on one core, each job done again until it has had its CPU
   time; and what ran when, as CSV.

   cc -std=gnu11 -O2 -ffp-contract=off filter.c live.c -lm -lpthread -o live
   ./live CPU PERIOD_NS CYCLES HR_PRIORITY LR_PRIORITY NS NS NS NS NS < record > jobs.csv

   The NS are the CPU times of hr_restart, hr_propagate, hr_update, lr_propagate and lr_update. The record is of doubles:
   the inputs of all steps, then the measurements of all cycles. Without real-time priorities it ends with status 3. */
#define _GNU_SOURCE

#include <errno.h>
#include <pthread.h>
#include <sched.h>
#include <semaphore.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include "filter.h"

enum { HR_RESTART, HR_PROPAGATE, HR_UPDATE, LR_PROPAGATE, LR_UPDATE, KINDS };

static bool goes_on(int kind);

/* Each job of tasks.c, for as long as it is to take. All that it reads it leaves as it was. */
#define FOR_ITS_TIME(kind, call) do { call; } while (goes_on(kind))
#define RETURNED_FOR_ITS_TIME(kind, call) \
    ({ __typeof__(call) returned; FOR_ITS_TIME(kind, returned = call); returned; })
#define hr_restart(...) RETURNED_FOR_ITS_TIME(HR_RESTART, hr_restart(__VA_ARGS__))
#define hr_propagate(...) RETURNED_FOR_ITS_TIME(HR_PROPAGATE, hr_propagate(__VA_ARGS__))
#define hr_update(...) FOR_ITS_TIME(HR_UPDATE, hr_update(__VA_ARGS__))
#define lr_propagate(...) FOR_ITS_TIME(LR_PROPAGATE, lr_propagate(__VA_ARGS__))
#define lr_update(...) FOR_ITS_TIME(LR_UPDATE, lr_update(__VA_ARGS__))
#include "record.h"
#include "tasks.c"

#ifdef WITHOUT_INPUTS
#define STEP(j) hr_step()
#else
#define STEP(j) hr_step(inputs[(j) - 1])
#endif
enum { LEAD_NS = 20000000, STARVED = 3 };

typedef struct {
    int kind;
    int step;
    int64_t start;
    int64_t end;
    int64_t cpu;
} Job;

typedef struct {
    Job *jobs;
    int count;
} Log;

static const char *const names[KINDS] = {"hr_restart", "hr_propagate", "hr_update", "lr_propagate", "lr_update"};
static int64_t wanted[KINDS]; /* CPU time of each job, ns */
static Log hr_log, lr_log;
static _Thread_local Log *of_thread; /* none: each job is done once */
static _Thread_local Job this;       /* step, start and CPU time of the thread then */

static int64_t period, origin;
static int core;
static int64_t idle; /* of the core in all steps, ns */
static int steps;
static real (*inputs)[INPUTS > 0 ? INPUTS : 1];
static real (*measurements)[MEASUREMENTS];
static real (*states)[STATES];
static unsigned *events; /* by step */
static int message_k;    /* of the message that LR has */
static bool over;
static sem_t sent, arrived;
static pthread_barrier_t both_are_there;

static int64_t now(clockid_t clock)
{
    struct timespec at;
    (void)clock_gettime(clock, &at);
    return at.tv_sec * INT64_C(1000000000) + at.tv_nsec;
}

static void begins(int step)
{
    this.step = step;
    this.start = now(CLOCK_MONOTONIC);
    this.cpu = now(CLOCK_THREAD_CPUTIME_ID);
}

/* Whether the job has CPU time left; if not, it is over, and the next of the thread begins. */
static bool goes_on(int kind)
{
    if (of_thread == NULL) {
        return false;
    }
    const int64_t cpu = now(CLOCK_THREAD_CPUTIME_ID);
    if (cpu - this.cpu < wanted[kind]) {
        return true;
    }
    const int64_t end = now(CLOCK_MONOTONIC);
    of_thread->jobs[of_thread->count++] = (Job){kind, this.step, this.start, end, cpu - this.cpu};
    this.start = end;
    this.cpu = cpu;
    return false;
}

static void sleep_until(int64_t instant)
{
    const struct timespec at = {instant / INT64_C(1000000000), instant % INT64_C(1000000000)};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, NULL) == EINTR) {
    }
}

/* For how long the core has had nothing to do since the machine was started, ns, as /proc/stat has it in ticks. */
static int64_t idle_so_far(void)
{
    char line[256];
    long long idle = 0;
    FILE *const file = fopen("/proc/stat", "r");
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        int number;
        long long waits, ticks;
        if (sscanf(line, "cpu%d %*s %*s %*s %lld %lld", &number, &ticks, &waits) == 3 && number == core) {
            idle = ticks + waits;
        }
    }
    if (file != NULL) {
        (void)fclose(file);
    }
    return idle * (INT64_C(1000000000) / sysconf(_SC_CLK_TCK));
}

static void *hr_thread(void *unused)
{
    (void)unused;
    of_thread = &hr_log;
    (void)pthread_barrier_wait(&both_are_there);
    origin = now(CLOCK_MONOTONIC) + LEAD_NS;
    sleep_until(origin);
    idle = -idle_so_far();
    for (int j = 1; j <= steps; j++) {
        sleep_until(origin + j * period);
        begins(j);
        if (j == message_k + DELAY_STEPS) {
            (void)sem_post(&arrived);
        }
        events[j] = STEP(j);
        memcpy(states[j], hr_state(), sizeof states[j]);
        if ((events[j] & HR_SENT) != 0u && j < steps) {
            message_k = j;
            (void)sem_post(&sent);
            if (DELAY_STEPS == 0) {
                (void)sem_post(&arrived);
            }
        }
    }
    idle += idle_so_far();
    over = true;
    (void)sem_post(&sent);
    (void)sem_post(&arrived);
    return NULL;
}

static void *lr_thread(void *unused)
{
    (void)unused;
    of_thread = &lr_log;
    (void)pthread_barrier_wait(&both_are_there);
    for (;;) {
        (void)sem_wait(&sent);
        if (over) {
            return NULL;
        }
        begins(message_k);
        const int k = lr_receive();
        (void)sem_wait(&arrived);
        if (over) {
            return NULL;
        }
        begins(k);
        lr_measure(measurements[k / CYCLE_STEPS]);
    }
}

/* The same steps by one thread, each correction ready for the step in which it has landed. How many states differ. */
static int differing(void)
{
    int differ = 0;
    tasks_start(record_x0, record_P0);
    for (int j = 1; j <= steps; j++) {
        if ((events[j] & HR_LANDED) != 0u) {
            const int k = lr_receive();
            lr_measure(measurements[k / CYCLE_STEPS]);
        }
        (void)STEP(j);
        differ += memcmp(states[j], hr_state(), sizeof states[j]) != 0;
    }
    return differ;
}

static pthread_t started(void *(*run)(void *), int priority, int cpu)
{
    const struct sched_param parameter = {.sched_priority = priority};
    pthread_attr_t how;
    pthread_t thread;
    cpu_set_t cpus;
    CPU_ZERO(&cpus);
    CPU_SET(cpu, &cpus);
    (void)pthread_attr_init(&how);
    (void)pthread_attr_setaffinity_np(&how, sizeof cpus, &cpus);
    (void)pthread_attr_setinheritsched(&how, PTHREAD_EXPLICIT_SCHED);
    (void)pthread_attr_setschedpolicy(&how, SCHED_FIFO);
    (void)pthread_attr_setschedparam(&how, &parameter);
    const int error = pthread_create(&thread, &how, run, NULL);
    if (error != 0) {
        fprintf(stderr, "%s\n", strerror(error));
        exit(STARVED);
    }
    return thread;
}

static void *room(size_t count, size_t size)
{
    void *const memory = calloc(count + 1, size);
    if (memory == NULL) {
        fprintf(stderr, "out of memory\n");
        exit(1);
    }
    return memory;
}

static void read_record(real *to, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double number;
        if (fread(&number, sizeof number, 1, stdin) != 1) {
            fprintf(stderr, "the record is too short\n");
            exit(1);
        }
        to[i] = (real)number;
    }
}

static void print_log(const Log *log)
{
    for (int i = 0; i < log->count; i++) {
        const Job *const job = &log->jobs[i];
        printf("%s,%d,%lld,%lld,%lld\n", names[job->kind], job->step, (long long)(job->start - origin),
            (long long)(job->end - origin), (long long)job->cpu);
    }
}

int main(int count, char **values)
{
    if (count != 6 + KINDS) {
        return 2;
    }
    const int cycles = atoi(values[3]), hr_priority = atoi(values[4]);
    const int lr_priority = atoi(values[5]);
    core = atoi(values[1]);
    period = atoll(values[2]);
    for (int kind = 0; kind < KINDS; kind++) {
        wanted[kind] = atoll(values[6 + kind]);
    }
    steps = cycles * CYCLE_STEPS;
    inputs = room((size_t)steps, sizeof *inputs);
    measurements = room((size_t)cycles, sizeof *measurements);
    states = room((size_t)steps, sizeof *states);
    events = room((size_t)steps, sizeof *events);
    hr_log.jobs = room(2 * (size_t)steps, sizeof(Job));
    lr_log.jobs = room(2 * (size_t)cycles, sizeof(Job));
    read_record(inputs[0], (size_t)steps * INPUTS);
    read_record(measurements[0], (size_t)cycles * MEASUREMENTS);
    (void)mlockall(MCL_CURRENT | MCL_FUTURE);
    tasks_start(record_x0, record_P0);
    (void)sem_init(&sent, 0, 1u); /* step 0 is a k */
    (void)sem_init(&arrived, 0, DELAY_STEPS == 0);
    (void)pthread_barrier_init(&both_are_there, NULL, 2u);
    const pthread_t lr = started(lr_thread, lr_priority, core);
    const pthread_t hr = started(hr_thread, hr_priority, core);
    (void)pthread_join(hr, NULL);
    (void)pthread_join(lr, NULL);
    printf("kind,step,start_ns,end_ns,cpu_ns\n");
    print_log(&hr_log);
    print_log(&lr_log);
    printf("idle,%lld\n", (long long)idle);
    printf("differing,%d\n", differing());
    return 0;
}
