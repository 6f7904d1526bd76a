/* All memory of the filter: for tasks.c alone. */
#ifndef STATE_H
#define STATE_H

#include <stddef.h>

#include "filter.h"

$memory

enum { NONE = -1 };

/* x, slot: which of the memories above; of a slot NONE for a transition that hr_restart has begun. */
static struct {
    int j; /* steps since the start */
    int k; /* the last at which a message was sent */
    int x;
    int slot;
    $Transition transition; /* over the steps from k to j */
} hr;

static struct {
    int prior;     /* P_{k^-} */
    int posterior; /* P_{k^+} */
} lr;

/* From HR to LR at k. */
static struct {
    int k;
    int x;
    int slot;
    $Transition transition; /* over the steps from the last k, or from the one before if that was skipped */
} message;

/* FREE: nothing is on its way. SENT, by HR: the message is LR's. READY, by LR: so is the correction, for HR. */
enum { FREE, SENT, READY };
static volatile int stage;

#endif
