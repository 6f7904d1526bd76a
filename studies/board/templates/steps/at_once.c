$head
void filter_step($u_parameter)
{
    const int next = 1 - filter.now;
    const $Estimate before = {filter_x[filter.now], filter_P[filter.now]};
    const $Estimate after = {filter_x[next], filter_P[next]};
${unused_u}    (void)$propagate;
    filter.now = next;
    filter.j++;
}

void filter_measure(real y[$p])
{
    const int next = 1 - filter.now;
    const $Estimate before = {filter_x[filter.now], filter_P[filter.now]};
    const $Estimate after = {filter_x[next], filter_P[next]};
    $update;
    filter.now = next;
}
