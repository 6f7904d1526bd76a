/* Whether the jobs give the numbers that Python gave. Ends with status 0 if they do.

   cc -std=c99 -O2 -ffp-contract=off $sources -lm

   The bits are the same where the compiler fuses no multiplication with an addition (-ffp-contract=off) and the model
   calls no sin or cos, which differ between C libraries. TOLERANCE: how far a number may be off, in units of the last
   place of the largest number of its array; with -DTOLERANCE=0 the bits must be the same.

   With CYCLES, an expression that reads a counter of 32 bits, and CLOCK_HZ, its rate, each job is timed too, and a cost
   table printed for `sched-sim`. CORTEX_M is CYCLES by the counter of the DWT that most Cortex-M have, at the rate of
   your core: -DCORTEX_M -DCLOCK_HZ=$clock_hz */
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "filter.h"$includes

#ifdef CORTEX_M
#define CYCLES (*(volatile uint32_t *)0xE0001004u)
#endif

#ifndef TOLERANCE
#define TOLERANCE $tolerance
#endif

static const double resolution = sizeof(real) == sizeof(float) ? (double)FLT_EPSILON : DBL_EPSILON;
static double most;
static int failed;

static void begin(const char *name)
{
    printf("# %-24s", name);
    most = 0.0;
}

/* Of two arrays of so many numbers. What is not finite must be so in both. */
static void compare(const real *found, const real *expected, int size)
{
    double largest = 0.0;
    double off = 0.0;
    for (int i = 0; i < size; i++) {
        const double a = (double)found[i];
        const double b = (double)expected[i];
        if (!isfinite(a) || !isfinite(b)) {
            off = (isnan(a) && isnan(b)) || a == b ? off : (double)INFINITY;
        } else {
            largest = fmax(largest, fabs(b));
            off = fmax(off, fabs(a - b));
        }
    }
    most = fmax(most, off > 0.0 ? off / (resolution * largest) : 0.0);
}

static void end(void)
{
    if (most == 0.0) {
        printf("the same bits\n");
    } else {
        printf("off by %.1f in the last place, of at most %.0f\n", most, (double)(TOLERANCE));
    }
    failed += most > (double)(TOLERANCE);
}

$data

$jobs
$functions#ifdef CYCLES
enum { TIMES = 100 };

static void timed(const char *name, void (*run)(void))
{
    const uint32_t start = (uint32_t)(CYCLES);
    for (int i = 0; i < TIMES; i++) {
        run();
    }
    const uint32_t stop = (uint32_t)(CYCLES);
    printf("$cost\n", name, 1e6 * (double)(stop - start) / (TIMES * (double)(CLOCK_HZ)));
}

/* Whether CYCLES is another number some time later. */
static bool counter_runs(void)
{
    const uint32_t start = (uint32_t)(CYCLES);
    for (volatile uint32_t i = 0u; i < 10000000u; i++) {
        if ((uint32_t)(CYCLES) != start) {
            return true;
        }
    }
    return false;
}

static void print_costs(void)
{
#ifdef CORTEX_M
    *(volatile uint32_t *)0xE000EDFCu |= 1uL << 24;  /* DEMCR: the DWT is switched on */
    *(volatile uint32_t *)0xE0001FB0u = 0xC5ACCE55u; /* DWT_LAR: and unlocked, as a Cortex-M7 needs */
    *(volatile uint32_t *)0xE0001000u |= 1uL;        /* DWT_CTRL: the counter runs */
#endif
    if (!counter_runs()) {
        printf("# no costs: the counter that CYCLES reads does not run\n");
        failed++;
        return;
    }
    printf("name = \"board\"\nunit = \"us\"\n$structure\n$costs\n");
$times
}
#endif

int main(void)
{
$calls$run
    printf(failed == 0 ? "# passed\n" : "# FAILED\n");
#ifdef CYCLES
    print_costs();
#endif
    return failed != 0;
}
