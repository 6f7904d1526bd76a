enum { REFERENCES = $references }; /* steps k from one to its m */

/* x_{k^-} and P_{k^-}, until the measurement of k is there. */
static void keep_reference(int k)
{
    const int slot = k / CYCLE_STEPS % REFERENCES;
    for (int i = 0; i < $n; i++) {
        filter_x_at_k[slot][i] = filter_x[filter.now][i];
        for (int j = 0; j < $n; j++) {
            filter_P_at_k[slot][i][j] = filter_P[filter.now][i][j];
        }
    }
}

/* From j to j + 1, with the input u of step j. */
static void propagate_on(int j$and_u_parameter)
{
    const int next = 1 - filter.now;
    const $Estimate before = {filter_x[filter.now], filter_P[filter.now]};
    const $Estimate after = {filter_x[next], filter_P[next]};
${unused_u}    (void)$propagate;
    filter.now = next;
    if ((j + 1) % CYCLE_STEPS == 0) {
        keep_reference(j + 1);
    }
}

$head
void filter_step($u_parameter)
{
${keep_u}    propagate_on(filter.j$and_u);
    filter.j++;
}

void filter_measure(real y[$p])
{
    const int k = filter.j - DELAY_STEPS;
    const int slot = k / CYCLE_STEPS % REFERENCES;
    const int next = 1 - filter.now;
    const $Estimate reference = {filter_x_at_k[slot], filter_P_at_k[slot]};
    const $Estimate after = {filter_x[next], filter_P[next]};
    $update;
    filter.now = next;
    for (int i = k; i < filter.j; i++) {
        propagate_on(i$and_kept_u);
    }
}
