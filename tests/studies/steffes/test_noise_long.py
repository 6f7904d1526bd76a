"""By covariances alone the cost of Q' and Q'' is what the filters themselves have."""

from __future__ import annotations

import pytest

from studies.steffes.noise import APPROXIMATIONS, approximations, tried, with_noise
from studies.steffes.noise_long import over_cycles, worst


def test_the_filters_have_what_the_covariances_give() -> None:
    found = iter(approximations())
    for system, P0, factors, cycles in tried().values():
        for factor in factors:
            *_, last = over_cycles(with_noise(system, factor), P0, cycles)
            for noise in APPROXIMATIONS:
                expected = next(found)
                assert expected.noise == noise
                assert last[noise].covariance == pytest.approx(expected.covariance, rel=0.006)
                assert last[noise].estimate == pytest.approx(expected.estimate, rel=0.006)


def test_many_cycles_bound_what_the_filters_have_after_some() -> None:
    """To the three digits that these are rounded to; the worst comes earlier or later."""
    most = worst()
    for noise in APPROXIMATIONS:
        of = [one for one in approximations() if one.noise == noise]
        assert max(one.covariance for one in of) < most[noise].covariance
        assert max(one.estimate for one in of) < most[noise].estimate
