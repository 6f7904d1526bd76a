"""Operations: formulas for dense matrices, cubics for dense blocks, and what zeros save on the real matrices."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from filters.backends.counted import Operations, count
from filters.kernels.faddeev import faddeev
from filters.kernels.givens import triangularise
from filters.robust.block_step import BlockWorkspace, new_block_workspace
from filters.robust.blocks import NATURAL, RECOMMENDED
from filters.robust.model import prepared, weights
from filters.robust.records import Predicted, RobustModel
from filters.robust.solvers import (
    by_dense_lu,
    by_givens,
    by_givens_per_column,
    by_householder,
    by_inverse,
    by_lu,
    by_nonzero_inverse,
    by_repeated_elimination,
)
from filters.robust.step import JOBS, STUDIED
from studies.robust.counts import dense_counts
from tests.filters.robust.cases import Array, attitude_model, block_system, position_model, random_model, start


def dense_work(model: RobustModel) -> BlockWorkspace:
    """A system of the model's size without any zero."""
    work = new_block_workspace(model, NATURAL)
    return work._replace(T=np.random.default_rng(0).normal(size=work.T.shape))


def dense_givens(N: int, n: int, r: int) -> Operations:
    pairs, squares = N * (N - 1) // 2, (N - 1) * N * (2 * N - 1) // 6
    back = r * n * (n - 1) // 2
    inner = squares + r * pairs
    return Operations(2 * pairs + 4 * inner + back, pairs + 2 * inner + back, 3 * pairs + r * n, pairs)


def dense_lu(N: int, n: int, r: int) -> Operations:
    pairs, squares = N * (N - 1) // 2, (N - 1) * N * (2 * N - 1) // 6
    inner = squares + r * pairs + r * n * (n - 1) // 2
    return Operations(inner, inner, pairs + r * n)


def dense_inverse(N: int, n: int, r: int) -> Operations:
    return Operations(N**3 + n * N * r, N**2 * (N - 1) + n * (N - 1) * r, N)


def repeated_elimination(N: int, n: int, r: int) -> Operations:
    pairs, squares = N * (N - 1) // 2, (N - 1) * N * (2 * N - 1) // 6
    inner = N * (squares + 2 * pairs)
    return Operations(inner + n * N * r, inner + n * (N - 1) * r, N * (pairs + N))


FORMULAS: list[tuple[Callable[[BlockWorkspace], None], Callable[[int, int, int], Operations]]] = [
    (by_givens, dense_givens),
    (by_dense_lu, dense_lu),
    (by_lu, dense_lu),
    (by_inverse, dense_inverse),
    (by_nonzero_inverse, dense_inverse),
]


@pytest.mark.parametrize(("solve_last", "formula"), [*FORMULAS, (by_repeated_elimination, repeated_elimination)])
@pytest.mark.parametrize(("n", "m", "p", "t"), [(1, 1, 1, 0), (2, 1, 1, 1), (3, 1, 1, 1)])
def test_dense_matrices(
    solve_last: Callable[[BlockWorkspace], None],
    formula: Callable[[int, int, int], Operations],
    n: int,
    m: int,
    p: int,
    t: int,
) -> None:
    work = dense_work(random_model(0, n, m, p, t, t))
    assert count(solve_last, work) == formula(len(work.T), n, n + 1)


@pytest.mark.parametrize(("n", "N"), [(1, 5), (2, 9), (3, 7)])
def test_dense_reflections_and_faddeevs_elimination(n: int, N: int) -> None:
    """Householder takes two thirds of what Givens does in the end, Faddeev a little more than LU."""
    work = dense_work(random_model(0, n, 1, 1, 1, 1))
    assert count(by_householder, work) == dense_counts(len(work.T), n).householder
    random = np.random.default_rng(0)
    found = count(faddeev, *(random.normal(size=size) for size in ((N, N + n + 1), (n, N), (n, n + 1))))
    assert found == dense_counts(N, n).faddeev
    large = dense_counts(1000, 10)
    assert large.householder.total == pytest.approx(2 / 3 * large.givens.total, rel=0.01)
    assert large.lu.total < large.faddeev.total < 1.05 * large.lu.total


def test_one_factorisation_per_column() -> None:
    work = dense_work(random_model(0, 2, 1, 1, 1, 1))
    once = dense_givens(len(work.T), 2, 1)
    assert count(by_givens_per_column, work) == once + once + once


@pytest.mark.parametrize(
    ("model", "unknowns", "givens", "lu", "inverse", "repeated"),
    [
        (attitude_model("all"), 47, 254_287, 83_489, 209_390, 3_410_184),
        (random_model(0, 9, 6, 6, 1, 1), 68, 768_496, 253_668, 636_458, 14_732_654),
    ],
)
def test_totals_of_dense_matrices(
    model: RobustModel, unknowns: int, givens: int, lu: int, inverse: int, repeated: int
) -> None:
    """A dense explicit inverse is cheaper than Givens rotations, unless every one of its columns is an elimination."""
    n = len(model.F)
    assert len(dense_work(model).T) == unknowns
    assert dense_givens(unknowns, n, n + 1).total == givens
    assert dense_lu(unknowns, n, n + 1).total == lu
    assert dense_inverse(unknowns, n, n + 1).total == inverse
    assert repeated_elimination(unknowns, n, n + 1).total == repeated
    assert inverse < givens < (n + 1) * dense_givens(unknowns, n, 1).total < repeated


def triangularisation(s: int, mu: float, order: Array) -> Operations:
    """For n = m = 2s, p = q = s, dense blocks, and uncorrelated noise."""
    model = random_model(1, 2 * s, 2 * s, s, 1, 1)
    model = model._replace(Q=np.diag(np.diag(model.Q)), R=np.diag(np.diag(model.R)))
    A, b = block_system(model, start(2 * s), np.ones(s), np.ones(2 * s), mu, order)
    return count(triangularise, np.hstack([A, b]))


@pytest.mark.parametrize("s", [2, 3])
def test_cubics_of_the_zeros_between_dense_blocks(s: int) -> None:
    assert triangularisation(s, np.inf, NATURAL).total == 1232 * s**3 + 995 * s**2 + 236 * s - 25
    assert triangularisation(s, 10.0, NATURAL).total == 1764 * s**3 + 1362 * s**2 + 265 * s
    for mu in (np.inf, 10.0):
        assert 2 * triangularisation(s, mu, RECOMMENDED).total == 1262 * s**3 + 1293 * s**2 + 323 * s


def operations(way: str, model: RobustModel, mu: float) -> Operations:
    """Of a whole step, with P in which nothing is zero."""
    ready, job = prepared(model, mu), {**JOBS, **STUDIED}[way]
    n, p = len(ready.F), len(ready.H)
    after = Predicted(np.zeros(n), np.zeros((n, n)))
    weight, work = weights(ready, mu), job.workspace(ready)
    return count(job.function, ready, weight, start(n), np.ones(p), np.ones(n), after, work)


@pytest.mark.parametrize(
    ("mu", "natural", "recommended", "rotations"), [(np.inf, 36_045, 11_842, 172), (1e5, 56_317, 12_551, 179)]
)
def test_zeros_of_the_attitude_model(mu: float, natural: int, recommended: int, rotations: int) -> None:
    """Beside the counts of a prototype of the same rotations, with its own P and, for finite mu, other E rows."""
    model = attitude_model("all")
    found = operations("givens", model, mu)
    assert found.total == pytest.approx(recommended, rel=0.06)
    assert found.sqrt == pytest.approx(rotations, rel=0.04)
    assert operations("givens, natural order", model, mu).total == pytest.approx(natural, rel=0.01)


def test_what_each_way_costs() -> None:
    """On the real matrices: the closed form least, then LU, then Givens; order matters as much as the method."""
    model = attitude_model("all")
    expected = {"closed": 1_710, "lu": 2_117, "givens": 11_908, "inverse": 209_420}
    assert {way: operations(way, model, np.inf).total for way in expected} == expected
    natural = operations("givens, natural order", model, np.inf).total
    assert natural == pytest.approx(36_090, rel=1e-3)  # whether a residue of rounding is zero depends on the processor
    of_position = {way: operations(way, position_model("bias"), np.inf).total for way in ("closed", "lu", "givens")}
    assert of_position["closed"] < of_position["lu"] < of_position["givens"] < 33_151
