"""One run of the filter that tracks an oscillator without knowing of its spring, and what is called its residual.

Three readings are kept apart: the error of the estimate from the truth; the innovation, a measurement less its
prediction; and what is left of a measurement once the estimate has used it.
"""

from __future__ import annotations

from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName
from filters.modular import Measurement, ModularFilter, ModularHistory, observe, run
from filters.normal import normal
from filters.systems.spring_mass import (
    ACCELERATION,
    POSITION,
    Instrument,
    Oscillator,
    frequency,
    motion,
    period_s,
    tracker,
    transition,
    white_jerk,
)

Losing: TypeAlias = Literal["both", "position", "acceleration"]

OSCILLATOR = Oscillator()
AMPLITUDES = frequency(OSCILLATOR) ** np.arange(3.0)
"""Position, velocity and acceleration at the start: 1 m, omega and omega^2."""

POSITION_SIGMA_M, ACCELERATION_SIGMA = 0.05 * AMPLITUDES[0], 0.05 * AMPLITUDES[2]
PERIODS, SETTLED_PERIODS = 10, 2
"""How long a run is, and from when on its errors count."""

SENSORS = {"position": POSITION, "acceleration": ACCELERATION}
PHASE, LOSS, JERK = 10, 11, 12
"""Streams of random numbers beside those of the sensors, which are 0 and 1."""


class Setting(NamedTuple):
    """rate: measurements of each sensor in a period of the oscillator. losing: which sensors drop measurements.

    tuning: the filter's white jerk over omega^2.5 times the amplitude. The true jerk has variance omega^6 / 2 and
    changes in a time of 1 / omega, which makes 1 the value to start from.
    """

    rate: int = 100
    tuning: float = 1.0
    losing: Losing = "both"


class Record(NamedTuple):
    """The truth (steps + 1, 3) of a run, and what the sensors would measure along it without dropout."""

    seed: int
    truth: FloatArray
    measurements: list[Measurement]


class Residuals(NamedTuple):
    """The settled part of a run.

    error (steps, 3) and P (steps, 3, 3): estimate less truth, and what the filter takes for its covariance.
    innovation, after: of position and of acceleration (count,), measured less predicted and less estimated.
    """

    error: FloatArray
    P: FloatArray
    innovation: tuple[FloatArray, FloatArray]
    after: tuple[FloatArray, FloatArray]


def filter_of(setting: Setting) -> ModularFilter:
    """The tracker, which is told the size of the motion and its time scale, but not that it comes back."""
    jerk_noise = setting.tuning * frequency(OSCILLATOR) ** 2.5
    return tracker(step_s(setting), jerk_noise, Instrument(POSITION_SIGMA_M), Instrument(ACCELERATION_SIGMA))


def step_s(setting: Setting) -> float:
    """The time of a step."""
    return period_s(OSCILLATOR) / setting.rate


def start() -> tuple[FloatArray, FloatArray]:
    """x0 (3,) and P0 (3, 3): an oscillation of this size, of which nothing else is known."""
    return np.zeros(3), np.diag(AMPLITUDES**2 / 2)


def oscillation(setting: Setting, seed: int, oscillator: Oscillator = OSCILLATOR) -> Record:
    """The oscillator, from a random phase; of whichever mass and spring, the filter is told of `OSCILLATOR` only."""
    phase = np.random.default_rng([seed, PHASE]).uniform(0, 2 * np.pi)
    time_s = step_s(setting) * np.arange(PERIODS * setting.rate + 1)
    truth = motion(oscillator, time_s, np.cos(phase), -frequency(oscillator) * np.sin(phase))
    return Record(seed, truth, observe(filter_of(setting), truth, seed))


def own_model(setting: Setting, seed: int) -> Record:
    """A motion that is what the filter takes it to be: of white jerk, from a start as uncertain as the filter's."""
    random, composed = np.random.default_rng([seed, JERK]), filter_of(setting)
    x0, P0 = start()
    F, Q = transition(composed.dt), white_jerk(composed.dt, setting.tuning * frequency(OSCILLATOR) ** 2.5)
    truth = np.empty((PERIODS * setting.rate + 1, 3))
    truth[0] = x0 + normal(random, P0)
    moves = random.multivariate_normal(np.zeros(3), Q, size=len(truth) - 1, method="cholesky")
    for j, move in enumerate(moves):
        truth[j + 1] = F @ truth[j] + move
    return Record(seed, truth, observe(composed, truth, seed))


def arriving(record: Record, dropout: float, losing: Losing = "both") -> list[Measurement]:
    """The measurements that get through: each has a number of its own, so that with more dropout fewer of them do.

    As in `filters.modular.observe`, which would measure anew for each dropout.
    """
    draws = np.random.default_rng([record.seed, LOSS]).random(len(record.measurements))
    return [
        measurement
        for measurement, draw in zip(record.measurements, draws, strict=True)
        if draw >= dropout or losing not in ("both", measurement.sensor)
    ]


def estimate(
    record: Record, setting: Setting, measurements: list[Measurement], backend: BackendName = "compiled"
) -> ModularHistory:
    """What the filter makes of these measurements."""
    return run(
        filter_of(setting), *start(), np.zeros((len(record.truth) - 1, 0)), measurements, history=0, backend=backend
    )


def residuals(record: Record, setting: Setting, dropout: float, backend: BackendName = "compiled") -> Residuals:
    """Residuals of one run."""
    measurements = arriving(record, dropout, setting.losing)
    history = estimate(record, setting, measurements, backend)
    settled = SETTLED_PERIODS * setting.rate
    predicted = np.vstack([start()[0], history.x[:-1] @ transition(step_s(setting)).T])
    innovation, after = [], []
    for name, seen in SENSORS.items():
        mine = [
            measurement for measurement in measurements if measurement.sensor == name and measurement.taken >= settled
        ]
        taken = np.array([measurement.taken for measurement in mine], dtype=np.int64)
        y = np.array([measurement.y[0] for measurement in mine if measurement.y is not None])
        innovation.append(y - predicted[taken, seen])
        after.append(y - history.x[taken, seen])
    error = history.x[settled:] - record.truth[settled:]
    return Residuals(error, history.P[settled:], (innovation[0], innovation[1]), (after[0], after[1]))
