/* The estimate of the step in this slot, corrected by its measurement of $identifier. */
static void correct_by_$identifier(int slot)
{
    const $Estimate before = {filter_x, filter_P};
    const $Estimate after = {filter_corrected_x, filter_corrected_P};
    $correct;
    copy_estimate(filter_corrected_x, filter_corrected_P, filter_x, filter_P);
}
