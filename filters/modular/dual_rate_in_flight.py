"""The dual-rate filter of several sensors, with any delays, in any order of arrival; parts are linear or extended.

That a measurement is being taken is known in its step k, and the covariance does not depend on what it says. So the
low-rate task computes the gains in the order in which measurements are taken, from one to the next over the transition
that the high-rate task has accumulated; what arrives is used first in, first out, with the gain of its k; and it lands
in step k + L of its sensor, in whatever order, by the products of the transitions that it spans, see `low_rate`.

In every step the estimate is that of `carried_gain` if each measurement arrived in its step k + L: that of the filter
which got each undelayed, once nothing is in flight; for extended parts to first order. The covariance in the history is
that of its error.

In one step: first what lands, in the order in which it was taken, then what is taken, in the sensors' order, then what
arrives. Taken is what is in the record, as in `carried_gain`; what is lost, or comes too late, is known to be in k + L.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from math import ceil

import numpy as np
from numpy.typing import ArrayLike

from filters.arrays import without_mask
from filters.backends.choose import BackendName
from filters.modular.arrivals import LAST, TooOld, arrivals, in_order
from filters.modular.breakdown import PREDICTOR, Failure, breakdown
from filters.modular.composition import ModularFilter, Sensor
from filters.modular.estimate import is_sound
from filters.modular.high_rate import HighRate
from filters.modular.history import ModularHistory, new_estimates
from filters.modular.low_rate import Knot, LowRate
from filters.modular.measurements import Measurement
from filters.modular.problem import check_problem
from filters.records import Estimate
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
    """Filter a record of data; arguments, results and errors as in `dual_rate.run`."""
    lands = landings(composed, L)
    x, P, moves = check_problem(composed, x0, P0, inputs)
    steps, queue = len(moves), in_order(measurements)
    arrived = arrivals(composed, queue, steps, LAST, too_old, awaited=True)[0]
    of_sensor = np.array(list(lands.values()), dtype=np.int64)[arrived.sensor]
    late = arrived.arrives >= arrived.taken + of_sensor
    if too_old == "refuse":
        errors = np.array([sensor.corrector.observed.errors for sensor in composed.sensors])[arrived.sensor]
        there = arrived.lost.sum(axis=1) < errors
        for row in np.flatnonzero(late & there & (arrived.arrives <= steps)):
            name, k, m = composed.sensors[arrived.sensor[row]].name, arrived.taken[row], arrived.arrives[row]
            raise ValueError(
                f"sensor {name!r}, measurement of step {k}: it arrives in step {m}, and its correction lands in step "
                f"{k + lands[name]}; give a greater L, use late='carried-gain', or too_old='drop'"
            )
    dropped = tuple(
        one
        for one in queue
        if one.taken <= steps and one.taken + lands[one.sensor] <= one.arrives <= steps and not _is_lost(one)
    )
    arrived.lost[late] = True
    arrives = np.where(late, arrived.taken + of_sensor - 1, arrived.arrives)
    taking = np.lexsort((arrived.arrives, arrived.sensor, arrived.taken))
    arriving = np.lexsort((arrived.taken, arrives))
    estimates, scratch = new_estimates(composed.of, steps), np.empty_like(P)
    high_rate, low_rate = HighRate(composed, x, P, backend), LowRate(composed, P, backend)
    knots: dict[int, Knot] = {}
    taken = came = 0
    with running("filter"):
        for j in range(steps + 1):
            if j > 0:
                high_rate.step(moves[j - 1])
            predicted = high_rate.x
            for knot in low_rate.landing(j):
                high_rate.correct(low_rate.land(knot))
            now = Estimate(high_rate.x, low_rate.covariance(high_rate.transition))
            if not is_sound(composed.of, now, scratch):
                at = Estimate(estimates.x[j - 1], estimates.P[j - 1]) if j > 0 else now
                raise breakdown(composed, PREDICTOR, j, Failure(at, Estimate(predicted, now.P)), moves[max(j - 1, 0)])
            while taken < len(taking) and arrived.taken[taking[taken]] == j:
                number = int(taking[taken])
                sensor = int(arrived.sensor[number])
                knot = knots[number] = low_rate.take(sensor, j + int(of_sensor[number]), *high_rate.message())
                if not is_sound(composed.of, knot.after, scratch):
                    raise breakdown(composed, sensor, j, Failure(knot.before, knot.after), np.empty(0))
                taken += 1
            while came < len(arriving) and arrives[arriving[came]] == j:
                number = int(arriving[came])
                low_rate.arrive(knots.pop(number), arrived.y[number], arrived.lost[number])
                came += 1
            estimates.x[j], estimates.P[j] = now
    return ModularHistory(*estimates, dropped)


def _is_lost(measurement: Measurement) -> bool:
    return measurement.y is None or all(value is None for value in without_mask(measurement.y))


def landings(composed: ModularFilter, L: int | Mapping[str, int] | None) -> dict[str, int]:
    """L of each sensor, by name. Raises ValueError for one that does not fit its sensor, or is of none."""
    names = [sensor.name for sensor in composed.sensors]
    if isinstance(L, Mapping):
        for name in L:
            if name not in names:
                raise ValueError(f"L={dict(L)!r:.60}: {name!r} is none of the sensors; they are {', '.join(names)}")
    given = L if isinstance(L, Mapping) else {} if L is None else dict.fromkeys(names, L)
    found = {}
    for sensor in composed.sensors:
        lands = given.get(sensor.name, _first_of_a_cycle(sensor))
        _check_landing(sensor, lands)
        found[sensor.name] = int(lands)
    return found


def _first_of_a_cycle(sensor: Sensor) -> int:
    """The first multiple of `every` that is more than the delay, in whole steps."""
    return ceil(sensor.every * (sensor.longest_delay // sensor.every + 1))


def _check_landing(sensor: Sensor, L: int) -> None:
    if not (isinstance(L, int | np.integer) and sensor.longest_delay < L):
        raise ValueError(
            f"sensor {sensor.name!r}: L={L!r} must be a whole number, more than delay={sensor.longest_delay}: the "
            f"correction lands after the measurement has arrived; give such an L, or use late='recalculate'"
        )
