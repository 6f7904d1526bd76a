"""Results of the rocket study as tables to be stored."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from filters.arrays import FloatArray
from filters.systems.rocket import RATE_HZ
from reports.modular.rocket import DROPOUTS, HALVES, QUANTITIES, SHOWN
from reports.pages.stored import Rows, digits, rows_of
from studies.modular import rocket
from studies.modular.rocket_flights import Run, fly
from studies.modular.rocket_readings import READINGS as ALL_READINGS
from studies.modular.typical import quantile

SEED, EVERY, NEES_EVERY = 0, 10, 5
"""The seed of the flight that is drawn, and the steps between points of curves."""
POINTS = 70
"""Those of a curve on a logarithmic axis of time."""
FIRST_S = 0.1
READINGS = (
    "position / distance from the pad",
    "horizontal / horizontal distance",
    "orientation / net turn",
    "nose / turn of the nose",
)
"""Those that are drawn."""
CASES = dict(zip(DROPOUTS, (case.name for case in rocket.DROPOUT_CASES), strict=True))

ERRORS = ("case", "runs", *(f"{name}{what}" for name in QUANTITIES for what in ("", " low", " high", " largest")))
RESIDUALS = (
    "case", "reading", "typical", "low", "high", "worst", "hold", "runs", "holds from s", "half from s",
)  # fmt: skip
NEES = ("case", "phase", "of", "n", "mean", "se", "low", "high", "below", "above")


def rocket_tables(results: rocket.RocketResults) -> dict[str, Rows]:
    """Errors, residuals and NEES of all cases; courses over time; one flight."""
    return {
        "rocket-errors": [[*ERRORS], *(_error_row(row) for row in results.errors)],
        "rocket-residuals": [
            [*RESIDUALS],
            *(_residual_row(row) for row in results.residuals),
        ],
        "rocket-nees": [[*NEES], *(_nees_row(row) for row in results.nees)],
        "rocket-residual-course": rows_of(_residual_course(results.series), "{:.3g}"),
        "rocket-nees-course": rows_of(_nees_course(results.series), "{:.4g}"),
        "rocket-apogee": rows_of({"apogee_m": results.apogee_m}, "{:.0f}"),
        "flight": rows_of(flight_columns(fly(rocket.BASE, SEED, backend="compiled")), "{:.4g}"),
    }


def _digits(value: float) -> str:
    return digits(value) if np.isfinite(value) else "inf"


def _error_row(row: rocket.ErrorRow) -> list[str]:
    values = [(*quantile(of_run), largest) for of_run, largest in zip(row.rms.T, row.largest, strict=True)]
    return [row.case.name, str(len(row.rms)), *(digits(value) for figures in values for value in figures)]


def _residual_row(row: rocket.ResidualRow) -> list[str]:
    values = map(_digits, (*row.typical, row.worst))
    counts = map(str, (row.hold, row.runs))
    return [row.case.name, row.reading, *values, *counts, *map(_digits, (row.holds_from_s, row.half_from_s))]


def _nees_row(row: rocket.NeesRow) -> list[str]:
    return [row.case.name, row.phase, row.of, str(row.n), *map(digits, (row.mean, row.standard_error, *row.bounds)),
            f"{row.below:.0f}", f"{row.above:.0f}"]  # fmt: skip


def _by_dropout(series: Iterable[rocket.Series]) -> dict[str, rocket.Series]:
    by_name = {course.case.name: course for course in series}
    return {dropout: by_name[name] for dropout, name in CASES.items()}


def _residual_course(series: Iterable[rocket.Series]) -> dict[str, FloatArray]:
    by_dropout = _by_dropout(series)
    time_s = by_dropout[DROPOUTS[0]].time_s
    asked = np.geomspace(FIRST_S, time_s[-1], POINTS)
    at = np.unique(np.abs(time_s[:, np.newaxis] - asked).argmin(axis=0))
    columns = {"time_s": time_s[at]}
    for number, name in enumerate(ALL_READINGS):
        if name in READINGS:
            for dropout, course in by_dropout.items():
                for which, curve in zip(HALVES, (course.median, course.high), strict=True):
                    columns[f"{name}, {dropout}, {which}"] = curve[number, at]
    return columns


def _nees_course(series: Iterable[rocket.Series]) -> dict[str, FloatArray]:
    by_dropout = _by_dropout(series)
    time_s = by_dropout[DROPOUTS[0]].time_s
    kept = slice(RATE_HZ // 2, None, NEES_EVERY)
    return {"time_s": time_s[kept], **{dropout: course.nees[0, kept] for dropout, course in by_dropout.items()}}


def flight_columns(flight: Run) -> dict[str, FloatArray]:
    """One flight, up: true, estimated, their difference and the standard deviation that the filter gives."""
    kept = slice(0, None, EVERY)
    truth, x = flight.truth[kept], flight.x[kept]
    sigma = np.sqrt(np.diagonal(flight.P[kept], axis1=1, axis2=2))
    columns = {"time_s": flight.time_s[kept]}
    for name, at in zip(SHOWN, (2, 5, 8, 13), strict=True):
        upright = name == "tilt"
        columns[f"{name} true"] = tilt_deg(truth) if upright else truth[:, at]
        columns[f"{name} estimate"] = tilt_deg(x) if upright else x[:, at]
        columns[f"{name} error"] = np.degrees(-flight.errors[kept, at]) if upright else x[:, at] - truth[:, at]
        columns[f"{name} sigma"] = np.degrees(sigma[:, at]) if upright else sigma[:, at]
    return columns


def tilt_deg(states: FloatArray) -> FloatArray:
    """Between the nose and the vertical (steps,), of states (steps, 16)."""
    w, x, y, z = states[:, 12:].T
    angle: FloatArray = np.degrees(np.arccos(np.clip(2 * (x * z - w * y), -1.0, 1.0)))
    return angle
