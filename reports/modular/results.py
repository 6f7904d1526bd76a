"""What the report on modular filters asks of studies that draw random numbers or time code: stored, and read back.

Results are written beside the report with few digits, since the last ones of floating-point sums differ between
machines, and the report is made from these files.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.systems.spring_mass import period_s
from reports.modular.bias_rows import bias_rows
from reports.modular.costs import OPERATIONS
from reports.modular.future_rows import TABLES as FUTURE_TABLES
from reports.modular.future_rows import future_tables
from reports.modular.oscillator import QUANTITIES, SENSORS, UNITS
from reports.modular.rocket_rows import rocket_tables
from reports.modular.schedule import TABLES as SCHEDULE_TABLES
from reports.modular.schedule import schedule_tables
from reports.pages.stored import Rows, Tables, as_stored, columns, digits, read_tables, records, rows_of, table_files
from studies.machines.parts import PartTimes, kept_parts, part_times, parts_beside, parts_text, read_parts
from studies.machines.ranges import Range, range_of
from studies.modular import (
    biases,
    flight_times,
    late_measurements,
    rocket,
    rocket_schedule,
)
from studies.modular import (
    costs as modular_costs,
)
from studies.modular import (
    oscillator as spring_mass,
)
from studies.modular.oscillator_run import OSCILLATOR, SETTLED_PERIODS, step_s
from studies.modular.typical import UNLUCKY, quantile

Progress = Callable[[int, int, str], None]

SEED, HALF, SHOWN_PERIODS = 0, 0.5, 2
"""The run that is drawn: its seed, its dropout, and how much of it."""
EVERY = 4
"""Steps between the points of a curve over all runs."""
MEASURED, FLOWN = "measured.toml", "measured-flight.toml"
"""The files of the times of the parts, and of whole flights."""
OWN_MODEL = "usual, its own model true"

TABLES = (
    "oscillator", "dropout", "consistency", "rocket-errors", "rocket-residuals", "rocket-nees",
    "rocket-residual-course", "rocket-nees-course", "rocket-apogee", "rocket-biases", "flight", "late",
    "parts", *SCHEDULE_TABLES, *FUTURE_TABLES,
)  # fmt: skip


class Results(NamedTuple):
    """tables: by name, as in `TABLES`. measured, flown: the times of the parts and of flights here; stored,
    flown_before: those before, or of other machines."""

    tables: Tables
    measured: PartTimes
    flown: PartTimes
    stored: Sequence[PartTimes] = ()
    flown_before: Sequence[PartTimes] = ()

    @property
    def measurements(self) -> tuple[PartTimes, ...]:
        """All that there are of parts; the last is the one of here."""
        return parts_beside(self.measured, self.stored)

    @property
    def flights(self) -> tuple[PartTimes, ...]:
        """All that there are of whole flights, likewise."""
        return parts_beside(self.flown, self.flown_before)

    def least(self, kind: modular_costs.Kind, states: int, part: modular_costs.Part) -> Range[float]:
        """The range of the least times of a part, in µs."""
        return range_of(lambda times: times.parts[kind, str(states), part].least, self.measurements)

    def columns(self, name: str) -> dict[str, FloatArray]:
        """A table of numbers; nan where a cell is empty."""
        return columns(self.tables[name])

    def records(self, name: str, **kept: str) -> list[dict[str, str]]:
        """The rows of a table by their heading; only those with these entries."""
        return [row for row in records(self.tables[name]) if all(row[key] == value for key, value in kept.items())]

    def files(self) -> dict[str, bytes]:
        """What `read` reads."""
        times = {MEASURED: self.measured, FLOWN: self.flown}
        return {**table_files(self.tables), **{name: parts_text(one).encode() for name, one in times.items()}}


def read(folder: Path) -> Results:
    """The results that a report in `folder` was made from, beside all measurements that are kept."""
    measured, flown = (read_parts(folder / name) for name in (MEASURED, FLOWN))
    return Results(read_tables(folder, TABLES), measured, flown, kept_parts(), kept_parts(name=flight_times.NAME))


def results(thorough: bool = False, progress: Progress = lambda _done, _total, _what: None) -> Results:
    """Runs the studies and times the code: about fifteen minutes, and two more if nothing was compiled before."""
    measured = part_times(modular_costs.times(thorough=thorough, progress=progress))
    flown = part_times(flight_times.flight_times(progress=progress), flight_times.NAME)
    tables = {**simulated(progress), **as_stored({"parts": part_rows(modular_costs.operations())})}
    return Results(tables, measured, flown, kept_parts(), kept_parts(name=flight_times.NAME))


def simulated(progress: Progress = lambda _done, _total, _what: None) -> dict[str, Rows]:
    """All tables but those of times."""
    return as_stored(
        {
            **oscillator_tables(spring_mass.dropout_study(progress)),
            **rocket_tables(rocket.rocket_study(progress=progress)),
            "rocket-biases": bias_rows(biases.bias_study(progress=progress)),
            "late": late_rows(late_measurements.late_study(progress=progress)),
            **schedule_tables(rocket_schedule.counted(), progress),
            **future_tables(progress),
        }
    )


# ----------------------------------------------------------------------------------------------------- the oscillator


def oscillator_tables(study: spring_mass.DropoutStudy) -> dict[str, Rows]:
    """One run, all rows of the study, and NEES in each step at the dropout of that run."""
    groups: dict[str, list[spring_mass.Row]] = {
        "usual": [*study.rows],
        "less process noise": [*study.keen],
        OWN_MODEL: [*study.own_model],
        **{f"{losing} only": [row for row in study.by_sensor if row.setting.losing == losing] for losing in SENSORS},
        **{f"rate {rate}": [row for row in study.by_rate if row.setting.rate == rate] for rate in spring_mass.RATES},
    }
    return {
        "oscillator": rows_of(_one_run(), "{:.4f}"),
        "dropout": dropout_table(groups),
        "consistency": rows_of(_consistency(study), "{:.3f}"),
    }


def dropout_table(groups: Mapping[str, Sequence[spring_mass.Row]]) -> Rows:
    """All rows by group; each group has one of the lowest dropout."""
    body = [_dropout_row(group, row, rows) for group, rows in groups.items() for row in rows]
    return [[*_DROPOUT], *body]


_OF = {"error": [*QUANTITIES], "innovation": [*SENSORS], "after": [*SENSORS]}


def _heads(what: str) -> list[str]:
    """What is said of a run's root mean squares: typical, over those of the same run at the lowest dropout, and
    unlucky; each with its 95 % interval."""
    kinds = ("", "times ", "unlucky ")
    ends = ("", "low ", "high ")
    return [f"{what} {kind}{end}{UNITS[name]}" for name in _OF[what] for kind in kinds for end in ends]


_DROPOUT = (
    "group", "rate", "dropout", "runs", "interval", "still", *(head for what in _OF for head in _heads(what)),
    "nees", "nees se", "low", "high", "inside", "below", "above",
)  # fmt: skip


def _dropout_row(group: str, row: spring_mass.Row, rows: Iterable[spring_mass.Row]) -> list[str]:
    """rows: of the same group, among them that of the lowest dropout."""
    (lowest,) = (candidate for candidate in rows if candidate.dropout == spring_mass.LOWEST)
    spread: list[float] = []
    for values, least in ((row.error, lowest.error), (row.innovation, lowest.innovation), (row.after, lowest.after)):
        for of_run, at_least in zip(values.T, least.T, strict=True):
            typical, times = quantile(of_run), quantile(of_run / at_least)
            spread += [*typical, *times, *quantile(of_run, UNLUCKY)]
    nees = row.consistency
    counts = [str(number) for number in (row.setting.rate, row.dropout, row.runs)]
    shares = [f"{share:.3f}" for share in (nees.inside, nees.below, nees.above)]
    figures = (row.interval, row.still[0], *spread, nees.overall, nees.standard_error, *nees.bounds)
    return [group, *counts, *map(digits, figures), *shares]


def _one_run() -> dict[str, FloatArray]:
    """Measured: nan where nothing got through."""
    run = spring_mass.history_at(HALF, SEED)
    kept = slice(0, SHOWN_PERIODS * spring_mass.USUAL.rate + 1)
    curves = {"time_s": run.time_s[kept]}
    for number, name in enumerate(QUANTITIES):
        curves[f"{name} true"] = run.truth[kept, number]
        curves[f"{name} estimate"] = run.estimate[kept, number]
        curves[f"{name} sigma"] = run.sigma[kept, number]
    for name, seen in zip(SENSORS, (run.position, run.acceleration), strict=True):
        measured = np.full(len(run.time_s), np.nan)
        measured[np.rint(seen[:, 0] / step_s(spring_mass.USUAL)).astype(np.int64)] = seen[:, 1]
        curves[f"{name} measured"] = measured[kept]
    return curves


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


def late_rows(figures: Iterable[late_measurements.Row]) -> Rows:
    """Errors of position, and operations."""
    rows: Rows = [["sensors", "way", "delay", "runs", "error", "se", "mean", "longest"]]
    for row in figures:
        error = map(digits, (row.error.rms[0], row.error.standard_error[0]))
        rows.append([row.sensors, row.way, row.delay, row.runs, *error, f"{row.work.mean:.1f}", row.work.longest])
    return rows


# -------------------------------------------------------------------------------------------------------------- costs


def part_rows(operations: Mapping[modular_costs.Key, int]) -> Rows:
    """Operations of each part."""
    return [["kind", "states", "part", OPERATIONS], *([*key, number] for key, number in operations.items())]
