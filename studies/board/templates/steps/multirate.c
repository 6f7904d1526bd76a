/* Row c of the gains: that of step k = c n. */
static int row_of(int k)
{
    return k / CYCLE_STEPS % 2;
}

$head
void filter_step($u_parameter)
{
    const int next = 1 - filter.now;
    if (filter.j % CYCLE_STEPS == 0) { /* where the gain of the next k begins */
        for (int i = 0; i < $n; i++) {
            filter_x_at_k[i] = filter_x[filter.now][i];
        }
${keep_u}    }
    $state_predict;
    filter.now = next;
    filter.j++;
    if (filter.j % CYCLE_STEPS == 0) {
        const int factors_next = 1 - filter.factors;
        $covariance_gain;
        filter.factors = factors_next;
    }
}

void filter_measure(real y[$p])
{
    const int used = filter.j < LANDING_STEPS ? 0 : filter.j - LANDING_STEPS;
    const $Correction correction = {filter_z, filter_K[row_of(used)], filter_delta_x};
    $state_correct;
}
