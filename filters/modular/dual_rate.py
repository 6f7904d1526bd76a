"""The dual rate filter for one sensor and linear or extended parts: Steffes 2014, Eqs. (13) to (19).

The tasks are those of `filters.dual_rate`: the high-rate one carries state, Phi and Q, the low-rate one has the
covariance at the steps k in which the sensor measures, and its correction is added L steps later. In the steps between
the estimate is that of a filter which has not got the measurement yet. One that is missing leaves its cycle without
correction.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from filters.arrays import FloatArray
from filters.covariance_forms import covariance_form
from filters.dual_rate import HighRateTask, LowRateTask
from filters.kernels.backends import BackendName
from filters.low_rate_noise import NOISE_METHODS
from filters.modular.composition import ModularFilter, Sensor
from filters.modular.estimate import is_sound
from filters.modular.history import PREDICTOR, ModularHistory, breakdown, new_history
from filters.modular.measurements import Arrivals, Measurement, arrivals
from filters.modular.problem import check_linearised, check_problem
from filters.modular.running import running
from filters.records import Correction, Estimate


def run(
    composed: ModularFilter,
    x0: FloatArray,
    P0: FloatArray,
    inputs: FloatArray,
    measurements: Iterable[Measurement],
    *,
    L: int | None = None,
    backend: BackendName = "reference",
) -> ModularHistory:
    """Filter a record of data; the measurement of step k corrects the estimate at the start of step k + L.

    Other arguments and results as in `late.run`. L: more than the delay, and at most the sensor's `every`, which it is
    if not given.

    Raises:
        ValueError: there is not exactly one sensor, a part is unscented, or not all quantities are plain; L does not
            fit the sensor; a measurement is taken between the sensor's steps or arrives too late for L; and as
            `late.run`.
    """
    from filters.systems.composed import composed_system  # which is made of parts of this package

    check_linearised(composed, "dual-rate")
    sensor = _only_sensor(composed)
    N, lands = sensor.every, sensor.every if L is None else L
    _check_landing(sensor, lands)
    x, P, moves = check_problem(composed, x0, P0, inputs)
    arrived = arrivals(composed, measurements, len(moves), len(moves))
    _check_arrivals(sensor, arrived, lands)
    system = composed_system(composed, P, moves.shape[1])
    noise, form = NOISE_METHODS["exact"], covariance_form("short")
    high_rate = HighRateTask(system, N, x, noise, form, backend)
    low_rate = LowRateTask(system, P, noise, form, "at-update", backend)
    taken = {int(k) for k in arrived.taken}
    at = {int(m): y for m, y in zip(arrived.arrives, arrived.y, strict=True)}
    found = new_history(composed.of, len(moves))

    correction: Correction | None = None
    before_or_after = P  # P_{k^-} of the last k, and P_{k^+} once the correction has landed
    with running():
        for j in range(len(moves) + 1):
            if j > 0:
                high_rate.step(j - 1, moves[j - 1])
            if correction is not None and j % N == lands % N:
                high_rate.correct(lands, correction.delta_x)
                correction, before_or_after = None, low_rate.P
            if j % N == 0:
                found.P[j] = before_or_after = low_rate.propagate(high_rate.message(j), measured=j in taken)
            else:
                Phi, Q = high_rate.message(j).transition
                found.P[j] = Phi @ before_or_after @ Phi.T + Q  # for the history; the filter does not need it
            found.x[j] = high_rate.x
            if not is_sound(Estimate(found.x[j], found.P[j])):
                raise breakdown(composed, PREDICTOR, j)
            if j in at:
                correction = low_rate.update(at[j])
                if not is_sound(Estimate(correction.delta_x, low_rate.P)):
                    raise breakdown(composed, 0, j)
    return found


def _only_sensor(composed: ModularFilter) -> Sensor:
    if len(composed.sensors) != 1:
        names = ", ".join(repr(sensor.name) for sensor in composed.sensors) or "none"
        raise ValueError(
            f"late='dual-rate' works with one sensor, and the filter's are {names}; use late='recalculate' or 'larsen'"
        )
    (sensor,) = composed.sensors
    observed = sensor.corrector.observed
    if len(composed.of.attitudes) or len(composed.of.angles):
        raise ValueError(
            "late='dual-rate' adds its corrections to plain quantities, and the filter's state holds attitudes or "
            "angles; use late='recalculate' or 'larsen'"
        )
    if len(observed.attitudes) or len(observed.angles):
        raise ValueError(
            f"sensor {sensor.name!r}: late='dual-rate' subtracts plain quantities, and it observes attitudes or "
            f"angles; use late='recalculate' or 'larsen'"
        )
    return sensor


def _check_landing(sensor: Sensor, L: int) -> None:
    if not (isinstance(L, int | np.integer) and sensor.delay < L <= sensor.every):
        raise ValueError(
            f"sensor {sensor.name!r}: L={L!r} must be a whole number, more than delay={sensor.delay} and at most "
            f"every={sensor.every}: the correction lands after the measurement has arrived and no later than the next "
            f"is taken; give such an L, or use late='recalculate'"
        )


def _check_arrivals(sensor: Sensor, arrived: Arrivals, L: int) -> None:
    for k, m in zip(arrived.taken, arrived.arrives, strict=True):
        where = f"sensor {sensor.name!r}, measurement of step {k}"
        if k % sensor.every:
            raise ValueError(
                f"{where}: late='dual-rate' takes them every {sensor.every} steps from step 0 on; use "
                f"late='recalculate', or leave it out"
            )
        if m >= k + L:
            raise ValueError(
                f"{where}: it arrives in step {m}, and its correction lands in step {k + L}; give a greater L, use "
                f"late='recalculate', or leave it out"
            )
