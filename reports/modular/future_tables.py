"""Tables on the poster's future work, and on residuals against time, in the report on modular filters."""

from __future__ import annotations

from reports.modular.future_rows import ENDS, QUANTILES
from reports.modular.oscillator import OSCILLATOR_AMPLITUDES, Record
from reports.modular.results import Results
from reports.modular.tables import in_percents, share_that_holds
from reports.pages.numbers import between, significant, span
from reports.pages.stored import Rows
from studies.modular.found_covariances import PARTS
from studies.modular.residual_course import WINDOWS
from studies.modular.uncertain import SPREADS

PERCENT = 0.01 * OSCILLATOR_AMPLITUDES["position"]
SHOWN_WINDOWS = {"at the start": 0, "after 1 period": WINDOWS, "after 10 periods": 10 * WINDOWS - 1}


def residual_time_rows(results: Results) -> Rows:
    """Errors and innovations of position in percent of the amplitude, in three tenths of a period."""
    rows: Rows = [["Dropout, %", *(f"error {when}" for when in SHOWN_WINDOWS), "innovation after 10"]]
    for dropout in dict.fromkeys(row["dropout"] for row in results.records("residual-course")):
        course = results.records("residual-course", dropout=dropout)
        errors = [in_percent(course[window], "error") for window in SHOWN_WINDOWS.values()]
        rows.append([f"{100 * float(dropout):g}", *errors, in_percent(course[-1], "innovation")])
    return rows


def uncertain_rows(results: Results) -> Rows:
    """How the error of position spreads with mass, spring and thrust."""
    rows: Rows = [["System", "lost, %", "spread, %", "runs", "error", "times", "1 in 20 above", "hold, %"]]
    for row in results.records("uncertain"):
        is_rocket = row["of"] == "rocket"
        error = between(*(value / (1.0 if is_rocket else PERCENT) for value in interval_of(row, "error")))
        hold = share_that_holds(row) if is_rocket else "-"
        percents = [f"{100 * float(row[name]):g}" for name in ("dropout", "spread")]
        times = [_or_one(row, what) for what in ("times", "unlucky")]
        rows.append([f"{row['of']}, {'m' if is_rocket else '%'}", *percents, row["runs"], error, *times, hold])
    return rows


STIFFNESS = "stiffness off by, %"


def stiffness_rows(results: Results) -> Rows:
    """Errors of position in percent of the amplitude, of the filters with and without the spring."""
    heads = ("no spring", "stiffness as a state", "1 run in 20 above", "NEES", STIFFNESS)
    rows: Rows = [["Lost, %", *heads]]
    for row in results.records("stiffness"):
        errors = [in_percent(row, what) for what in ("unaware", "aware", "unlucky")]
        stiffness = between(*(100 * value for value in interval_of(row, "stiffness")))
        rows.append([f"{100 * float(row['dropout']):g}", *errors, between(*interval_of(row, "nees")), stiffness])
    return rows


SHORTER = {"the filter's own model": "own model", "the oscillator": "oscillator"}
"""Names of what is true where a column is narrow."""


def covariance_rows(results: Results) -> Rows:
    """Standard deviations found, over those that are usual."""
    rows: Rows = [["Truth", "noise of", "median of the fits", "nine fits in ten"]]
    for row in results.records("covariances"):
        for part in PARTS:
            low, middle, high = (interval_of(row, f"{part} {level}") for level in QUANTILES)
            rows.append(
                [SHORTER[row["truth"]], part, between(*middle), span(significant(low[0]), significant(high[0]))]
            )
    return rows


def interval_of(row: Record, what: str) -> tuple[float, float, float]:
    """Value, low and high of a stored row."""
    value, low, high = (float(row[f"{what}{end}"]) for end in ENDS)
    return value, low, high


def in_percent(row: Record, what: str) -> str:
    """Of the amplitude, with its interval."""
    return in_percents(*(value / PERCENT for value in interval_of(row, what)))


def _or_one(row: Record, what: str) -> str:
    """The nominal parameters are compared with themselves."""
    return "-" if float(row["spread"]) == SPREADS[0] else between(*interval_of(row, what))
