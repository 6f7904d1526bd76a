$head
void filter_step($u_parameter)
{
    const int next = 1 - filter.now;
    const $Estimate before = {filter_x[filter.now], filter_P[filter.now]};
    const $Estimate after = {filter_x[next], filter_P[next]};
${unused_u}    real(*const Phi)[$n] = $propagate;
    if (filter.taken) {
        filter.slot = 1 - filter.slot;
        $carry;
        filter.W = filter_W[filter.slot];
    }
    filter.now = next;
    filter.j++;
}

void filter_take(void)
{
    const $Estimate reference = {filter_x[filter.now], filter_P[filter.now]};
    ${to_H}$start;
    filter.W = filter_clone_W;
    filter.taken = true;
}

void filter_measure(real y[$p])
{
    const int next = 1 - filter.now;
    const $Estimate before = {filter_x[filter.now], filter_P[filter.now]};
    const $Estimate after = {filter_x[next], filter_P[next]};
    $update;
    filter.now = next;
    filter.taken = false;
}
