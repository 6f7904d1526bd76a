/* The composed filter, one step at a time. A late measurement is used in the step in which it was taken, and all steps
   since are done again.

   In each step, step 0 too: filter_step (not in step 0), then a filter_measure_... for each measurement that has
   arrived, then filter_update. */
#ifndef STEPS_H
#define STEPS_H

#include "filter.h"

enum { STATES = $numbers, INPUTS = $m, HISTORY_STEPS = $depth };

/* x ($numbers,) and the covariance P ($n, $n) of its error at step 0, before its measurements. */
void filter_start(real x[$numbers], real P[$n][$n]);

/* The next step begins${u_doc}. */
void filter_step($u_parameter);

/* A measurement that was taken in the step `taken`, at most HISTORY_STEPS ago; one of each sensor and step. */
$measures

/* All measurements that arrive in this step are in: the estimate. */
void filter_update(void);

/* The estimate, until the next call. */
const real *filter_state(void);

#endif
