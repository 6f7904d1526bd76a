/* The $title; see steps.h. */
#include "steps.h"

#include "state.h"

/* A memory for an estimate that is neither this one nor the one kept for k. */
static int unused(int here, int kept)
{
    int slot = 0;
    while (slot == here || slot == kept) {
        slot++;
    }
    return slot;
}

void filter_start(real x[$n], real P[$n][$n])
{
    for (int i = 0; i < $n; i++) {
        filter_x[0][i] = x[i];
        for (int j = 0; j < $n; j++) {
            filter_P[0][i][j] = P[i][j];
        }
    }
    filter.j = 0;
    filter.now = 0;
    filter.reference = 0;
}

const real *filter_state(void)
{
    return filter_x[filter.now];
}

