enum { STATES_IN_STACK = $M + 2 }; /* the present one, M before, and one that is free */

static const $Stack *stack_of(int now)
{
    return now == 0 ? &filter_stack : &filter_spare;
}

$head
void filter_step($u_parameter)
{
${unused_u}    $predict;
    filter.j++;
}

void filter_measure(real y[$p])
{
    $update;
    filter.now = 1 - filter.now;
}
