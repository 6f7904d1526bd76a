static void copy_estimate(real x[$numbers], real P[$n][$n], real x_to[$numbers], real P_to[$n][$n])
{
    for (int i = 0; i < $numbers; i++) {
        x_to[i] = x[i];
    }
    for (int i = 0; i < $n; i++) {
        for (int j = 0; j < $n; j++) {
            P_to[i][j] = P[i][j];
        }
    }
}

/* From the estimate of step i - 1 the prediction for step i, which is kept. */
static void predict_to(int i)
{
    const int slot = i % KEPT_STEPS;
    const $Estimate before = {filter_x, filter_P};
    const $Estimate after = {filter_predicted_x[slot], filter_predicted_P[slot]};
    $predict;
}

$corrections
void filter_start(real x[$numbers], real P[$n][$n])
{
    $keep;
    for (int i = 0; i < $numbers; i++) {
        filter_predicted_x[0][i] = x[i];
    }
$forget_all    filter.j = 0;
    filter.first = 0;
}

const real *filter_state(void)
{
    return filter_x;
}

void filter_step($u_parameter)
{
${keep_u}    filter.j++;
    filter.first = filter.j;
$forget}

$given
void filter_update(void)
{
    for (int i = filter.first; i <= filter.j; i++) {
        const int slot = i % KEPT_STEPS;
        if (i > filter.first || (i == filter.j && i > 0)) {
            predict_to(i);
        }
        copy_estimate(filter_predicted_x[slot], filter_predicted_P[slot], filter_x, filter_P);
$used    }
}
