void filter_start(real x[$n], real P[$n][$n])
{
    for (int i = 0; i < $n; i++) {
        filter_x[i] = x[i];
        filter_scaled_x[0][i] = (x[i] - filter_scaling.origin[i]) / filter_scaling.unit[i];
        for (int j = 0; j < $n; j++) {
            filter_P[0][i][j] = P[i][j];
        }
    }
    filter.j = 0;
    filter.now = 0;
    filter.measured = false;
}

const real *filter_state(void)
{
    return filter_x;
}

void filter_measure(real y[$p])
{
    for (int i = 0; i < $p; i++) {
        filter_y[i] = y[i];
    }
    filter.measured = true;
}

void filter_step($u_parameter)
{
    const int next = 1 - filter.now;
    const $Predicted before = {filter_scaled_x[filter.now], filter_P[filter.now]};
    const $Predicted after = {filter_scaled_x[next], filter_P[next]};
    if (filter.measured) {
        $robust_step;
        filter.measured = false;
    } else {
        $linearise;
        $step_unseen;
    }
    for (int i = 0; i < $n; i++) { /* in the units of the system */
        filter_x[i] = filter_scaling.origin[i] + filter_scaling.unit[i] * filter_scaled_x[next][i];
    }
    filter.now = next;
    filter.j++;
}
