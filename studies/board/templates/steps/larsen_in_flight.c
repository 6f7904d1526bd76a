enum { IN_FLIGHT = $in_flight }; /* measurements on their way at once, at most */

/* The i-th of those on their way, in the order of their k. */
static int flight(int i)
{
    return (filter.first + i) % IN_FLIGHT;
}

static void copy_matrix(real from[$n][$n], real to[$n][$n])
{
    for (int i = 0; i < $n; i++) {
        for (int j = 0; j < $n; j++) {
            to[i][j] = from[i][j];
        }
    }
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
        const int other = 1 - filter.Phi[f];
        if (filter.k[f] == filter.j) {
            copy_matrix(Phi, filter_Phi[f][other]); /* (15) */
        } else {
            $product; /* (16) */
        }
        filter.Phi[f] = other;
    }
    filter.x = x_next;
    filter.P = P_next;
    filter.j++;
}

void filter_take(void)
{
    const int taken = flight(filter.count);
    const int P_next = 1 - filter.P;
    for (int i = 0; i < filter.count; i++) {
        const int f = flight(i);
        copy_matrix(filter_Phi[f][filter.Phi[f]], filter_Phi_at[f][taken]);
    }
    for (int i = 0; i < $n; i++) {
        filter_x_at_k[taken][0][i] = filter_x[filter.x][i];
    }
    const $Estimate reference = {filter_x_at_k[taken][0], filter_P[filter.P]};
    const $Correction correction = {filter_z, filter_K[taken], filter_delta_x};
    $gain;
    filter.k[taken] = filter.j;
    filter.x_at_k[taken] = 0;
    filter.P = P_next;
    filter.count++;
}

void filter_measure(real y[$p])
{
    const int f = filter.first;
    const int x_next = 1 - filter.x;
    const $Correction correction = {filter_z, filter_K[f], filter_delta_x};
    $correct;
    filter.x = x_next;
    filter.first = flight(1);
    filter.count--;
    for (int i = 0; i < filter.count; i++) {
        const int later = flight(i);
        const int other = 1 - filter.x_at_k[later];
        $compensate;
        filter.x_at_k[later] = other;
    }
}
