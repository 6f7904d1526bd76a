void filter_start(real x[$n], real P[$n][$n])
{
    for (int i = 0; i < $n; i++) {
        $x_start[i] = x[i];
        for (int j = 0; j < $n; j++) {
            $P_start[i][j] = P[i][j];
        }
    }
    filter.j = 0;
$started}

const real *filter_state(void)
{
    return $x_now;
}
