enum { IN_FLIGHT = $in_flight }; /* measurements on their way at once, at most */

/* The i-th of those on their way, in the order of their k. */
static int flight(int i)
{
    return (filter.first + i) % IN_FLIGHT;
}

static $Clone clone_of(int f)
{
    const $Clone clone = {
        filter_expected[f][filter.expected[f]], filter_W[f][filter.W[f]], filter_S[f], filter_factor[f]};
    return clone;
}

$head
void filter_step($u_parameter)
{
    const int next = 1 - filter.now;
    const $Estimate before = {filter_x[filter.now], filter_P[filter.now]};
    const $Estimate after = {filter_x[next], filter_P[next]};
${unused_u}    real(*const Phi)[$n] = $propagate;
    for (int i = 0; i < filter.count; i++) {
        const int f = flight(i);
        const int other = 1 - filter.W[f];
        $carry;
        filter.W[f] = other;
    }
    filter.now = next;
    filter.j++;
}

void filter_take(void)
{
    const int taken = flight(filter.count);
    const $Estimate reference = {filter_x[filter.now], filter_P[filter.now]};
    filter.W[taken] = 0;
    filter.expected[taken] = 0;
    const $Clone clone = clone_of(taken);
    real(*const H)[$n] = $cross;
    for (int i = 0; i < filter.count; i++) { /* W is made independent of each that is on its way */
        const int f = flight(i);
        const int other = 1 - filter.W[taken];
        const $Clone earlier = clone_of(f);
        $couple;
        filter.W[taken] = other;
    }
    const $Clone apart = clone_of(taken);
    $divide;
    filter.count++;
}

void filter_measure(real y[$p])
{
    const int f = filter.first;
    const int next = 1 - filter.now;
    const $Clone landed = clone_of(f);
    const $Estimate before = {filter_x[filter.now], filter_P[filter.now]};
    const $Estimate after = {filter_x[next], filter_P[next]};
    $update;
    filter.now = next;
    filter.first = flight(1);
    filter.count--;
    for (int i = 0; i < filter.count; i++) { /* what is expected of the others, with this one in the state */
        const int later = flight(i);
        const int other = 1 - filter.expected[later];
        $compensate;
        filter.expected[later] = other;
    }
}
