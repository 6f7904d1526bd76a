$head
/* From the i-th step behind k to the next. */
static void predict_on(int k, int i)
{
${unused_k}    $predict;
}

void filter_step($u_parameter)
{
    const int since_k = filter.j % CYCLE_STEPS;
    const int k = filter.j - since_k;
${keep_u}    predict_on(k, since_k);
    filter.j++;
    if (filter.corrected && since_k + 1 == LANDING_STEPS) { /* l: the states since k again */
        for (int i = 0; i < $n; i++) {
            filter_path[0][i] = filter_corrected[i];
        }
        for (int i = 0; i < LANDING_STEPS; i++) {
            predict_on(k, i);
        }
        filter.corrected = false;
    }
    if (since_k + 1 == CYCLE_STEPS) { /* the next k: the covariance along all these states */
        for (int i = 0; i < CYCLE_STEPS; i++) {
            const int P_next = 1 - filter.P;
            const $Estimate before = {filter_path[i], filter_P[filter.P]};
            $propagate_covariance;
            filter.P = P_next;
        }
        for (int i = 0; i < $n; i++) {
            filter_path[0][i] = filter_path[CYCLE_STEPS][i];
        }
    }
}

void filter_measure(real y[$p])
{
    const int P_next = 1 - filter.P;
    const $Estimate reference = {filter_path[0], filter_P[filter.P]};
    const $Estimate after = {filter_corrected, filter_P[P_next]};
    $update;
    filter.P = P_next;
    filter.corrected = true;
}
