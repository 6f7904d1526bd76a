/* All memory of the filter: for steps.c alone. */
#ifndef STATE_H
#define STATE_H

#include <stddef.h>

#include "filter.h"

$memory

static struct {
    int j; /* steps since the start */
$fields} filter;

#endif
