/* The dual rate filter as two tasks, with several measurements or corrections on their way; see tasks.h.

   HR may preempt LR anywhere, and on two cores they may run at once: each has a workspace of its own. What HR sends at
   the c-th k is in slot c % SLOTS, and what LR makes of it too. Of the three counters each is written by one task:
   sent and landed by HR, ready by LR. A slot is used again when nothing that is on its way needs it. */
#include "tasks.h"

#include "state.h"

/* Nothing is read or written across it, by the compiler or by the core. */
#ifndef FENCE
#define FENCE() __sync_synchronize()
#endif

static void copy_vector(const real from[$n], real to[$n])
{
    for (int i = 0; i < $n; i++) {
        to[i] = from[i];
    }
}

static void copy_matrix(real from[$n][$n], real to[$n][$n])
{
    for (int i = 0; i < $n; i++) {
        copy_vector(from[i], to[i]);
    }
}

/* Eqs. (13), (19), at l: by Phi over each whole cycle since k, and over the steps since the last one. */
static void hr_land(void)
{
    const int corrected = 1 - hr.x;
    int carried = 0;
    copy_vector(lr_delta_x[landed % SLOTS], hr_carried[0]);
    for (unsigned c = landed + 1u; c != sent; c++) {
        const int from = carried;
        carried = 1 - carried;
        $hr_pass;
    }
    $hr_update;
    hr.x = corrected;
    FENCE();
    landed = landed + 1u;
}

/* Whether no measurement on its way needs what is in the slot of the next. */
static bool hr_can_send(void)
{
    const unsigned first = ready;
    const unsigned needed = first == sent ? landed : message_landed[first % SLOTS];
    return sent - needed < SLOTS;
}

/* At k: x_{k^-}, and Phi and Q over the steps since the last message. */
static void hr_send(bool begins)
{
    const unsigned slot = sent % SLOTS;
    copy_vector(hr_x[hr.x], message_x[slot]);
    if (!begins) {
        copy_matrix(hr.transition.Phi, message_Phi[slot]);
        copy_matrix(hr.transition.Q, message_Q[slot]);
    }
    message_begins[slot] = begins;
    message_k[slot] = hr.j;
    message_landed[slot] = landed;
    hr.k = hr.j;
    FENCE();
    sent = sent + 1u;
}

void tasks_start(real x[$n], real P[$n][$n])
{
    copy_vector(x, hr_x[0]);
    copy_matrix(P, lr_P[0]);
    hr.j = 0;
    hr.x = 0;
    hr.slot = 0;
    lr.prior = 0;
    lr.posterior = 1;
    sent = 0u;
    ready = 0u;
    landed = 0u;
    hr_send(true);
}

unsigned hr_step($u_parameter)
{
${unused_u}    unsigned events = 0u;
    const int x_next = 1 - hr.x;
    if (hr.j == hr.k) { /* step k + 1: Phi and Q start anew */
        hr.transition = $hr_restart;
    } else {
        const int slot = 1 - hr.slot;
        const $Transition following = {hr_Phi[slot], hr_Q[slot]};
        hr.transition = $hr_propagate;
        hr.slot = slot;
    }
    hr.x = x_next;
    hr.j++;
    if (ready != landed && hr.j - message_k[landed % SLOTS] >= LANDING_STEPS) {
        FENCE();
        hr_land();
        events |= HR_LANDED;
    }
    if (hr.j % CYCLE_STEPS == 0) {
        if (hr_can_send()) {
            FENCE();
            hr_send(false);
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
    const unsigned slot = ready % SLOTS;
    FENCE();
    if (!message_begins[slot]) { /* not at step 0, where P is P_{k^-} */
        const $Transition transition = {message_Phi[slot], message_Q[slot]};
        lr.prior = 1 - lr.posterior;
        $lr_propagate;
    }
    return message_k[slot];
}

/* x_{k^-} with the corrections that were on their way at k, from cycle to cycle as in Eqs. (13), (19). */
static real *lr_compensated(unsigned slot)
{
    int carried = 0;
    if (message_landed[slot] == ready) {
        return message_x[slot];
    }
    copy_vector(lr_delta_x[message_landed[slot] % SLOTS], lr_carried[0]);
    for (unsigned c = message_landed[slot] + 1u; c != ready + 1u; c++) {
        real *const plus = c == ready ? message_x[slot] : lr_delta_x[c % SLOTS];
        const int from = carried;
        carried = 1 - carried;
        $lr_carry;
    }
    return lr_carried[carried];
}

void lr_measure(real y[$p])
{
    const unsigned slot = ready % SLOTS;
    const $Estimate reference = {lr_compensated(slot), lr_P[lr.prior]};
    const $Correction correction = {lr_z, lr_K, lr_delta_x[slot]};
    lr.posterior = 1 - lr.prior;
    $lr_update;
    FENCE();
    ready = ready + 1u;
}

void lr_lost(void)
{
    const unsigned slot = ready % SLOTS;
    for (int i = 0; i < $n; i++) {
        lr_delta_x[slot][i] = $zero;
    }
    lr.posterior = lr.prior; /* P_{k^+} is P_{k^-} */
    FENCE();
    ready = ready + 1u;
}
