"""Operation counts of the robust step as the report names them, and the verdict on Givens rotations."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import NamedTuple

from filters.robust.blocks import NATURAL, RECOMMENDED
from filters.robust.model import prepared, weights
from filters.robust.parallel import Schedule, greedy, sameh_kuck
from filters.robust.parallel_cost import time_units
from filters.robust.parallel_step import step_pattern
from filters.robust.uncertain import linearised
from studies.robust.costs import SYSTEMS, SystemName, robust_case
from studies.robust.counts import PENALTIES, Penalty, counts, dense_counts, kalman_counts

REPEATED = "inverse: N eliminations, as in the paper"
INVERSE = "inverse: one Gauss-Jordan, dense"
INVERSE_SKIPPING = "inverse: zeros skipped"
PER_COLUMN = "Givens: a QR per column, as in the paper"
GIVENS = "Givens: one QR, dense"
GIVENS_NATURAL = "Givens: zeros skipped"
GIVENS_ORDERED = "Givens: zeros skipped, reordered"
HOUSEHOLDER = "Householder: one QR, dense"
HOUSEHOLDER_NATURAL = "Householder: zeros skipped"
HOUSEHOLDER_ORDERED = "Householder: zeros skipped, reordered"
FADDEEV = "Faddeev: dense"
FADDEEV_NATURAL = "Faddeev: zeros skipped"
FADDEEV_ORDERED = "Faddeev: zeros skipped, reordered"
LU = "pivoted LU: dense"
LU_NATURAL = "pivoted LU: zeros skipped"
LU_ORDERED = "pivoted LU: zeros skipped, reordered"
CLOSED = "closed form: zeros skipped"
KALMAN = "plain Kalman filter: dense"

ALL_WAYS = (
    *(REPEATED, INVERSE, INVERSE_SKIPPING),
    *(PER_COLUMN, GIVENS, GIVENS_NATURAL, GIVENS_ORDERED),
    *(HOUSEHOLDER, HOUSEHOLDER_NATURAL, HOUSEHOLDER_ORDERED),
    *(FADDEEV, FADDEEV_NATURAL, FADDEEV_ORDERED),
    *(LU, LU_NATURAL, LU_ORDERED),
    *(CLOSED, KALMAN),
)
TIMED = {INVERSE: "robust-inverse", GIVENS_ORDERED: "robust-givens", LU_ORDERED: "robust-lu", CLOSED: "robust-closed"}
"""Ways whose compiled code is timed, with the linearisation in it."""

_COUNTED = {
    INVERSE_SKIPPING: "inverse, nonzero entries",
    GIVENS_NATURAL: "givens, natural order",
    GIVENS_ORDERED: "givens",
    HOUSEHOLDER_NATURAL: "householder, natural order",
    HOUSEHOLDER_ORDERED: "householder",
    FADDEEV_NATURAL: "faddeev, natural order",
    FADDEEV_ORDERED: "faddeev",
    LU_NATURAL: "lu, natural order",
    LU_ORDERED: "lu",
    CLOSED: "closed",
}

PROCESSORS = (1, 4, 16, 64, 256, 1024)
SCHEDULES = ("dense, Sameh and Kuck", "zeros skipped, greedy", "zeros skipped, reordered, greedy")


class Counts(NamedTuple):
    """unknowns: N of the block system by system; operations: by way, system and penalty."""

    unknowns: Mapping[SystemName, int]
    operations: Mapping[str, Mapping[tuple[SystemName, Penalty], int]]

    def ratio(self, way: str, reference: str, system: SystemName, penalty: Penalty = "finite") -> float:
        """How many times as many operations `way` takes as `reference`."""
        return self.operations[way][system, penalty] / self.operations[reference][system, penalty]


@cache
def all_counts() -> Counts:
    """Both systems' with all their uncertainties; counts of dense systems do not depend on the penalty, and leave out
    that P is made symmetric at the end, n (n - 1) operations, as the other ways of the block system do not."""
    counted = {(row.system, row.penalty, row.way): row for row in counts()}
    unknowns = {system: counted[system, "finite", "givens"].unknowns for system in SYSTEMS}
    operations: dict[str, dict[tuple[SystemName, Penalty], int]] = {}
    for way in ALL_WAYS:
        operations[way] = {}
        for system in SYSTEMS:
            dense = dense_counts(unknowns[system], len(robust_case(system).start.x))
            by_formula = {
                REPEATED: dense.repeated,
                INVERSE: dense.inverse,
                PER_COLUMN: dense.givens_per_column,
                GIVENS: dense.givens,
                HOUSEHOLDER: dense.householder,
                FADDEEV: dense.faddeev,
                LU: dense.lu,
                KALMAN: kalman_counts(system),
            }
            for penalty in PENALTIES:
                tally = by_formula[way] if way in by_formula else counted[system, penalty, _COUNTED[way]].operations
                operations[way][system, penalty] = tally.total
    return Counts(unknowns, operations)


class Parallel(NamedTuple):
    """N: unknowns; stages, rotations: of each schedule; times: by schedule and number of processors."""

    N: int
    stages: Mapping[str, int]
    rotations: Mapping[str, int]
    times: Mapping[str, Mapping[int, int]]


@cache
def parallel(system: SystemName) -> Parallel:
    """Triangularisation of the system as it is scheduled: finite mu, scale factors uncertain."""
    case = robust_case(system)
    start = case.start
    model = prepared(linearised(case.system, case.scaling, case.uncertainty, start.x, start.u), case.mu)
    weight = weights(model, case.mu)
    patterns = [step_pattern(model, weight, order=order) for order in (NATURAL, RECOMMENDED)]
    N = len(patterns[0])
    schedules: dict[str, Schedule] = dict(
        zip(SCHEDULES, (sameh_kuck(N, len(start.x) + 1), *map(greedy, patterns)), strict=True)
    )
    return Parallel(
        N,
        {name: len(schedule.stages) for name, schedule in schedules.items()},
        {name: sum(map(len, schedule.stages)) for name, schedule in schedules.items()},
        {name: {P: time_units(schedule, P) for P in PROCESSORS} for name, schedule in schedules.items()},
    )
