/* All memory of the filter: for tasks.c alone. */
#ifndef STATE_H
#define STATE_H

#include <stddef.h>

#include "filter.h"

$memory

/* x, slot: which of two in memory. */
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

/* With each message from HR to LR. */
static bool message_begins[SLOTS];     /* the first one, without a transition */
static int message_k[SLOTS];
static unsigned message_landed[SLOTS]; /* how many corrections x_{k^-} has */

/* How many messages HR has sent, and of how many the corrections are ready, by LR, and landed, by HR. */
static volatile unsigned sent;
static volatile unsigned ready;
static volatile unsigned landed;

#endif
