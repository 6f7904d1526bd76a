enum { OUTPUTS = $M + 1 }; /* in memory, from the horizon to now */

$head
void filter_measure(real y[$p])
{
    for (int i = 0; i < $p; i++) {
        filter_y[i] = y[i];
    }
    filter.measured = true;
}

void filter_step($u_parameter)
{
    const int horizon = filter.j + 1 - DELAY_STEPS; /* the step of the filter, D = M steps behind */
${unused_u}    $predict;
    if (horizon > 0) {
        const int next = 1 - filter.now;
        const $Estimate before = {filter_x[filter.now], filter_P[filter.now]};
        const $Estimate after = {filter_x[next], filter_P[next]};
        (void)$propagate;
        filter.now = next;
    }
${keep_u}    filter.j++;
    if (filter.measured) {
        const int next = 1 - filter.now;
        const $Estimate before = {filter_x[filter.now], filter_P[filter.now]};
        const $Estimate after = {filter_x[next], filter_P[next]};
        $update;
        filter.now = next;
        filter.measured = false;
    }
    if (horizon >= 0) {
        const int total_next = 1 - filter.total;
        $pull;
        filter.total = total_next;
        for (int i = 0; i < OUTPUTS; i++) { /* from the horizon to now, number by number */
            $shift_output;
        }
    }
}
