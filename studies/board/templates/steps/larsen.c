/* A memory for an estimate that is neither this one nor the one kept for k. */
static int unused(int here, int kept)
{
    int slot = 0;
    while (slot == here || slot == kept) {
        slot++;
    }
    return slot;
}

$head
void filter_step($u_parameter)
{
    const int since_k = filter.j % CYCLE_STEPS;
    if (since_k == 0) {
        filter.reference = filter.now; /* x_{k^-} and P_{k^-}, kept until m */
    }
    const int next = unused(filter.now, filter.reference);
    const $Estimate before = {filter_x[filter.now], filter_P[filter.now]};
    const $Estimate after = {filter_x[next], filter_P[next]};
${unused_u}    if (since_k == 0) {
        filter.Phi = $propagate; /* (15) */
    } else if (since_k < DELAY_STEPS) {
        filter.slot = 1 - filter.slot;
        $propagate_accumulate;
        filter.Phi = filter_Phi[filter.slot];
    } else {
        (void)$propagate;
    }
    filter.now = next;
    filter.j++;
}

void filter_measure(real y[$p])
{
    const int next = unused(filter.now, filter.reference);
    const $Estimate reference = {filter_x[filter.reference], filter_P[filter.reference]};
    const $Estimate before = {filter_x[filter.now], filter_P[filter.now]};
    const $Estimate after = {filter_x[next], filter_P[next]};
    $update;
    filter.now = next;
}
