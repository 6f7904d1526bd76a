"""What the explorer's page asks the server for: the view of a design, its schedule as a picture, and tables to save."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from reports.explorer.answer import VIEW, Answer, Question, document
from sched_sim.errors import InputError
from sched_sim.text import csv_cell
from studies.explorer.given import Given
from studies.explorer.query import design_of
from studies.explorer.resolved import resolved
from studies.explorer.view import explore

Row = Mapping[str, Any]
Document = Mapping[str, Any]


def questions(given: Given) -> dict[str, Question]:
    """By path."""

    def view(query: str) -> Document:
        return explore(design_of(query, given), given).document()

    asked: dict[str, Question] = {
        VIEW: lambda query: document(view(query)),
        "/schedule.svg": lambda query: schedule_picture(query, given),
        "/methods.csv": lambda query: table(method_rows(view(query)), "methods"),
        "/parts.csv": lambda query: table(part_rows(view(query)), "parts"),
        "/jobs.csv": lambda query: table(job_rows(view(query)), "jobs"),
    }
    if isinstance(given.tasks, Path):
        return {path: _without(given.tasks, question) for path, question in asked.items()}
    return asked


def _without(file: Path, question: Question) -> Question:
    """What is refused names the file alone, not where it is."""

    def asked(query: str) -> Answer:
        try:
            return question(query)
        except InputError as error:
            raise InputError(str(error).replace(str(file), file.name)) from None

    return asked


def schedule_picture(query: str, given: Given) -> Answer:
    """The schedule in print quality, as `sched-sim gantt` draws it. Raises InputError for one that is too long."""
    from reports.charts.chart import gantt, image, method_panel
    from sched_sim.design.least_speed import least_speed

    design = design_of(query, given)
    of = resolved(design, given)
    timing = of.timing(design.method)
    pace = of.pace or least_speed(of.costs(design.method), timing, design.options, of.tasks).speed
    panel = method_panel(
        of.table,
        design.method,
        timing,
        pace,
        design.cycles,
        design.options,
        of.tasks,
        statistic=design.statistic,
    )
    return Answer(image(gantt(panel, hr_hz=of.rate), "svg"), "image/svg+xml", "schedule.svg")


def table(rows: Sequence[Row], name: str) -> Answer:
    """CSV with a heading; what a row does not have is empty; what a spreadsheet would compute has an apostrophe before
    it."""
    text = io.StringIO()
    columns = dict.fromkeys(key for row in sorted(rows, key=len, reverse=True) for key in row)
    writer = csv.DictWriter(text, fieldnames=list(columns), lineterminator="\n")
    writer.writeheader()
    writer.writerows({key: csv_cell(value) for key, value in row.items()} for row in rows)
    return Answer(text.getvalue().encode(), "text/csv", f"{name}.csv")


def method_rows(view: Document) -> list[Row]:
    """What each method needs and comes to, without its curves."""
    unit = view["power"]["unit"]
    return [
        flat(method, CURVES if method["within"] else (*CURVES, "within")) | {"power_unit": unit}
        for method in view["methods"]
    ]


CURVES = ("staircase", "landing", "accuracy", "front")


def part_rows(view: Document) -> list[Row]:
    return [flat(part) for part in view["parts"]]


def job_rows(view: Document) -> list[Row]:
    """Times are in HR periods, and in ms where one is so many; of a schedule that is cut each row says so."""
    schedule = view["schedule"]
    jobs, period = schedule["jobs"], view["period_ms"]
    names = [row["name"] for row in schedule["rows"]]
    cut = {"cut": schedule["cut"]} if schedule["cut"] else {}
    rows: list[Row] = []
    for values in zip(*jobs.values(), strict=True):
        job = dict(zip(jobs, values, strict=True))
        in_ms = {f"{name}_ms": _times(job[name], period) for name in TIMES} if period is not None else {}
        rows.append({**job, "row": names[job["row"]], **in_ms, **cut})
    return rows


TIMES = ("release", "start", "finish", "deadline")


def _times(value: float | None, period: float) -> float | None:
    return None if value is None else value * period


def flat(row: Row, without: Iterable[str] = ()) -> dict[str, Any]:
    """A quotient in two columns, what is within another in one each, prefixed by its name."""
    found: dict[str, Any] = {}
    for key, value in row.items():
        if key in without:
            continue
        if isinstance(value, Mapping) and set(value) == {"value", "exact"}:
            found |= {key: value["value"], f"{key}_exact": value["exact"]}
        elif isinstance(value, Mapping):
            found |= {f"{key}_{name}": of for name, of in flat(value).items()}
        else:
            found[key] = value
    return found
