"""How much dropout does a filter bear? The oscillator of MacCormack and Rubinstein, tracked without its spring.

"Dropout rates of 10% through 99% were tested on the spring-mass system, and model predictive quality remained mostly
unaffected up to sensor dropout of 80%." The poster says neither how fast it samples nor what its residual is, and the
two decide it.

The error of the estimate from the truth is more than doubled from 10 % to 80 %, however fast one samples: of 4.5 times
fewer measurements the mean is 2.1 times worse. If each sensor measures a hundred times in a period of the motion, the
position's is then about the error of one measurement, and explodes beyond; with 20 in a period it does so at once, with
400 at 95 %. What counts most is the mean time between measurements that get through, over that period: up to 0.05 the
claim holds in this sense. There the error still differs by a factor of 1.7: it is least with 20 in a period, none of
which is lost, as their gaps are all alike, and greatest with 400, of which 95 % are. The innovation of position, mostly
measurement noise, rises by half up to there. What is left of a measurement after the update only falls, so that it says
nothing about the filter.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName
from studies.modular.nees import Consistency, consistency
from studies.modular.oscillator_run import (
    AMPLITUDES,
    POSITION_SIGMA_M,
    SENSORS,
    Record,
    Setting,
    arriving,
    estimate,
    oscillation,
    own_model,
    residuals,
    step_s,
)

Progress: TypeAlias = Callable[[int, int, str], None]

USUAL = Setting()
KEEN = Setting(tuning=0.3)
"""With less process noise: the filter believes its model more."""

ONE_SENSOR = (Setting(losing="position"), Setting(losing="acceleration"))

DROPOUTS = (0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.98, 0.99)
FEW_DROPOUTS = (0.0, 0.1, 0.5, 0.8, 0.9, 0.95, 0.98, 0.99)
RATES = (20, 50, 200, 400)
"""Beside the usual one."""

LOWEST = 0.1
"""The dropout that the poster starts from."""

BORNE = 0.05
"""The mean time between measurements that get through, in periods, from which on the error explodes."""

SEEDS = tuple(range(400))
OWN_MODEL_SEEDS = SEEDS[:100]
FEW_SEEDS = SEEDS[:200]


class Row(NamedTuple):
    """One dropout.

    interval: mean time between measurements that get through, of a sensor that drops some, in periods.
    All root mean squares, of each run: error (runs, 3), of the estimate from the truth, in m, m/s, m/s^2;
    innovation, after (runs, 2), position and acceleration, measured less predicted, and less estimated with it, nan
    where nothing was measured. still (3,): of an estimate that says that nothing moves, over the amplitude, all runs.
    """

    setting: Setting
    dropout: float
    runs: int
    interval: float
    still: FloatArray
    error: FloatArray
    innovation: FloatArray
    after: FloatArray
    consistency: Consistency


class History(NamedTuple):
    """One run; the poster's Figure 2.

    time_s (steps + 1,); truth, estimate, sigma (steps + 1, 3): sigma is the standard deviation that the filter gives.
    position, acceleration (count, 2): time and value of the measurements that got through.
    """

    time_s: FloatArray
    truth: FloatArray
    estimate: FloatArray
    sigma: FloatArray
    position: FloatArray
    acceleration: FloatArray


class DropoutStudy(NamedTuple):
    """rows: the usual setting; keen: with less process noise. by_rate, by_sensor: fewer runs and dropouts, of each rate
    the one that is `borne` among them.

    own_model: the usual filter where its own model is the truth, the check of NEES.
    """

    rows: tuple[Row, ...]
    keen: tuple[Row, ...]
    by_rate: tuple[Row, ...]
    by_sensor: tuple[Row, ...]
    own_model: tuple[Row, ...]


def dropout_study(progress: Progress = lambda _done, _total, _what: None) -> DropoutStudy:
    """The whole study."""
    progress(0, 4, "dropout")
    records = [oscillation(USUAL, seed) for seed in SEEDS]
    usual, keen = rows(records, USUAL), rows(records, KEEN)
    progress(1, 4, "one sensor alone")
    few = records[: len(FEW_SEEDS)]
    by_sensor = tuple(row for setting in ONE_SENSOR for row in rows(few, setting, FEW_DROPOUTS))
    progress(2, 4, "sampling rates")
    by_rate = tuple(row for rate in RATES for row in rows_of_rate(rate))
    progress(3, 4, "the filter's own model")
    own = rows([own_model(USUAL, seed) for seed in OWN_MODEL_SEEDS], USUAL, FEW_DROPOUTS)
    progress(4, 4, "done")
    return DropoutStudy(usual, keen, by_rate, by_sensor, own)


def rows(
    records: Sequence[Record],
    setting: Setting,
    dropouts: Sequence[float] = DROPOUTS,
    backend: BackendName = "compiled",
) -> tuple[Row, ...]:
    """One for each dropout, all from the same records, of which more and more is lost."""
    return tuple(row(records, setting, dropout, backend) for dropout in dropouts)


def rows_of_rate(rate: int) -> tuple[Row, ...]:
    """Those of another sampling rate: few runs and dropouts, among them the one that is `borne`."""
    records = [oscillation(Setting(rate), seed) for seed in FEW_SEEDS]
    return rows(records, Setting(rate), sorted({*FEW_DROPOUTS, borne(rate)}))


def row(records: Sequence[Record], setting: Setting, dropout: float, backend: BackendName = "compiled") -> Row:
    """One dropout, all records."""
    runs = [residuals(record, setting, dropout, backend) for record in records]
    errors = np.array([run.error for run in runs])
    truths = np.array([record.truth[-errors.shape[1] :] for record in records])
    return Row(
        setting,
        dropout,
        len(records),
        1 / (setting.rate * (1 - dropout)),
        np.sqrt(np.mean(truths**2, axis=(0, 1))) / AMPLITUDES,
        np.sqrt(np.mean(errors**2, axis=1)),
        np.array([[_rms(sensor) for sensor in run.innovation] for run in runs]),
        np.array([[_rms(sensor) for sensor in run.after] for run in runs]),
        consistency(errors, np.array([run.P for run in runs])),
    )


def _rms(values: FloatArray) -> float:
    return float(np.sqrt(np.mean(values**2))) if len(values) else np.nan


def borne(rate: int) -> float:
    """The dropout up to which sensors with this many measurements in a period keep to `BORNE`: 1 - 20 / rate."""
    return max(0.0, 1 - 1 / (rate * BORNE))


def reach(sigma_m: float = POSITION_SIGMA_M) -> float:
    """How long, in periods, a motion of known acceleration and unknown jerk stays within sigma of its prediction.

    The jerk is omega^3 times the amplitude at most, and moves the position by a sixth of it times the time cubed.
    """
    return float((6 * sigma_m / AMPLITUDES[0]) ** (1 / 3) / (2 * np.pi))


def history_at(dropout: float, seed: int, setting: Setting = USUAL, backend: BackendName = "compiled") -> History:
    """One run to be looked at."""
    record = oscillation(setting, seed)
    measurements = arriving(record, dropout, setting.losing)
    history = estimate(record, setting, measurements, backend)
    dt_s = step_s(setting)
    seen = {
        name: np.array(
            [
                (measurement.taken * dt_s, measurement.y[0])
                for measurement in measurements
                if measurement.sensor == name and measurement.y is not None
            ]
        ).reshape(-1, 2)
        for name in SENSORS
    }
    sigma: FloatArray = np.sqrt(np.diagonal(history.P, axis1=1, axis2=2))
    time_s: FloatArray = dt_s * np.arange(float(len(history.x)))
    return History(time_s, record.truth, history.x, sigma, seen["position"], seen["acceleration"])
