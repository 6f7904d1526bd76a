"""How much work is a robust step, by way of computing it, and is Givens "computationally more efficient"?

The claim of "Computation of Extended Robust Kalman Filter for Real-Time Attitude and Position Estimation"
(arXiv:1801.04386), section 3, counted: for dense systems by formula, for the paper's own systems in the real jobs.
"""

from __future__ import annotations

from typing import Literal, NamedTuple, TypeAlias, get_args

import numpy as np

from filters.arrays import FloatArray
from filters.backends.counted import Operations, count
from filters.registry import ALL_METHODS
from filters.robust.blocks import NATURAL, assemble, block_sizes, block_starts
from filters.robust.model import prepared, weights
from filters.robust.records import Predicted, RobustModel, Weights
from filters.robust.step import JOBS, STUDIED, StepJob
from filters.robust.uncertain import linearised
from filters.systems.attitude import attitude_uncertainty
from filters.systems.example import example_system
from filters.systems.position import position_uncertainty
from studies.robust.costs import SYSTEMS, SystemName, robust_case

Penalty: TypeAlias = Literal["infinite", "finite"]
PENALTIES: tuple[Penalty, ...] = get_args(Penalty)

COUNTED = (
    *("givens, natural order", "householder", "householder, natural order", "faddeev", "faddeev, natural order"),
    *("lu, natural order", "dense lu", "inverse, nonzero entries"),
)
"""Ways of `STUDIED` that are counted in a run."""


class WayCount(NamedTuple):
    """A step without linearisation. unknowns: N of the block system; the closed form does not form it."""

    system: SystemName
    penalty: Penalty
    way: str
    unknowns: int
    operations: Operations


class DenseCounts(NamedTuple):
    """Counts of a dense system of N unknowns, of which the last n are wanted for n + 1 right-hand sides.

    givens: all right-hand sides at once; givens_per_column: each anew, as the paper does; inverse: Gauss-Jordan with
    partial pivoting, then the last n rows times b; repeated: one elimination for each column of the inverse, as the
    paper counts it; lu: with partial pivoting. householder: a reflection for each column. faddeev: n more rows are
    eliminated with those of A, and nothing is substituted back.
    """

    givens: Operations
    givens_per_column: Operations
    householder: Operations
    faddeev: Operations
    inverse: Operations
    repeated: Operations
    lu: Operations


def counts() -> list[WayCount]:
    """Counts of both systems with all their uncertainties, in the ways that are used, and in others for comparison."""
    rows = []
    for system in SYSTEMS:
        model = _model(system)
        for penalty in PENALTIES:
            mu = np.inf if penalty == "infinite" else robust_case(system).mu
            ready = prepared(model, mu)
            unknowns = sum(block_sizes(ready))
            jobs: list[tuple[str, StepJob]] = [*JOBS.items(), *((way, STUDIED[way]) for way in COUNTED)]
            rows += [WayCount(system, penalty, way, unknowns, _count(job, ready, mu)) for way, job in jobs]
    return rows


def kalman_counts(system: SystemName) -> Operations:
    """Counts of a plain Kalman filter's propagation and update, dense, in the form that takes the least operations."""
    case = robust_case(system)
    n, m, p = len(case.start.x), len(case.system.Q), len(case.start.y)
    jobs = ALL_METHODS["standard"].jobs(example_system(n, m, p), "short").values()
    return sum((count(job.function, *job.arguments(0)) for job in jobs), start=Operations())


def filled(system: SystemName, penalty: Penalty) -> float:
    """The share of the N^2 entries of A that are not zero, from 0 to 1, with a P that has none."""
    mu = np.inf if penalty == "infinite" else robust_case(system).mu
    ready = prepared(_model(system), mu)
    n, p, sizes = len(ready.F), len(ready.H), block_sizes(ready)
    N, before = sum(sizes), Predicted(np.zeros(n), np.ones((n, n)))
    T = np.zeros((N, N + n + 1))
    assemble(ready, weights(ready, mu), before, np.zeros(p), np.zeros(n), block_starts(sizes, NATURAL), T)
    return np.count_nonzero(T[:, :N]) / N**2


def product_share(N: int, n: int) -> float:
    """Of the operations of the dense inverse, those of the product of its last n rows with b."""
    return n * (n + 1) * (2 * N - 1) / dense_counts(N, n).inverse.total


def dense_counts(N: int, n: int) -> DenseCounts:
    """By formula; r = n + 1 right-hand sides, N (N - 1) / 2 rotations."""
    r = n + 1
    pairs, cubes = N * (N - 1) // 2, (N - 1) * N * (2 * N - 1) // 6
    substitution = n * (n - 1) // 2
    eliminated = cubes + 2 * pairs
    return DenseCounts(
        givens=_givens(N, n, r),
        givens_per_column=Operations(*(r * number for number in _givens(N, n, 1))),
        householder=Operations(
            multiply=2 * cubes + (2 * r + 4) * pairs + (3 * r + 2) * (N - 1) + r * substitution,
            add=2 * cubes + (2 * r + 2) * pairs + (r + 2) * (N - 1) + r * substitution,
            divide=N - 1 + r * n,
            sqrt=N - 1,
        ),
        faddeev=Operations(
            multiply=cubes + r * pairs + n * (pairs + r * N),
            add=cubes + r * pairs + n * (pairs + r * N),
            divide=pairs + n * N,
        ),
        inverse=Operations(multiply=N**3 + n * N * r, add=N**2 * (N - 1) + n * (N - 1) * r, divide=N),
        repeated=Operations(
            multiply=N * eliminated + n * N * r, add=N * eliminated + n * (N - 1) * r, divide=N * (pairs + N)
        ),
        lu=Operations(
            multiply=cubes + r * (pairs + substitution), add=cubes + r * (pairs + substitution), divide=pairs + r * n
        ),
    )


def _givens(N: int, n: int, r: int) -> Operations:
    pairs, cubes = N * (N - 1) // 2, (N - 1) * N * (2 * N - 1) // 6
    columns, substitution = cubes + r * pairs, r * n * (n - 1) // 2
    return Operations(
        multiply=2 * pairs + 4 * columns + substitution,
        add=pairs + 2 * columns + substitution,
        divide=3 * pairs + r * n,
        sqrt=pairs,
    )


def _model(system: SystemName) -> RobustModel:
    case = robust_case(system)
    rows = attitude_uncertainty("all") if system == "attitude" else position_uncertainty("bias")
    return linearised(case.system, case.scaling, rows, case.start.x, case.start.u)


def _count(job: StepJob, model: RobustModel, mu: float) -> Operations:
    """In a run of the job at P = I, a full matrix nearly so, and a measurement near what is expected.

    All numbers are rounded before it: what a way skips as zero hangs on their last digits, and these on the processor.
    """
    n, p = len(model.F), len(model.H)
    random = np.random.default_rng(0)
    root = np.eye(n) + 0.05 * random.normal(size=(n, n))
    before = Predicted(_rounded(random.normal(size=n)), _rounded(root @ root.T))
    after = Predicted(np.empty(n), np.empty((n, n)))
    y, c = _rounded(random.normal(size=p)), _rounded(random.normal(size=n))
    rounded = RobustModel(*map(_rounded, model))
    Phi1, Phi2, inverse_lambda = weights(rounded, mu)
    weighed = Weights(_rounded(Phi1), _rounded(Phi2), inverse_lambda)
    return count(job.function, rounded, weighed, before, y, c, after, job.workspace(rounded))


def _rounded(matrix: FloatArray) -> FloatArray:
    """To 33 bits, some ten digits."""
    mantissa, exponent = np.frexp(matrix)
    return np.ldexp(np.round(mantissa * 2**33) / 2**33, exponent)
