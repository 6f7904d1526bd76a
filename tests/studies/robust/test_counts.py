"""The counts behind the verdict on Givens rotations. Golden figures are those of the reconstruction."""

from __future__ import annotations

from functools import cache

import pytest
from hypothesis import given
from hypothesis import strategies as st

from studies.robust.costs import SYSTEMS, SystemName
from studies.robust.counts import (
    PENALTIES,
    Penalty,
    WayCount,
    counts,
    dense_counts,
    filled,
    kalman_counts,
    product_share,
)


@cache
def all_counts() -> list[WayCount]:
    return counts()


def counted(system: str, penalty: str, way: str) -> WayCount:
    (found,) = [c for c in all_counts() if (c.system, c.penalty, c.way) == (system, penalty, way)]
    return found


def total(system: str, penalty: str, way: str) -> int:
    return counted(system, penalty, way).operations.total


@pytest.mark.parametrize(
    ("N", "n", "givens", "per_column", "inverse", "repeated"),
    [(47, 6, 254_287, 1_506_085, 209_390, 3_410_184), (68, 9, 768_496, 6_447_550, 636_458, 14_732_654)],
)
def test_dense_counts(N: int, n: int, givens: int, per_column: int, inverse: int, repeated: int) -> None:
    found = dense_counts(N, n)
    assert (found.givens.total, found.givens_per_column.total) == (givens, per_column)
    assert (found.inverse.total, found.repeated.total) == (inverse, repeated)


@pytest.mark.parametrize(("N", "n", "ratio"), [(47, 6, 2.26), (68, 9, 2.285)])
def test_givens_is_cheaper_by_the_papers_own_accounting_and_dearer_than_one_inverse(
    N: int, n: int, ratio: float
) -> None:
    found = dense_counts(N, n)
    assert found.repeated.total / found.givens_per_column.total == pytest.approx(ratio, abs=0.01)
    assert 1.20 < found.givens.total / found.inverse.total < 1.22


@pytest.mark.exhaust
@pytest.mark.parametrize("way", ["inverse", "dense lu"])
@pytest.mark.parametrize("penalty", PENALTIES)
@pytest.mark.parametrize("system", SYSTEMS)
def test_dense_formulas_are_what_the_jobs_do(system: str, penalty: str, way: str) -> None:
    """Beside the solution, a job only makes P symmetric: an add and a multiply for each pair of its entries."""
    found = counted(system, penalty, way)
    n = 6 if found.system == "attitude" else 9
    formula = dense_counts(found.unknowns, n)
    expected = formula.inverse if found.way == "inverse" else formula.lu
    pairs = n * (n - 1) // 2
    assert found.operations == expected._replace(multiply=expected.multiply + pairs, add=expected.add + pairs)


@pytest.mark.parametrize(
    ("order", "counted"),
    [("givens", 11_842), pytest.param("givens, natural order", 36_045, marks=pytest.mark.exhaust)],
)
def test_zero_skipping_givens_of_the_attitude_system(order: str, counted: int) -> None:
    """In the reconstruction 11,842 and 36,045; here each row also knows where it ends, and P is made symmetric."""
    assert total("attitude", "infinite", order) == pytest.approx(counted, rel=0.01)


@pytest.mark.parametrize("penalty", PENALTIES)
@pytest.mark.parametrize("system", SYSTEMS)
def test_pivoted_lu_and_the_closed_form_are_far_cheaper(system: str, penalty: str) -> None:
    givens, inverse = total(system, penalty, "givens"), total(system, penalty, "inverse")
    assert inverse > 15 * givens
    assert givens > 5 * total(system, penalty, "lu")
    assert givens > 6 * total(system, penalty, "closed")
    assert total(system, penalty, "closed") < 1.2 * kalman_counts(system).total


@pytest.mark.parametrize("system", SYSTEMS)
def test_reflections_take_less_than_rotations_but_in_the_natural_order_where_mu_is_infinite(system: str) -> None:
    for penalty in PENALTIES:
        assert total(system, penalty, "householder") < total(system, penalty, "givens")
        rotations = total(system, penalty, "givens, natural order")
        assert (total(system, penalty, "householder, natural order") > rotations) == (penalty == "infinite")


@pytest.mark.parametrize("penalty", PENALTIES)
@pytest.mark.parametrize("system", SYSTEMS)
def test_faddeevs_algorithm_takes_what_lu_does(system: str, penalty: str) -> None:
    assert total(system, penalty, "faddeev") == pytest.approx(total(system, penalty, "lu"), rel=0.06)
    assert total(system, penalty, "givens") > 4 * total(system, penalty, "faddeev")


@pytest.mark.parametrize("system", SYSTEMS)
@pytest.mark.parametrize("penalty", PENALTIES)
def test_the_block_system_is_sparse(system: SystemName, penalty: Penalty) -> None:
    """Every row has an entry, and each block of P, of n^2 of them, is full."""
    n, N = (6, 47) if system == "attitude" else (9, 67)
    assert (n**2 + N - n) / N**2 < filled(system, penalty) < 0.1


@given(st.integers(1, 20), st.integers(20, 200))
def test_the_product_is_a_small_part_of_the_dense_inverse_where_few_rows_are_wanted(n: int, N: int) -> None:
    """Without it, N pivots with N^2 multiplications and, but for one row each, as many additions are left."""
    total = dense_counts(N, n).inverse.total
    assert total * (1 - product_share(N, n)) == pytest.approx(2 * N**3 - N**2 + N)
