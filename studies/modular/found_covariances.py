"""Covariances found automatically: those of both sensors and of the jerk, from measurements alone.

MacCormack and Rubinstein name it as future work to approximate covariances automatically. Here they are those under
which the innovations of some runs are the likeliest (maximum likelihood; Mehra, On the identification of variances and
adaptive Kalman filtering, 1970), found by a quasi-Newton method from a start that is wrong by a factor of three: the
simplex method may stop on a slope of this likelihood, where the start still shows in what it finds. First on
runs of the filter's own model, whose covariances are known, so that what is found can be judged; then on the
oscillator, whose jerk is not white. Each set is then used on another run, which it has not seen.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import repeat
from typing import Literal, NamedTuple, TypeAlias, get_args

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName
from filters.modular import Measurement, ModularFilter, run
from filters.systems.spring_mass import Instrument, frequency, tracker, transition, white_jerk
from studies.modular.nees import nees
from studies.modular.oscillator import USUAL
from studies.modular.oscillator_run import (
    ACCELERATION_SIGMA,
    OSCILLATOR,
    POSITION_SIGMA_M,
    SENSORS,
    SETTLED_PERIODS,
    Record,
    oscillation,
    own_model,
    start,
    step_s,
)
from studies.modular.typical import UNLUCKY, Quantile, quantile

Progress: TypeAlias = Callable[[int, int, str], None]
Truth: TypeAlias = Literal["the filter's own model", "the oscillator"]

TRUTHS: tuple[Truth, ...] = get_args(Truth)
FITS, RUNS = 40, 10
"""How often covariances are found, each time from so many other runs, and tried on one more."""
FACTOR = 3.0
"""By which the start of the search is wrong."""
PARTS = ("position", "acceleration", "jerk")
"""Whose standard deviations are found."""
START = (FACTOR, 1 / FACTOR, 1 / FACTOR)
"""Of the search, by part, over the usual ones."""
SETTLED = 1e-9
"""The largest change of a covariance in a step, over itself, from which on it is taken for constant."""
SEEN = list(SENSORS.values())
"""The states that are measured."""


class Row(NamedTuple):
    """found: by part of `PARTS`, over the standard deviation that is true (jerk: that the usual filter has): the 5 %,
    50 % and 95 % quantiles of all fits. Of the run that was not seen, typical: times, the RMS error of position with
    what was found over that with the usual covariances; nees and usual_nees: 3 if a filter is as accurate as it says.
    """

    truth: Truth
    fits: int
    found: Mapping[str, tuple[Quantile, Quantile, Quantile]]
    times: Quantile
    nees: Quantile
    usual_nees: Quantile


def covariance_study(
    fits: int = FITS,
    backend: BackendName = "compiled",
    progress: Progress = lambda _done, _total, _what: None,
) -> tuple[Row, ...]:
    """A row for each truth."""
    rows = []
    for number, truth in enumerate(TRUTHS):
        scales, tried = [], []
        for fit in range(fits):
            progress(number * fits + fit, len(TRUTHS) * fits, f"covariances found on {truth}")
            *seen, other = (record_of(truth, (RUNS + 1) * fit + run) for run in range(RUNS + 1))
            scales.append(found(seen))
            tried.append(compared(scales[-1], other, backend))
        by_part = dict(zip(PARTS, map(_spread, np.array(scales).T), strict=True))
        rows.append(Row(truth, fits, by_part, *(quantile(column) for column in np.array(tried).T)))
    progress(1, 1, "covariances found")
    return tuple(rows)


def record_of(truth: Truth, seed: int) -> Record:
    """A run of either."""
    return own_model(USUAL, seed) if truth == "the filter's own model" else oscillation(USUAL, seed)


def found(records: Sequence[Record], first: Sequence[float] = START) -> FloatArray:
    """The standard deviations (3,) of the likeliest covariances, over the usual ones; the search begins at first."""
    from scipy.optimize import minimize  # takes a second to import, and only this needs it

    measured = np.stack([_measured(record.measurements) for record in records], axis=-1)
    best = minimize(lambda logs: -log_likelihood(np.exp(logs), measured), np.log(first), method="L-BFGS-B")
    scales: FloatArray = np.exp(best.x)
    return scales


class Correction(NamedTuple):
    """Of one step: the inverse of the innovations' covariance, the logarithm of its determinant, and the gain."""

    inverse: FloatArray
    size: float
    gain: FloatArray


def log_likelihood(scales: FloatArray, measured: FloatArray) -> float:
    """Of measurements (steps, sensors, runs), none of them lost, but for a constant: by their innovations, which are
    independent."""
    F = transition(step_s(USUAL))
    x, total = np.zeros((3, measured.shape[2])), 0.0
    for y, correction in zip(measured, corrections(scales), strict=False):
        innovation = y - x[SEEN]
        total += measured.shape[2] * correction.size + float(np.sum(innovation * (correction.inverse @ innovation)))
        x = F @ (x + correction.gain @ innovation)
    return -0.5 * total


def corrections(scales: FloatArray) -> Iterator[Correction]:
    """Of one step after the other, without end: the same for all runs, and once they have settled the same for ever."""
    F, Q = transition(step_s(USUAL)), white_jerk(step_s(USUAL), scales[2] * _jerk_noise())
    R = np.diag((scales[:2] * [POSITION_SIGMA_M, ACCELERATION_SIGMA]) ** 2)
    P, is_settled = start()[1], False
    while not is_settled:
        S = P[np.ix_(SEEN, SEEN)] + R
        inverse = np.asarray(np.linalg.inv(S), dtype=np.float64)
        gain: FloatArray = P[:, SEEN] @ inverse
        correction = Correction(inverse, float(np.log(np.linalg.det(S))), gain)
        following = F @ (P - gain @ P[SEEN]) @ F.T + Q
        is_settled = np.allclose(following, P, rtol=SETTLED, atol=0.0)
        P = following
        yield from repeat(correction) if is_settled else (correction,)


def compared(scales: FloatArray, record: Record, backend: BackendName = "compiled") -> tuple[float, float, float]:
    """On a run: RMS error of position with these covariances over that with the usual ones, and NEES of both."""
    figures = []
    for each in (scales, np.ones(3)):
        x, P = (part[SETTLED_PERIODS * USUAL.rate :] for part in _history(each, record, backend))
        errors = x - record.truth[-len(x) :]
        figures.append((float(np.sqrt(np.mean(errors[:, 0] ** 2))), float(nees(errors, P).mean())))
    (error, own), (usual, others) = figures
    return error / usual, own, others


def _history(scales: FloatArray, record: Record, backend: BackendName) -> tuple[FloatArray, FloatArray]:
    inputs = np.zeros((len(record.truth) - 1, 0))
    history = run(filter_of(scales), *start(), inputs, record.measurements, history=0, backend=backend)
    return history.x, history.P


def filter_of(scales: FloatArray) -> ModularFilter:
    """The tracker with these times the usual standard deviations."""
    position, acceleration, jerk = scales
    instruments = Instrument(position * POSITION_SIGMA_M), Instrument(acceleration * ACCELERATION_SIGMA)
    return tracker(step_s(USUAL), jerk * _jerk_noise(), *instruments)


def _jerk_noise() -> float:
    return float(USUAL.tuning * frequency(OSCILLATOR) ** 2.5)


def _measured(measurements: Sequence[Measurement]) -> FloatArray:
    """(steps + 1, sensors)."""
    by_sensor = [[each.y for each in measurements if each.sensor == name] for name in SENSORS]
    return np.array(by_sensor, dtype=np.float64)[..., 0].T


def _spread(values: FloatArray) -> tuple[Quantile, Quantile, Quantile]:
    return quantile(values, 1 - UNLUCKY), quantile(values), quantile(values, UNLUCKY)
