/* The $title, one HR step at a time. $behaviour

   $when */
#ifndef STEPS_H
#define STEPS_H

#include "filter.h"

enum { STATES = $n, INPUTS = $m, MEASUREMENTS = $p, CYCLE_STEPS = $N$more_steps };

/* x (n,) and its covariance P (n, n) at step 0${before_its_measurement}. */
void filter_start(real x[$n], real P[$n][$n]);

/* The estimate one step later${u_doc}. */
void filter_step($u_parameter);

$take$measure_doc
void filter_measure(real y[$p]);

/* The estimate, until the next call. */
const real *filter_state(void);

#endif
