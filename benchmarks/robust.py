"""One step of the robust filter, compiled, in four ways: attitude, 6 states, 3 measurements, 46 unknowns, infinite mu.

Givens rotations in the order in which little fills up, against the explicit inverse of the dense block matrix.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from benchmarks.timing import Result, repeated, seconds
from filters.robust.model import prepared, weights
from filters.robust.records import Predicted
from filters.robust.step import JOBS, WAYS, WayName, step
from filters.robust.uncertain import linearised
from filters.systems.attitude import attitude, attitude_scaling, attitude_uncertainty

STATE = np.array([0.1, -0.05, 1.2, 0.01, -0.02, 0.03])
TURN_RATES = np.array([0.2, -0.1, 0.3])
ROUNDS = 61
TARGETS: dict[WayName, float] = {"givens": 3, "lu": 3, "closed": 10}


def results() -> Iterator[Result]:
    runs = {way: _steps(way) for way in WAYS}
    least = dict.fromkeys(WAYS, float("inf"))
    for _ in range(ROUNDS):
        for way, run in runs.items():
            least[way] = min(least[way], seconds(run, 1))
    for way, target in TARGETS.items():
        yield Result(f"robust step, {way}: faster than the inverse", least["inverse"] / least[way], target)


def _steps(way: WayName) -> Callable[[], None]:
    scaling = attitude_scaling()
    model = prepared(linearised(attitude(), scaling, attitude_uncertainty("bias"), STATE, TURN_RATES))
    x, c = STATE / scaling.unit, np.zeros(6)
    y = x[:3] + 0.2
    start = step(model, Predicted(x, np.eye(6)), y, c)
    after = Predicted(np.empty(6), np.empty((6, 6)))
    return repeated(JOBS[way].function, model, weights(model), start, y, c, after, JOBS[way].workspace(model))
