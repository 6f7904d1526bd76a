enum { IN_FLIGHT = $in_flight }; /* measurements on their way at once, at most */

/* The i-th of those on their way, in the order of their k. */
static int flight(int i)
{
    return (filter.first + i) % IN_FLIGHT;
}

$head
void filter_step($u_parameter)
{
    const int x_next = 1 - filter.x;
    const int P_next = 1 - filter.P;
    const $Estimate before = {filter_x[filter.x], filter_P[filter.P]};
    const $Estimate after = {filter_x[x_next], filter_P[P_next]};
${unused_u}    real(*const Phi)[$n] = $propagate;
    for (int i = 0; i < filter.count; i++) {
        const int f = flight(i);
        const int other = 1 - filter.B[f];
        $carry;
        filter.B[f] = other;
    }
    filter.x = x_next;
    filter.P = P_next;
    filter.j++;
}

void filter_take(void)
{
    const int taken = flight(filter.count);
    const int P_next = 1 - filter.P;
    const $Estimate reference = {filter_x[filter.x], filter_P[filter.P]};
    const $Flight flown = {filter_expected[taken][0], filter_B[taken][0], filter_S};
    filter.expected[taken] = 0;
    filter.B[taken] = 0;
    real(*const H)[$n] = $update;
    for (int i = 0; i < filter.count; i++) { /* what will be missed of each that is on its way */
        const int f = flight(i);
        $couple;
    }
    filter.P = P_next;
    filter.count++;
}

void filter_measure(real y[$p])
{
    const int f = filter.first;
    const int x_next = 1 - filter.x;
    $land;
    filter.x = x_next;
    filter.first = flight(1);
    filter.count--;
    for (int i = 0; i < filter.count; i++) { /* what is expected of the others, with this one in the state */
        const int later = flight(i);
        const int other = 1 - filter.expected[later];
        $compensate;
        filter.expected[later] = other;
    }
}
