/* The $title; see steps.h. */
#include "steps.h"

#include "state.h"

$functions
