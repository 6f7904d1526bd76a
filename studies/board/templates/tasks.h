/* The dual rate filter as two tasks for an RTOS (Steffes 2014, Fig. 2).

   The high-rate task (HR) calls hr_step once in each period. The low-rate task (LR), whose priority is lower,
   calls lr_receive when hr_step has returned HR_SENT, and lr_measure when the measurement of that step has
   arrived. Nobody waits for anybody within these functions.

   N = $N, M = $M, L = $L: a measurement is taken at k = 0, N, 2N, ...; it arrives at m = k + M. The correction
   lands at l = k + L or, if LR has not finished by then, in the first step after it has.
$late */
#ifndef TASKS_H
#define TASKS_H

#include "filter.h"

enum { STATES = $n, INPUTS = $m, MEASUREMENTS = $p, CYCLE_STEPS = $N, DELAY_STEPS = $M, LANDING_STEPS = $L$more_steps };

/* What hr_step returns, added up. */
#define HR_SENT 1u    /* this step is a k: LR has a message, and its measurement is to be taken */
#define HR_LANDED 2u  /* the correction is in the state */
#define HR_SKIPPED 4u /* this step is a k, but the correction before is not in yet: the measurement is left out */

/* Before both tasks: x (n,) and its covariance P (n, n) at step 0, whose measurement is to be taken. */
void tasks_start(real x[$n], real P[$n][$n]);

/* HR: the state one step later${u_doc}. */
unsigned hr_step($u_parameter);

/* HR: the estimate, until the next hr_step. */
const real *hr_state(void);

/* LR, at k: P_{k^-} from the message. Returns k. */
int lr_receive(void);

/* LR, from m on: the measurement y of k, from which HR gets the correction. */
void lr_measure(real y[$p]);

/* LR, in place of lr_measure: the measurement of k is lost. */
void lr_lost(void);

#endif
