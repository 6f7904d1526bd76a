"""The singular values of P by Givens rotations, by LU and by an inverse, each filter on its own."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache, partial
from operator import attrgetter

import numpy as np
import pytest

from filters.robust import extended as extended_robust
from studies.robust.singular_values import CASES, WAYS, Agreement, Case, Comparison, compare, singular_values

LIMITS = [case for case in CASES if np.isinf(case.method.mu) and case.scaled]
FINITE = [case for case in CASES if np.isfinite(case.method.mu)]
NAME = attrgetter("name")
UNSCALED = next(case for case in CASES if not case.scaled)


ATTITUDES = [case for case in CASES if case.name.startswith("attitude")]


def uncompiled(case: Case, seconds: float, ways: Sequence[str] = WAYS) -> Comparison:
    with pytest.MonkeyPatch.context() as patch, np.errstate(all="ignore"):
        patch.setattr(extended_robust, "run", partial(extended_robust.run, backend="numpy"))
        return compare(case, seconds=seconds, sample_every=4, ways=ways)


@cache
def compared(case: Case) -> Comparison:
    return uncompiled(case, 0.5, ["givens"])


@cache
def briefly(case: Case) -> Comparison:
    """All ways."""
    return uncompiled(case, 0.1)


def agreement(found: Comparison, way: str) -> Agreement:
    (agreed,) = (each for each in found.agreements if each.way == way)
    return agreed


def test_of_a_stack() -> None:
    P = np.array([np.diag([3.0, 1.0, 2.0]), np.full((3, 3), np.nan)])
    np.testing.assert_array_equal(singular_values(P), [[3.0, 1.0], [np.nan, np.nan]])


@pytest.mark.parametrize("case", [*LIMITS, *FINITE], ids=NAME)
@pytest.mark.exhaust
def test_givens_agrees_with_the_inverse(case: Case) -> None:
    agrees(agreement(compared(case), "givens"))


@pytest.mark.parametrize("case", ATTITUDES, ids=NAME)
def test_pivoted_lu_agrees_with_the_inverse(case: Case) -> None:
    agrees(agreement(briefly(case), "lu"))


def agrees(found: Agreement) -> None:
    assert found.first_failure is None
    assert max(found.absolute_largest, found.absolute_smallest) < 1e-9
    assert max(found.relative_largest, found.relative_smallest) < 1e-7


@pytest.mark.parametrize("case", [case for case in ATTITUDES if case in LIMITS], ids=NAME)
def test_lu_without_pivoting_fails_at_the_first_step_in_the_limit(case: Case) -> None:
    assert agreement(briefly(case), "lu without pivoting").first_failure == 1


@pytest.mark.parametrize("case", [case for case in ATTITUDES if case in FINITE], ids=NAME)
def test_lu_without_pivoting_loses_digits_where_mu_is_finite(case: Case) -> None:
    found = agreement(briefly(case), "lu without pivoting")
    assert found.first_failure is None
    assert found.absolute_largest > 100 * agreement(briefly(case), "lu").absolute_largest


def test_unscaled_states_hide_a_bad_smallest_singular_value_behind_a_small_absolute_difference() -> None:
    found = agreement(compared(UNSCALED), "givens")
    assert max(found.absolute_largest, found.absolute_smallest) < 1e-11
    scaled = agreement(compared(LIMITS[-1]), "givens")
    assert LIMITS[-1].method == UNSCALED.method
    assert found.relative_smallest > 1000 * scaled.relative_smallest


def test_curves_are_sampled_and_frozen() -> None:
    curves = briefly(CASES[0]).curves
    assert [curve.way for curve in curves] == ["inverse", "givens", "lu", "lu without pivoting"]
    for curve in curves[:3]:
        np.testing.assert_allclose(curve.time_s, np.arange(11) * 0.01)
        assert (curve.largest > curve.smallest).all()
        assert (curve.smallest > 0).all()
    assert np.isnan(curves[3].largest[1:]).all()
    with pytest.raises(ValueError, match="read-only"):
        curves[0].largest[0] = 0.0


@pytest.mark.exhaust
@pytest.mark.parametrize("case", [*LIMITS, *FINITE], ids=NAME)
def test_givens_agrees_with_the_inverse_over_the_whole_drive(case: Case) -> None:
    (found,) = compare(case, ways=["givens"]).agreements
    agrees(found)
