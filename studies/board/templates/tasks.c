/* The dual rate filter as two tasks; see tasks.h.

   HR may preempt LR anywhere, and on two cores they may run at once: each has a workspace of its own, and whatever LR
   reads of HR's is left alone until the correction has landed. Of the three transitions one is in the message, HR
   alternates between the others; so with the three states. `stage` says whose turn it is with what both share. */
#include "tasks.h"

#include "state.h"

/* Nothing is read or written across it, by the compiler or by the core. */
#ifndef FENCE
#define FENCE() __sync_synchronize()
#endif

/* The first memory of three that neither is in use here nor in the message. */
static int unused(int here, int in_message)
{
    int slot = 0;
    while (slot == here || slot == in_message) {
        slot++;
    }
    return slot;
}

/* Eq. (19), at l: the message is HR's again. */
static void hr_land(void)
{
    const int corrected = unused(hr.x, message.x);
    $hr_update;
    hr.x = corrected;
    FENCE();
    stage = FREE;
}

/* At k: x_{k^-}, and Phi and Q over the steps since the last message. */
static void hr_send(void)
{
    hr.k = hr.j;
    message.k = hr.j;
    message.x = hr.x;
    message.slot = hr.slot;
    message.transition = hr.transition;
    FENCE();
    stage = SENT;
}

void tasks_start(real x[$n], real P[$n][$n])
{
    for (int i = 0; i < $n; i++) {
        hr_x[0][i] = x[i];
        for (int j = 0; j < $n; j++) {
            lr_P[0][i][j] = P[i][j];
        }
    }
    hr.j = 0;
    hr.x = 0;
    hr.slot = NONE;
    lr.prior = 0;
    lr.posterior = 1;
    hr_send();
}

unsigned hr_step($u_parameter)
{
${unused_u}    unsigned events = 0u;
    const int x_next = unused(hr.x, message.x);
    if (hr.j == hr.k) { /* step k + 1: Phi and Q start anew */
        hr.transition = $hr_restart;
        hr.slot = NONE;
    } else {
        const int slot = unused(hr.slot, message.slot);
        const $Transition following = {hr_Phi[slot], hr_Q[slot]};
        hr.transition = $hr_propagate;
        hr.slot = slot;
    }
    hr.x = x_next;
    hr.j++;
    if (stage == READY && hr.j - hr.k >= LANDING_STEPS) {
        FENCE();
        hr_land();
        events |= HR_LANDED;
    }
    if (hr.j % CYCLE_STEPS == 0) {
        if (stage == FREE) {
            FENCE();
            hr_send();
            events |= HR_SENT;
        } else {
            events |= HR_SKIPPED;
        }
    }
    return events;
}

const real *hr_state(void)
{
    return hr_x[hr.x];
}

int lr_receive(void)
{
    FENCE();
    if (message.slot != NONE) { /* not at step 0, where P is P_{k^-} */
        lr.prior = 1 - lr.posterior;
        $lr_propagate;
    }
$at_k    return message.k;
}

void lr_measure(real y[$p])
{
    const $Estimate reference = {hr_x[message.x], lr_P[lr.prior]};
$at_m    $lr_update;
    FENCE();
    stage = READY;
}

void lr_lost(void)
{
    lr.posterior = lr.prior; /* P_{k^+} is P_{k^-} */
    FENCE();
    stage = FREE;
}
