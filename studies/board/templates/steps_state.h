/* All memory of the filter: for steps.c alone. */
#ifndef STATE_H
#define STATE_H

#include <stddef.h>

#include "filter.h"

$memory

/* Which of the memories for an estimate; the same where there are only two. */
static struct {
    int j; /* steps since the start */
    int now;
    int reference; /* of k */$more
} filter;

#endif
