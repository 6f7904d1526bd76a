$head
void filter_step($u_parameter)
{
    const int x_next = 1 - filter.x;
    const int P_next = 1 - filter.P;
    const $Estimate before = {filter_x[filter.x], filter_P[filter.P]};
    const $Estimate after = {filter_x[x_next], filter_P[P_next]};
${unused_u}    real(*const Phi)[$n] = $propagate;
    if (filter.taken) {
        filter.slot = 1 - filter.slot;
        $carry;
        filter.B = filter_B[filter.slot];
    }
    filter.x = x_next;
    filter.P = P_next;
    filter.j++;
}

void filter_take(void)
{
    const int P_next = 1 - filter.P;
    const $Estimate reference = {filter_x[filter.x], filter_P[filter.P]};
    (void)$update;
    filter.P = P_next;
    filter.B = filter_flight_K;
    filter.taken = true;
}

void filter_measure(real y[$p])
{
    const int x_next = 1 - filter.x;
    $land;
    filter.x = x_next;
    filter.taken = false;
}
