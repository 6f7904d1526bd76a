"""The dual rate filter for linear or extended parts, Steffes 2014, Eqs. (13) to (19): of one sensor that measures every
so many steps, on plain quantities. Any others are `dual_rate_in_flight`.

The tasks are those of `filters.delayed.dual_rate`: the high-rate one carries state, Phi and Q, the low-rate one has the
covariance at the steps k in which the sensor measures, and its correction is added L steps later. In the steps between
the estimate is that of a filter which has not got the measurement yet. One that is missing leaves its cycle without
correction.

Several of the sensor may be in flight, L more than the steps between them. The low-rate task takes them first in, first
out: the covariance of a step k waits for the correction of the k before, in whatever order the measurements arrive. A
correction lands by the products of the cycles that it spans, one after the other, and on its way corrects what was
known in each k in between, from which those that follow are formed.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import islice
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from filters.arrays import Flags, FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.covariance_forms import covariance_form
from filters.delayed.high_rate_task import HighRateTask
from filters.delayed.low_rate_noise import NOISE_METHODS
from filters.modular import dual_rate_in_flight
from filters.modular.arrivals import Arrivals, TooOld, arrivals, in_order
from filters.modular.as_system import composed_system
from filters.modular.breakdown import PREDICTOR, Failure, breakdown
from filters.modular.composition import ModularFilter, Sensor
from filters.modular.correction import correction
from filters.modular.dual_rate_in_flight import landings
from filters.modular.estimate import empty, is_sound
from filters.modular.history import ModularHistory, new_estimates
from filters.modular.low_rate import lr_propagate
from filters.modular.measurements import Measurement
from filters.modular.problem import check_linearised, check_problem
from filters.modular.workspace import new_workspace
from filters.records import Estimate, Transition
from filters.running import running


def run(
    composed: ModularFilter,
    x0: ArrayLike,
    P0: ArrayLike,
    inputs: ArrayLike,
    measurements: Iterable[Measurement],
    *,
    L: int | Mapping[str, int] | None = None,
    too_old: TooOld = "refuse",
    backend: BackendName = "reference",
) -> ModularHistory:
    """Filter a record of data; the measurement of step k corrects the estimate at the start of step k + L.

    Other arguments and results as in `late.run`. L: more than the delay, of all sensors, or by the name of each; if not
    given, the sensor's `every`, or the first multiple of it that is. too_old: what is done with a measurement that
    arrives in step k + L or later: "refuse", or "drop" it.

    Raises:
        ValueError: a part is unscented; L does not fit a sensor; a measurement arrives too late for L; and as
            `late.run`.
    """
    check_linearised(composed, "dual-rate")
    measurements = in_order(measurements)
    if not _in_cycles(composed, measurements):
        return dual_rate_in_flight.run(composed, x0, P0, inputs, measurements, L=L, too_old=too_old, backend=backend)
    (sensor,) = composed.sensors
    N, lands = int(sensor.every), landings(composed, L)[sensor.name]
    x, P, moves = check_problem(composed, x0, P0, inputs)
    oldest = lands - 1 if too_old == "drop" else len(moves)
    arrived, dropped = arrivals(composed, measurements, len(moves), oldest, too_old)
    _check_arrivals(sensor, arrived, lands)
    low_rate = LowRateTask(composed, sensor, Estimate(x, P), backend)
    system = composed_system(composed, P, moves.shape[1])
    high_rate = HighRateTask(system, N, N, x, NOISE_METHODS["exact"], covariance_form("short"), backend)
    estimates = new_estimates(composed.of, len(moves))
    following, scratch = 0, np.empty_like(P)
    with running("filter"):
        for j in range(len(moves) + 1):
            if j > 0:
                high_rate.step(j - 1, moves[j - 1])
            if low_rate.lands(j, lands):
                delta_x = low_rate.hand_over()
                if delta_x is not None:
                    last_k = (j - 1) // N * N
                    high_rate.correct(last_k, j - last_k, delta_x)
            transition = high_rate.message(j).transition
            if j % N == 0:
                low_rate.begin(Cycle(j, high_rate.x, transition, []))
            estimates.x[j] = high_rate.x
            estimates.P[j] = P = low_rate.covariance(None if j % N == 0 else transition)
            if not is_sound(composed.of, Estimate(high_rate.x, P), scratch):
                before = Failure(Estimate(estimates.x[j - 1], estimates.P[j - 1]), Estimate(high_rate.x, P))
                raise breakdown(composed, PREDICTOR, j, before, moves[j - 1])
            while following < len(arrived.arrives) and arrived.arrives[following] == j:
                low_rate.await_turn(arrived.taken[following], (arrived.y[following], arrived.lost[following]))
                following += 1
            for correction in low_rate.correct():
                if not is_sound(composed.of, correction.after, scratch):
                    raise breakdown(composed, 0, j, correction, np.empty(0))
    return ModularHistory(*estimates, dropped)


class Cycle(NamedTuple):
    """A step k and the one before. x (n,): of k, without its measurements, with the corrections of those before that
    have landed; transition: to k; arrived: its measurements that have and are not used yet, y and lost."""

    k: int
    x: FloatArray
    transition: Transition | None
    arrived: list[tuple[FloatArray, Flags]]


class LowRateTask:
    """The cycles whose corrections have not landed; of the first the estimate `before` its measurements, and `after`
    those that have arrived. If there is none, `after` is of the last."""

    def __init__(self, composed: ModularFilter, sensor: Sensor, start: Estimate, backend: BackendName) -> None:
        corrector = sensor.corrector
        self._of, self._observed = composed.of, corrector.observed
        self._work = new_workspace(composed.of, corrector.observed)
        self._view = arguments_for(backend, corrector.view(composed.of.errors))
        self._propagate = function_for(backend, lr_propagate)
        self._correct = function_for(backend, correction(composed, corrector))
        self._cycles: deque[Cycle] = deque()
        self._before = self._after = start

    def begin(self, cycle: Cycle) -> None:
        """A new k."""
        self._cycles.append(cycle)
        if len(self._cycles) == 1:
            self._start()

    def _start(self) -> None:
        """The first cycle's turn has come."""
        first = self._cycles[0]
        self._before = self._after = Estimate(first.x, self._carried(self._after.P, first.transition))

    def covariance(self, transition: Transition | None) -> FloatArray:
        """With what has landed, carried over the transition from the last k; for the history, save at each k."""
        P = self._before.P if self._cycles else self._after.P
        for cycle in islice(self._cycles, 1, None):
            P = self._carried(P, cycle.transition)
        return self._carried(P, transition)

    def _carried(self, P: FloatArray, transition: Transition | None) -> FloatArray:
        if transition is None:
            return P
        P_next = np.empty_like(P)
        self._propagate(P, transition, P_next, self._work)
        return P_next

    def await_turn(self, k: int, measurement: tuple[FloatArray, Flags]) -> None:
        """A measurement of k has arrived."""
        next(cycle for cycle in self._cycles if cycle.k == k).arrived.append(measurement)

    def correct(self) -> Iterator[Failure]:
        """Use those of the first cycle; each with what was before and after it."""
        waiting = self._cycles[0].arrived if self._cycles else []
        for y, lost in waiting:
            before, self._after = self._after, empty(self._of)
            self._correct(self._view, self._observed, self._of, before, y, lost, self._after, self._work)
            yield Failure(before, self._after)
        waiting.clear()

    def lands(self, j: int, L: int) -> bool:
        """Whether the correction of the first cycle does in step j, if it has one."""
        return bool(self._cycles) and self._cycles[0].k + L == j

    def hand_over(self) -> FloatArray | None:
        """What it lands, the error estimate (n,) of the last k; None if there was no measurement. It is the next's
        turn."""
        delta_x = None if self._after is self._before else self._after.x - self._before.x
        self._cycles.popleft()
        if delta_x is not None:
            for number, cycle in enumerate(self._cycles):
                assert cycle.transition is not None  # only the first of all has none
                delta_x = cycle.transition.Phi @ delta_x
                self._cycles[number] = cycle._replace(x=cycle.x + delta_x)
        if self._cycles:
            self._start()
        return delta_x


def _in_cycles(composed: ModularFilter, measurements: Sequence[Measurement]) -> bool:
    """Whether one sensor takes them, of plain quantities, each at the start of a cycle of whole steps."""
    if len(composed.sensors) != 1 or len(composed.of.attitudes) or len(composed.of.angles):
        return False
    (sensor,) = composed.sensors
    observed = sensor.corrector.observed
    return not (len(observed.attitudes) or len(observed.angles) or isinstance(sensor.every, Fraction)) and all(
        one.taken % sensor.every == 0 for one in measurements
    )


def _check_arrivals(sensor: Sensor, arrived: Arrivals, L: int) -> None:
    for k, m in zip(arrived.taken, arrived.arrives, strict=True):
        where = f"sensor {sensor.name!r}, measurement of step {k}"
        if m >= k + L:
            raise ValueError(
                f"{where}: it arrives in step {m}, and its correction lands in step {k + L}; give a greater L, use "
                f"late='recalculate', or too_old='drop'"
            )
