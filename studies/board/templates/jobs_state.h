/* Memory for the jobs: the model, which nothing writes to but to its scratch, and each argument once. Of jobs that may
   preempt each other each needs a workspace, and what one reads the other must not write, of its own. */
#ifndef STATE_H
#define STATE_H

#include <stddef.h>

#include "filter.h"

$memory

#endif
