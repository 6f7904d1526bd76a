void filter_measure_$identifier(int taken, real y[$length])
{
    const int slot = taken % KEPT_STEPS;
    for (int i = 0; i < $length; i++) {
        filter_${identifier}_y[slot][i] = y[i];
    }
    filter.${identifier}_known[slot] = true;
    if (taken < filter.first) {
        filter.first = taken;
    }
}

