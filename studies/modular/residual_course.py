"""Residuals of the oscillator against time, at some dropouts: what Fig. 1 of MacCormack and Rubinstein shows.

A run's residual is its root mean square in a tenth of a period; of many runs a typical one's is the median, with the
interval that the order of the runs gives it, and an unlucky one's is what 19 of 20 are below. From the start on: the
filter knows the size of the motion, and nothing else.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName
from filters.systems.spring_mass import transition
from studies.modular.oscillator import SEEDS, USUAL
from studies.modular.oscillator_run import Record, Setting, arriving, estimate, oscillation, start, step_s
from studies.modular.typical import UNLUCKY, Quantile, quantile

Progress: TypeAlias = Callable[[int, int, str], None]

DROPOUTS = (0.1, 0.5, 0.8, 0.99)
WINDOWS = 10
"""In a period."""


class Course(NamedTuple):
    """Residuals of position at one dropout, in m, in one window after the other.

    time_s (windows,): of their middles. error, unlucky: of the estimate, of a typical run and of one in 20; innovation:
    measured less predicted, of the typical one of those runs that measured in the window.
    """

    dropout: float
    runs: int
    time_s: FloatArray
    error: tuple[Quantile, ...]
    unlucky: tuple[Quantile, ...]
    innovation: tuple[Quantile, ...]


def residual_courses(
    seeds: Sequence[int] = SEEDS,
    setting: Setting = USUAL,
    backend: BackendName = "compiled",
    progress: Progress = lambda _done, _total, _what: None,
) -> tuple[Course, ...]:
    """One for each of `DROPOUTS`, of the same measurements."""
    records = [oscillation(setting, seed) for seed in seeds]
    courses = []
    for done, dropout in enumerate(DROPOUTS):
        progress(done, len(DROPOUTS), f"residuals at {100 * dropout:g} % dropout")
        courses.append(_course(records, setting, dropout, backend))
    progress(len(DROPOUTS), len(DROPOUTS), "residuals against time")
    return tuple(courses)


def _course(records: Sequence[Record], setting: Setting, dropout: float, backend: BackendName) -> Course:
    both = np.array([position_residuals(record, setting, dropout, backend) for record in records])
    errors, innovations = (windowed(both[:, which], setting) for which in (0, 1))
    window_s = step_s(setting) * setting.rate / WINDOWS
    return Course(
        dropout,
        len(records),
        window_s * (np.arange(float(errors.shape[1])) + 0.5),
        tuple(quantile(column) for column in errors.T),
        tuple(quantile(column, UNLUCKY) for column in errors.T),
        tuple(quantile(column) for column in innovations.T),
    )


def position_residuals(record: Record, setting: Setting, dropout: float, backend: BackendName) -> FloatArray:
    """(2, steps): estimate less truth, and measured less predicted, nan where nothing was measured; from step 1 on."""
    measurements = arriving(record, dropout, setting.losing)
    history = estimate(record, setting, measurements, backend)
    predicted = np.vstack([start()[0], history.x[:-1] @ transition(step_s(setting)).T])[:, 0]
    innovation = np.full(len(record.truth), np.nan)
    for measurement in measurements:
        if measurement.sensor == "position" and measurement.y is not None:
            innovation[measurement.taken] = measurement.y[0] - predicted[measurement.taken]
    return np.stack([history.x[:, 0] - record.truth[:, 0], innovation])[:, 1:]


def windowed(residuals: FloatArray, setting: Setting) -> FloatArray:
    """Root mean squares (runs, windows) of residuals (runs, steps); nan where a window has none."""
    squares = (residuals**2).reshape(len(residuals), -1, setting.rate // WINDOWS)
    counts = np.sum(~np.isnan(squares), axis=2)
    sums = np.nansum(squares, axis=2)
    roots: FloatArray = np.sqrt(np.divide(sums, counts, out=np.full(sums.shape, np.nan), where=counts > 0))
    return roots
