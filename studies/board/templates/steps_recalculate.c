/* From j to j + 1, with the input u of step j. */
static void propagate_on(int j$and_u_parameter)
{
$unused    const int next = unused(filter.now, filter.reference);
    const $Estimate before = {filter_x[filter.now], filter_P[filter.now]};
    const $Estimate after = {filter_x[next], filter_P[next]};
    (void)$propagate;
    filter.now = next;
}

void filter_step($u_parameter)
{
    const int since_k = filter.j % CYCLE_STEPS;
${keep_u}    propagate_on(filter.j$and_u);
    filter.j++;
    if (since_k == CYCLE_STEPS - 1) {
        filter.reference = filter.now; /* x_{k^-} and P_{k^-}, kept until m */
    }
}

void filter_measure(real y[$p])
{
    const int next = unused(filter.now, filter.reference);
    const $Estimate before = {filter_x[filter.reference], filter_P[filter.reference]};
    const $Estimate after = {filter_x[next], filter_P[next]};
    $update;
    filter.now = next;
    for (int i = 0; i < DELAY_STEPS; i++) {
        propagate_on(filter.j - DELAY_STEPS + i$and_kept_u);
    }
}
