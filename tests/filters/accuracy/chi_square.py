"""Whether a spread that was seen is that of a variance."""

from __future__ import annotations

import numpy as np
from scipy.stats import chi2

from filters.arrays import FloatArray

DOUBT = 1e-5
"""Probability that a right variance is called wrong, in one comparison."""


def assert_spread(errors: FloatArray, variances: FloatArray) -> None:
    """errors (steps, runs): normal, of zero mean, independent from run to run. variances (steps,)."""
    runs = errors.shape[1]
    ratios = np.square(errors).sum(axis=1) / variances
    least, most = chi2.ppf([DOUBT / 2, 1 - DOUBT / 2], runs)
    assert ratios.min() > least, (ratios.min() / runs, least / runs)
    assert ratios.max() < most, (ratios.max() / runs, most / runs)
