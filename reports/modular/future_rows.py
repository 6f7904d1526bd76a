"""What the poster leaves to the future, as tables to be stored: residuals against time, parameters as random variables,
covariances found automatically."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from filters.arrays import FloatArray
from reports.pages.stored import Rows, digits, rows_of
from studies.modular.found_covariances import PARTS, covariance_study
from studies.modular.found_covariances import Row as CovarianceRow
from studies.modular.oscillator import Progress, history_at
from studies.modular.parameter_state import Row as ParameterRow
from studies.modular.parameter_state import parameter_study
from studies.modular.residual_course import DROPOUTS, Course, residual_courses
from studies.modular.typical import Quantile
from studies.modular.uncertain import Row as UncertainRow
from studies.modular.uncertain import uncertain_study

SEED, EVERY = 0, 4
"""Of the run that is drawn, and the steps between its points."""

TABLES = ("residual-course", "residual-run", "uncertain", "stiffness", "covariances")

ENDS = ("", " low", " high")
"""How the columns of a value and of its interval are called."""
QUANTILES = ("5 %", "50 %", "95 %")


def future_tables(progress: Progress) -> dict[str, Rows]:
    """`TABLES`, by name; some three minutes."""
    return {
        "residual-course": course_rows(residual_courses(progress=progress)),
        "residual-run": rows_of(_one_run(), "{:.3g}"),
        "uncertain": uncertain_rows(uncertain_study(progress=progress)),
        "stiffness": stiffness_rows(parameter_study(progress=progress)),
        "covariances": covariance_rows(covariance_study(progress=progress)),
    }


def course_rows(courses: Iterable[Course]) -> Rows:
    """A row for each dropout and window, in m."""
    rows: Rows = [["dropout", "runs", "time_s", *_heads("error", "unlucky", "innovation")]]
    for course in courses:
        figures = zip(course.time_s, course.error, course.unlucky, course.innovation, strict=True)
        rows += [[course.dropout, course.runs, f"{time_s:.4f}", *_cells(*each)] for time_s, *each in figures]
    return rows


def _one_run() -> dict[str, FloatArray]:
    """Error and standard deviation of position, in m."""
    columns: dict[str, FloatArray] = {}
    for dropout in DROPOUTS:
        run = history_at(dropout, SEED)
        columns["time_s"] = run.time_s[::EVERY]
        columns[f"error {dropout}"] = (run.estimate - run.truth)[::EVERY, 0]
        columns[f"sigma {dropout}"] = run.sigma[::EVERY, 0]
    return columns


def uncertain_rows(found: Iterable[UncertainRow]) -> Rows:
    """A row for each system, dropout and spread."""
    rows: Rows = [["of", "dropout", "spread", "runs", *_heads("error", "times", "unlucky"), "hold"]]
    for row in found:
        figures = _cells(row.error, row.times, row.unlucky)
        rows.append([row.of, row.dropout, row.spread, row.runs, *figures, row.hold])
    return rows


def stiffness_rows(found: Iterable[ParameterRow]) -> Rows:
    """A row for each dropout."""
    rows: Rows = [["dropout", "runs", *_heads("unaware", "aware", "unlucky", "nees", "stiffness")]]
    for row in found:
        rows.append([row.dropout, row.runs, *_cells(row.unaware, row.aware, row.unlucky, row.nees, row.stiffness)])
    return rows


def covariance_rows(found: Iterable[CovarianceRow]) -> Rows:
    """A row for each truth; of each part the quantiles over all fits."""
    parts = [f"{part} {level}" for part in PARTS for level in QUANTILES]
    rows: Rows = [["truth", "fits", *_heads(*parts, "times", "nees", "usual nees")]]
    for row in found:
        values = [each for part in PARTS for each in row.found[part]]
        rows.append([row.truth, row.fits, *_cells(*values, row.times, row.nees, row.usual_nees)])
    return rows


def _heads(*names: str) -> list[str]:
    return [f"{name}{end}" for name in names for end in ENDS]


def _cells(*quantiles: Quantile) -> list[str]:
    return [digits(value) if np.isfinite(value) else str(value) for each in quantiles for value in each]
