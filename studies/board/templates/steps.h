/* The $title, one HR step at a time. $behaviour

   N = $N: a measurement is taken at k = 0, N, 2N, ...; M = $M: it arrives at m = k + M, and is used there. */
#ifndef STEPS_H
#define STEPS_H

#include "filter.h"

enum { STATES = $n, INPUTS = $m, MEASUREMENTS = $p, CYCLE_STEPS = $N, DELAY_STEPS = $M };

/* x (n,) and its covariance P (n, n) at step 0, whose measurement is to be taken. */
void filter_start(real x[$n], real P[$n][$n]);

/* The estimate one step later${u_doc}. */
void filter_step($u_parameter);

/* In step m, after filter_step: the measurement y of step k = m - M. Left out where it is lost. */
void filter_measure(real y[$p]);

/* The estimate, until the next call. */
const real *filter_state(void);

#endif
