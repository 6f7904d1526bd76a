"""Roll back and replay: a late measurement is used in the step in which it was taken, and all since is done again."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.kernels.backends import BackendName, arguments_for, function_for
from filters.kernels.dense import copy, copy_vector, store, store_vector
from filters.kernels.place import IntArray
from filters.modular.check import check_start
from filters.modular.composition import ModularFilter
from filters.modular.correction import correct_with
from filters.modular.measurements import Arrivals, Measurement, arrivals
from filters.modular.space import Space, space
from filters.modular.workspace import Workspace, new_workspace
from filters.records import Estimate

SOUND, PREDICTOR = -1, -2


class ModularHistory(NamedTuple):
    """The estimate at the end of every step, with what had arrived by then.

    x (steps + 1, numbers); P (steps + 1, n, n): the covariance of its error, of length n.
    """

    x: FloatArray
    P: FloatArray


class Memory(NamedTuple):
    """The last steps, each at its number modulo their count: predictions x (count, numbers) and P (count, n, n).

    known (count, sensors): which measurement of each sensor was taken in the step and has arrived; -1: none.
    """

    x: FloatArray
    P: FloatArray
    known: IntArray


def chain(expects: Sequence[Callable[..., None]]) -> Callable[..., None]:
    """correct(number, parts, of, before, y, after): the correction by the sensor of this number.

    parts: (view, observed space, workspace) of the first sensor, then the parts of the others: ((...), ((...), ())).
    Correctors differ in the types of what they take, and compiled code cannot choose among types by a number.
    """
    rest: Callable[..., None] = _no_such_sensor
    for expect in reversed(expects):
        rest = _first_or(expect, rest)
    return rest


def _first_or(expect: Callable[..., None], rest: Callable[..., None]) -> Callable[..., None]:
    def correct(number: int, parts: Any, of: Space, before: Estimate, y: FloatArray, after: Estimate) -> None:
        if number == 0:
            view, observed, work = parts[0]
            correct_with(expect, view, observed, of, before, y, after, work)
        else:
            rest(number - 1, parts[1], of, before, y, after)

    return correct


def _no_such_sensor(_number: int, _parts: Any, _of: Space, _before: Estimate, _y: FloatArray, _after: Estimate) -> None:
    pass


def filter_all(
    predict: Callable[..., None],
    correct: Callable[..., None],
    motion: Any,
    parts: Any,
    of: Space,
    dt: float,
    inputs: FloatArray,
    arrived: Arrivals,
    memory: Memory,
    history: ModularHistory,
    current: Estimate,
    corrected: Estimate,
    work: Workspace,
) -> tuple[int, int]:
    """The whole filter as one kernel; memory holds the start as the prediction for step 0, history is filled.

    current, corrected: scratch. Returns SOUND and the last step, or the number of the sensor, or PREDICTOR, that left
    an estimate that is none, and the step.
    """
    count, sensors = memory.known.shape
    following = 0
    for j in range(len(inputs) + 1):
        for s in range(sensors):
            memory.known[j % count, s] = -1
        first = j
        while following < len(arrived.arrives) and arrived.arrives[following] == j:
            memory.known[arrived.taken[following] % count, arrived.sensor[following]] = following
            first = min(first, arrived.taken[following])
            following += 1
        for i in range(first, j + 1):
            at = Estimate(memory.x[i % count], memory.P[i % count])
            if i > first or 0 < i == j:
                predict(motion, of, current, inputs[i - 1], dt, at, work)
                if not is_sound(at):
                    return PREDICTOR, i
            _copy_estimate(at, current)
            for s in range(sensors):
                number = memory.known[i % count, s]
                if number >= 0:
                    correct(s, parts, of, current, arrived.y[number], corrected)
                    if not is_sound(corrected):
                        return s, i
                    _copy_estimate(corrected, current)
        store_vector(current.x, history.x, j)
        store(current.P, history.P, j)
    return SOUND, len(inputs)


def is_sound(estimate: Estimate) -> bool:
    """Whether all numbers of x are finite and no variance is negative or nan."""
    sound = True
    for value in estimate.x:
        sound = sound and bool(np.isfinite(value))
    for i in range(estimate.P.shape[0]):
        sound = sound and bool(estimate.P[i, i] >= 0.0)
    return sound


def _copy_estimate(source: Estimate, out: Estimate) -> None:
    copy_vector(source.x, out.x)
    copy(source.P, out.P)


def run(
    composed: ModularFilter,
    x0: FloatArray,
    P0: FloatArray,
    inputs: FloatArray,
    measurements: Iterable[Measurement],
    *,
    history: int | None = None,
    backend: BackendName = "compiled",
) -> ModularHistory:
    """Filter a record of data; each measurement is used from the step on in which it arrives, in whatever order.

    x0 (numbers,), P0 (n, n): estimate and covariance at step 0, before its measurements.
    inputs (steps, any): row j takes the state from j to j + 1; np.zeros((steps, 0)) if there are none.
    history: how many steps the filter can go back; if not given, as many as the sensors' longest delay.
    backend: "compiled" takes seconds the first time and is then some hundred times as fast as "reference".

    Raises:
        ValueError: a shape is wrong, P0 is not positive definite, a measurement does not fit (see
            `measurements.arrivals`), or an estimate breaks down; it says which sensor and step.
    """
    x, P = check_start(composed.of, x0, P0)
    moves = np.ascontiguousarray(inputs, dtype=np.float64)
    if moves.ndim != 2:
        raise ValueError(f"inputs has shape {moves.shape}; needed is (steps, inputs of the predictor)")
    steps, of = len(moves), composed.of
    depth = max((sensor.delay for sensor in composed.sensors), default=0) if history is None else history
    arrived = arrivals(composed, measurements, steps, depth)
    count, n = depth + 1, of.errors
    memory = Memory(
        np.zeros((count, of.numbers)), np.zeros((count, n, n)), np.full((count, len(composed.sensors)), -1, np.int64)
    )
    memory.x[0], memory.P[0] = x, P
    found = ModularHistory(np.empty((steps + 1, of.numbers)), np.empty((steps + 1, n, n)))
    culprit, step = function_for(backend, filter_all)(
        arguments_for(backend, composed.predictor.predict),
        arguments_for(backend, chain([sensor.corrector.expect for sensor in composed.sensors])),
        arguments_for(backend, composed.predictor.motion),
        arguments_for(backend, _parts(composed)),
        of,
        composed.dt,
        moves,
        arrived,
        memory,
        found,
        Estimate(np.empty(of.numbers), np.empty((n, n))),
        Estimate(np.empty(of.numbers), np.empty((n, n))),
        new_workspace(of, space(0)),
    )
    if culprit != SOUND:
        raise breakdown(composed, culprit, step)
    return found


def breakdown(composed: ModularFilter, culprit: int, step: int) -> ValueError:
    """The error that says which part of a filter left an estimate that is none."""
    part = "predictor" if culprit == PREDICTOR else f"sensor {composed.sensors[culprit].name!r}"
    return ValueError(
        f"{part}, step {step}: the covariance is no longer positive definite, or a value is no longer finite; give "
        f"more noise (Q, R) or a smaller P0, or spread sigma points with alpha = 1, which leaves no weight negative"
    )


def _parts(composed: ModularFilter) -> Any:
    parts: Any = ()
    for sensor in reversed(composed.sensors):
        corrector = sensor.corrector
        work = new_workspace(composed.of, corrector.observed)
        parts = ((corrector.view(composed.of.errors), corrector.observed, work), parts)
    return parts
