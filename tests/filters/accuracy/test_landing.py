"""The latest landing: every one up to it keeps the accuracy, and the next does not."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from filters.accuracy import LinearModel, landing_within, latest_landing, linear_model, lossless
from tests.filters.accuracy.cases import CV, INS, POSITION, all_outputs, models


@given(models(), st.integers(1, 6), st.integers(0, 6), st.floats(0.5, 3.0), st.sampled_from(["worst", "rms"]))
def test_it_is_the_last_before_the_first_that_is_too_late(
    model: LinearModel, N: int, M: int, factor: float, metric: str
) -> None:
    C, most = all_outputs(model), M + 3 * N
    within = factor * getattr(lossless(model, C, N, M), metric)
    found = latest_landing(model, C, N, within, M, metric=metric, most=most)  # type: ignore[arg-type]
    kept = [getattr(lossless(model, C, N, L), metric) <= within for L in range(M, most + 1)]
    first_late = kept.index(False) if False in kept else len(kept)
    assert (M + first_late - 1 if first_late else None) == found.L
    assert found.bounded == (False in kept)
    assert found.best == pytest.approx(getattr(lossless(model, C, N, M), metric))
    if found.L is not None:
        assert found.reached == pytest.approx(getattr(lossless(model, C, N, found.L), metric))


def test_of_what_settles_by_itself_any_landing_may_be_good_enough() -> None:
    model = linear_model([[0.5]], [[1]], [[1]], [[1]])
    found = latest_landing(model, [0], 4, within=2.0, M=1, most=1000)
    assert (found.L, found.bounded) == (1000, False)


def test_an_accuracy_that_no_landing_reaches_is_refused_with_the_best_there_is() -> None:
    assert latest_landing(INS, POSITION, 80, 0.37, M=44).L is None
    with pytest.raises(
        ValueError,
        match=r"within=0.37: no landing reaches it; the best there is, landing at M=44 with a measurement every N=80 "
        r"steps, is worst 0.372934; allow that, measure more often, or take a better sensor",
    ):
        landing_within(INS, POSITION, 80, 0.37, M=44)
    assert landing_within(INS, POSITION, 80, 0.38, M=44) == 62


@pytest.mark.parametrize("within", [0.0, -1.0, np.nan, np.inf, True, "0.38"])
def test_an_accuracy_that_is_none_is_refused(within: float) -> None:
    with pytest.raises(ValueError, match=r"within=.* must be a positive standard deviation, in the unit of"):
        latest_landing(CV, [0], 10, within, M=4)


def test_other_arguments_are_checked() -> None:
    with pytest.raises(ValueError, match=r"metric='mean' is unknown; give one of worst, rms"):
        latest_landing(CV, [0], 10, 5.0, M=4, metric="mean")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"most=3 must be a whole number of steps, at least 4"):
        latest_landing(CV, [0], 10, 5.0, M=4, most=3)
