"""A parameter as a time-independent Gaussian random variable: the stiffness of the spring as a state of the filter.

What MacCormack and Rubinstein name as future work, in the smallest case: an unscented filter that knows that a spring
moves the mass, but its stiffness over the mass only as a Gaussian, constant number. It is set beside the poster's
filter, which knows of no spring, on the same measurements of the same uncertain oscillators.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName
from filters.modular import (
    ModularFilter,
    ModularHistory,
    Sensor,
    linear_corrector,
    run,
    unscented_corrector,
    unscented_predictor,
)
from studies.modular.nees import nees
from studies.modular.oscillator import FEW_SEEDS, USUAL
from studies.modular.oscillator_run import (
    ACCELERATION_SIGMA,
    OSCILLATOR,
    POSITION_SIGMA_M,
    SETTLED_PERIODS,
    Record,
    arriving,
    estimate,
    oscillation,
    start,
    step_s,
)
from studies.modular.typical import UNLUCKY, Quantile, quantile
from studies.modular.uncertain import oscillator_of

Progress: TypeAlias = Callable[[int, int, str], None]

SPREAD = 0.1
"""Of mass and of spring, over their nominal values."""
DROPOUTS = (0.1, 0.5, 0.8, 0.95, 0.99)

NOMINAL = OSCILLATOR.spring_n_m / OSCILLATOR.mass_kg
SIGMA = np.sqrt(2.0) * SPREAD * NOMINAL
"""Stiffness over mass, rad^2/s^2: what the filter is told of it."""
DECAY = OSCILLATOR.damping_n_s_m / (2 * OSCILLATOR.mass_kg)
LEAST = 0.01
"""The slowest oscillation squared that a sigma point may have, rad^2/s^2."""
FORCE_NOISE = 0.01
"""White acceleration, m/s^2/sqrt(Hz): for the damping, which the filter takes for nominal."""


class Row(NamedTuple):
    """One dropout. unaware, aware: RMS errors of position in m of a typical run, without the spring and with its
    stiffness as a state; unlucky: of the latter, exceeded by one run in 20. nees: of its three states, typical, 3 if it
    is as accurate as it says. stiffness: how far its estimate at the end is from the truth, over the nominal value."""

    dropout: float
    runs: int
    unaware: Quantile
    aware: Quantile
    unlucky: Quantile
    nees: Quantile
    stiffness: Quantile


def parameter_study(
    seeds: Sequence[int] = FEW_SEEDS,
    backend: BackendName = "compiled",
    progress: Progress = lambda _done, _total, _what: None,
) -> tuple[Row, ...]:
    """A row for each dropout, of the same oscillators."""
    records = [oscillation(USUAL, seed, oscillator_of(seed, SPREAD)) for seed in seeds]
    rows = []
    for done, dropout in enumerate(DROPOUTS):
        progress(done, len(DROPOUTS), f"stiffness as a state, {100 * dropout:g} % dropout")
        rows.append(_row(records, dropout, backend))
    progress(len(DROPOUTS), len(DROPOUTS), "stiffness as a state")
    return tuple(rows)


def _row(records: Sequence[Record], dropout: float, backend: BackendName) -> Row:
    settled = slice(SETTLED_PERIODS * USUAL.rate, None)
    unaware, aware, squared, stiffness = [], [], [], []
    for record in records:
        seen = arriving(record, dropout)
        without, found = estimate(record, USUAL, seen, backend), tracked(record, dropout, backend)
        errors = found.x - truth_of(record)
        unaware.append(_rms(without.x[settled, 0] - record.truth[settled, 0]))
        aware.append(_rms(errors[settled, 0]))
        squared.append(float(nees(errors[settled], found.P[settled]).mean()))
        stiffness.append(abs(errors[-1, 2]) / NOMINAL)
    return Row(
        dropout,
        len(records),
        quantile(np.array(unaware)),
        quantile(np.array(aware)),
        quantile(np.array(aware), UNLUCKY),
        quantile(np.array(squared)),
        quantile(np.array(stiffness)),
    )


def tracked(record: Record, dropout: float, backend: BackendName = "compiled") -> ModularHistory:
    """What the filter with the stiffness makes of a run; its states are position, velocity, stiffness over mass."""
    x0, P0 = start()
    x0[2], P0[2, 2] = NOMINAL, SIGMA**2
    inputs = np.zeros((len(record.truth) - 1, 0))
    return run(stiffness_filter(), x0, P0, inputs, arriving(record, dropout), history=0, backend=backend)


def truth_of(record: Record) -> FloatArray:
    """(steps + 1, 3): position, velocity, stiffness over mass, from the motion itself."""
    oscillator = oscillator_of(record.seed, SPREAD)
    stiffness = np.full(len(record.truth), oscillator.spring_n_m / oscillator.mass_kg)
    return np.column_stack([record.truth[:, :2], stiffness])


def stiffness_filter() -> ModularFilter:
    """Unscented predictor and accelerometer; the stiffness has no process noise."""
    dt_s = step_s(USUAL)
    pushed = FORCE_NOISE**2 * np.array([[dt_s**3 / 3, dt_s**2 / 2], [dt_s**2 / 2, dt_s]])
    Q = np.zeros((3, 3))
    Q[:2, :2] = pushed
    sensors = [
        Sensor("position", linear_corrector([[1.0, 0.0, 0.0]], [[POSITION_SIGMA_M**2]])),
        Sensor("acceleration", unscented_corrector(accelerated, [[ACCELERATION_SIGMA**2]])),
    ]
    return ModularFilter(unscented_predictor(swing_on, Q), sensors, dt_s)


def swing_on(x: FloatArray, _u: FloatArray, dt: float, out: FloatArray) -> None:
    """The state a time dt on, exactly."""
    rate = np.sqrt(max(x[2] - DECAY * DECAY, LEAST))
    fade, cosine, sine = np.exp(-DECAY * dt), np.cos(rate * dt), np.sin(rate * dt) / rate
    position = fade * (x[0] * cosine + (x[1] + DECAY * x[0]) * sine)
    out[1] = fade * (x[1] * cosine - (x[2] * x[0] + DECAY * x[1]) * sine)
    out[0] = position
    out[2] = x[2]


def accelerated(x: FloatArray, out: FloatArray) -> None:
    """The acceleration at this state."""
    out[0] = -x[2] * x[0] - 2.0 * DECAY * x[1]


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2)))
