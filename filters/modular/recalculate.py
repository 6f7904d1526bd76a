"""Roll back and replay: a late measurement is used in the step in which it was taken, and all since is done again."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from filters.arrays import Flags, FloatArray
from filters.backends.choose import BackendName
from filters.kernels.dense import store, store_vector
from filters.kernels.place import IntArray
from filters.modular.arrivals import Arrivals, TooOld, arrivals
from filters.modular.breakdown import PREDICTOR, SOUND, Failure, failed
from filters.modular.composition import ModularFilter
from filters.modular.correction import Correction, correction
from filters.modular.estimate import copy_estimate, empty
from filters.modular.history import Estimates, ModularHistory
from filters.modular.kept import keep
from filters.modular.measurements import Measurement
from filters.modular.problem import check_problem
from filters.modular.running import run_kernel
from filters.modular.space import Space
from filters.modular.workspace import Workspace
from filters.records import Estimate


class Memory(NamedTuple):
    """The last steps, each at its number modulo their count: predictions x (count, numbers) and P (count, n, n).

    known (count, sensors): the first measurement of each sensor that was taken in the step and has arrived; then
    (measurements,): the next of the same sensor and step; -1: none.
    """

    x: FloatArray
    P: FloatArray
    known: IntArray
    then: IntArray


class Given(NamedTuple):
    """What one correction takes."""

    of: Space
    before: Estimate
    y: FloatArray
    lost: Flags
    after: Estimate


@cache
def given_to(correct: Correction) -> Callable[..., None]:
    """The correction as a link of a chain. Same function in, same function out."""

    def use(view: Any, observed: Space, work: Workspace, case: Given) -> None:
        correct(view, observed, case.of, case.before, case.y, case.lost, case.after, work)

    return use


def remember(memory: Memory, number: int, arrived: Arrivals) -> None:
    """This measurement has arrived; it comes after those of its sensor and step that have before."""
    step, sensor = arrived.taken[number] % memory.known.shape[0], arrived.sensor[number]
    last = memory.known[step, sensor]
    if last < 0:
        memory.known[step, sensor] = number
        return
    while memory.then[last] >= 0:
        last = memory.then[last]
    memory.then[last] = number


def filter_all(
    predict: Callable[..., None],
    use: Callable[..., None],
    is_sound: Callable[..., bool],
    motion: Any,
    parts: Any,
    places: IntArray,
    space: Space,
    dt: float,
    inputs: FloatArray,
    arrived: Arrivals,
    history: Estimates,
    failure: Failure,
    work: Workspace,
    memory: Memory,
    current: Estimate,
    corrected: Estimate,
) -> tuple[int, int]:
    """The whole filter as one kernel; memory holds the start as the prediction for step 0, history is filled.

    current, corrected: scratch. Returns SOUND and the last step, or the number of the sensor, or PREDICTOR, that left
    an estimate that is none, and the step; then the failure holds both estimates.
    """
    count, sensors = memory.known.shape
    following = 0
    for j in range(len(inputs) + 1):
        for s in range(sensors):
            memory.known[j % count, s] = -1
        first = j
        while following < len(arrived.arrives) and arrived.arrives[following] == j:
            remember(memory, following, arrived)
            first = min(first, arrived.taken[following])
            following += 1
        for i in range(first, j + 1):
            at = Estimate(memory.x[i % count], memory.P[i % count])
            if i > first or 0 < i == j:
                predict(motion, space, current, inputs[i - 1], dt, at, work)
                if not is_sound(space, at, work.nn1):
                    return failed(PREDICTOR, i, current, at, failure)
            before, corrections = at, 0
            for s in range(sensors):
                number = memory.known[i % count, s]
                while number >= 0:
                    case = Given(space, before, arrived.y[number], arrived.lost[number], corrected)
                    use(places[s, 0], places[s, 1], parts, case)
                    if not is_sound(space, corrected, work.nn1):
                        return failed(s, i, before, corrected, failure)
                    copy_estimate(corrected, current)
                    before, corrections = current, corrections + 1
                    number = memory.then[number]
            if corrections == 0:
                copy_estimate(at, current)
        store_vector(current.x, history.x, j)
        store(current.P, history.P, j)
    return SOUND, len(inputs)


def run(
    composed: ModularFilter,
    x0: ArrayLike,
    P0: ArrayLike,
    inputs: ArrayLike,
    measurements: Iterable[Measurement],
    *,
    history: int | None = None,
    too_old: TooOld = "refuse",
    backend: BackendName = "reference",
) -> ModularHistory:
    """Filter a record of data; each measurement is used from the step on in which it arrives, in whatever order.

    Other arguments, results and errors as in `late.run`.
    history: how many steps the filter can go back; if not given, as many as the sensors' longest delay.
    too_old: what is done with a measurement that is older: "refuse", or "drop" it and go on.
    """
    x, P, moves = check_problem(composed, x0, P0, inputs)
    space = composed.of
    depth = max((sensor.longest_delay for sensor in composed.sensors), default=0) if history is None else history
    if not isinstance(depth, int | np.integer) or depth < 0:
        raise ValueError(
            f"history={history!r} must be a whole number, at least 0: how many steps the filter can go back"
        )
    arrived, dropped = arrivals(composed, measurements, len(moves), depth, too_old)
    count, n = min(depth, len(moves)) + 1, space.errors
    memory = Memory(
        np.zeros((count, space.numbers)),
        np.zeros((count, n, n)),
        np.full((count, len(composed.sensors)), -1, np.int64),
        np.full(len(arrived.arrives), -1, np.int64),
    )
    memory.x[0], memory.P[0] = keep(composed, Estimate(x, P))
    own = memory, empty(space), empty(space)
    estimates = run_kernel(
        filter_all, lambda each: given_to(correction(composed, each)), composed, moves, arrived, own, backend
    )
    return ModularHistory(*estimates, dropped)
