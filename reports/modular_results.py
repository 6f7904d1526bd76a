"""What the report on modular filters asks of studies that draw random numbers or time code: stored, and read back.

Results are written beside the report with few digits, since the last ones of floating-point sums differ between
machines, and the report is made from these files.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from statistics import median
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.systems.spring_mass import period_s
from reports.modular_costs import OPERATIONS, SECONDS
from reports.modular_oscillator import QUANTITIES, SENSORS, UNITS
from reports.modular_rocket_rows import rocket_tables
from reports.modular_schedule import TABLES as SCHEDULE_TABLES
from reports.modular_schedule import read_samples, sample_files, schedule_tables
from reports.stored import Rows, Tables, as_stored, columns, digits, read_tables, records, rows_of, table_files
from studies import late_measurements, modular_costs, rocket, rocket_schedule, spring_mass
from studies.spring_mass_run import OSCILLATOR, SETTLED_PERIODS, step_s

Progress = Callable[[int, int, str], None]

SEED, HALF, SHOWN_PERIODS = 0, 0.5, 2
"""Of the run that is drawn: its seed, its dropout, and how much of it."""
EVERY = 4
"""Steps between the points of a curve over all runs."""
OWN_MODEL = "usual, its own model true"

TABLES = (
    "oscillator", "dropout", "consistency", "rocket-errors", "rocket-residuals", "rocket-nees",
    "rocket-residual-course", "rocket-nees-course", "rocket-apogee", "flight", "late",
    "parts", "machine", *SCHEDULE_TABLES,
)  # fmt: skip


class Results(NamedTuple):
    """tables: by name, as in `TABLES`. costs: samples of the execution times of the rocket's filters."""

    tables: Tables
    costs: rocket_schedule.Costs

    def columns(self, name: str) -> dict[str, FloatArray]:
        """A table of numbers; nan where a cell is empty."""
        return columns(self.tables[name])

    def records(self, name: str, **kept: str) -> list[dict[str, str]]:
        """The rows of a table by their heading; only those with these entries."""
        return [row for row in records(self.tables[name]) if all(row[key] == value for key, value in kept.items())]

    def files(self) -> dict[str, bytes]:
        """What `read` reads."""
        return {**table_files(self.tables), **sample_files(self.costs)}


def read(folder: Path) -> Results:
    """The results that a report in `folder` was made from."""
    return Results(read_tables(folder, TABLES), read_samples(folder))


def results(thorough: bool = False, progress: Progress = lambda _done, _total, _what: None) -> Results:
    """Runs the studies and times the code: about three minutes, and two more if nothing was compiled before."""
    costs = rocket_schedule.measured(thorough=thorough, progress=progress)
    tables = as_stored(
        {
            **oscillator_tables(spring_mass.dropout_study(progress)),
            **rocket_tables(rocket.rocket_study(progress=progress)),
            "late": late_rows(late_measurements.late_study(progress=progress)),
            **part_tables(modular_costs.operations(), modular_costs.times(thorough=thorough, progress=progress)),
            **schedule_tables(costs, progress),
        }
    )
    return Results(tables, costs)


# ----------------------------------------------------------------------------------------------------- the oscillator


def oscillator_tables(study: spring_mass.DropoutStudy) -> dict[str, Rows]:
    """One run, all rows of the study, and NEES in each step at the dropout of that run."""
    groups: dict[str, Iterable[spring_mass.Row]] = {
        "usual": study.rows,
        "less process noise": study.keen,
        OWN_MODEL: study.own_model,
        **{f"{losing} only": [row for row in study.by_sensor if row.setting.losing == losing] for losing in SENSORS},
        **{f"rate {rate}": [row for row in study.by_rate if row.setting.rate == rate] for rate in spring_mass.RATES},
    }
    return {
        "oscillator": rows_of(_one_run(), "{:.4f}"),
        "dropout": [[*_DROPOUT], *(_dropout_row(group, row) for group, rows in groups.items() for row in rows)],
        "consistency": rows_of(_consistency(study), "{:.3f}"),
    }


def _each(what: str, names: Iterable[str]) -> list[str]:
    return [f"{what} {se}{UNITS[name]}" for se in ("", "se ") for name in names]


_DROPOUT = (
    "group", "rate", "dropout", "runs", "interval", "still",
    *_each("error", QUANTITIES), *_each("innovation", SENSORS), *_each("after", SENSORS),
    "nees", "low", "high", "inside", "below", "above",
)  # fmt: skip


def _dropout_row(group: str, row: spring_mass.Row) -> list[str]:
    spread = [value for one in (row.error, row.innovation, row.after) for part in one for value in part]
    found = row.consistency
    counts = [str(number) for number in (row.setting.rate, row.dropout, row.runs)]
    shares = [f"{share:.3f}" for share in (found.inside, found.below, found.above)]
    return [group, *counts, *map(digits, (row.interval, row.still[0], *spread, found.overall, *found.bounds)), *shares]


def _one_run() -> dict[str, FloatArray]:
    """Measured: nan where nothing got through."""
    run = spring_mass.history_at(HALF, SEED)
    kept = slice(0, SHOWN_PERIODS * spring_mass.USUAL.rate + 1)
    found = {"time_s": run.time_s[kept]}
    for number, name in enumerate(QUANTITIES):
        found[f"{name} true"] = run.truth[kept, number]
        found[f"{name} estimate"] = run.estimate[kept, number]
        found[f"{name} sigma"] = run.sigma[kept, number]
    for name, seen in zip(SENSORS, (run.position, run.acceleration), strict=True):
        measured = np.full(len(run.time_s), np.nan)
        measured[np.rint(seen[:, 0] / step_s(spring_mass.USUAL)).astype(np.int64)] = seen[:, 1]
        found[f"{name} measured"] = measured[kept]
    return found


def _consistency(study: spring_mass.DropoutStudy) -> dict[str, FloatArray]:
    by_name = {"usual": study.rows, "less process noise": study.keen, OWN_MODEL: study.own_model}
    means = {
        name: next(row for row in rows if row.dropout == HALF).consistency.mean[::EVERY]
        for name, rows in by_name.items()
    }
    steps = EVERY * np.arange(float(len(means[OWN_MODEL])))
    time_s: FloatArray = SETTLED_PERIODS * period_s(OSCILLATOR) + steps * step_s(spring_mass.USUAL)
    return {"time_s": time_s, **means}


# -------------------------------------------------------------------------------------------------- late measurements


def late_rows(found: Iterable[late_measurements.Row]) -> Rows:
    """Errors of position, and operations."""
    rows: Rows = [["sensors", "way", "delay", "runs", "error", "se", "mean", "longest"]]
    for row in found:
        error = map(digits, (row.error.rms[0], row.error.standard_error[0]))
        rows.append([row.sensors, row.way, row.delay, row.runs, *error, f"{row.work.mean:.1f}", row.work.longest])
    return rows


# -------------------------------------------------------------------------------------------------------------- costs


def part_tables(operations: Mapping[modular_costs.Key, int], timed: modular_costs.Times) -> dict[str, Rows]:
    """Operations and times of each part, and where they were taken."""
    rows: Rows = [["kind", "states", "part", OPERATIONS, SECONDS, "median, µs †"]]
    for key, number in operations.items():
        micros = [1e6 * each for each in timed.seconds[key]]
        rows.append([*key, number, *map(digits, (min(micros), median(micros)))])
    about = timed.about
    versions = ", ".join(f"{name} {number}" for name, number in about["versions"].items())
    protocol = f"{about['protocol']['rounds']} rounds of {about['protocol']['repetitions']} repetitions"
    where: Rows = [
        ["machine †", "date †", "versions †", "protocol †"],
        [about["machine"], about["date"], versions, protocol],
    ]
    return {"parts": rows, "machine": where}
