    const $Estimate reference = {hr_x[message.x], lr_P[lr.prior]}; /* K and P_{k^+} need no measurement (Sec. III.D) */
    lr.posterior = 1 - lr.prior;
    $lr_gain;
