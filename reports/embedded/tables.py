"""Tables of the report on boards."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from statistics import median

from filters.covariance_forms import CovarianceFormName
from reports.charts.panels import METHOD_NAMES
from reports.embedded.answer_figure import Row
from reports.embedded.compared import Compared, largest
from reports.embedded.results import Results
from reports.embedded.words import (
    CORES,
    HERE,
    OTHERS,
    PAPERS,
    SOURCES,
    microseconds,
    signed,
)
from reports.pages.machine import MARK, marked, unmarked
from reports.pages.measurements import Shown, measurement_rows
from reports.pages.numbers import span
from reports.pages.stored import Rows
from sched_sim.costs.table import CostTable
from studies.embedded.sources import FIRST, FORMS, METHODS, counted, relative_speed
from studies.measurement.emulation.memory import ONLY_IF_ASKED

DIFFER = "emulated differ by, %"


def jobs(results: Results, form: CovarianceFormName, methods: Sequence[str] = METHODS) -> Rows:
    """Of each job: operations, instructions on each core, and instructions for each operation."""
    rows: Rows = [
        ["Method", "job", "operations", *(SOURCES[core] for core in CORES), "for each operation", "in software"]
    ]
    operations = counted(form)
    for method in methods:
        for kind in _kinds(operations, method):
            number = operations.entry(method, kind).median
            by_core = [results.costs[core, form].entry(method, kind).median for core in CORES]
            *hardware, software = (f"{float(instructions / number):.1f}" for instructions in by_core)
            row = [METHOD_NAMES[method], kind, f"{int(number):,}", *(f"{int(each):,}" for each in by_core)]
            rows.append([*row, span(min(hardware, key=float), max(hardware, key=float)), software])
    return rows


def times(results: Results, form: CovarianceFormName, methods: Sequence[str] = METHODS) -> Rows:
    """Of each job, what it takes here, in microseconds: median, and from the minimum to the 95th percentile."""
    names = [name for name in HERE if (name, form) in results.costs]
    rows: Rows = [["Method", "job", *(f"{SOURCES[name]}, µs" for name in names)]]
    for method in methods:
        for kind in _kinds(counted(form), method):
            cells = [microseconds(results.costs[name, form].entry(method, kind)) for name in names]
            rows.append([METHOD_NAMES[method], kind, *cells])
    return rows


def _kinds(table: CostTable, method: str) -> list[str]:
    """Jobs that are released unless an option asks for others."""
    return [kind for kind in table.costs[method] if kind not in ONLY_IF_ASKED.get(method, ())]


def per_operation(results: Results) -> dict[CovarianceFormName, dict[str, list[tuple[int, float]]]]:
    """By form and core, of each job: its operations, and instructions for each."""
    found: dict[CovarianceFormName, dict[str, list[tuple[int, float]]]] = {}
    for form in FORMS:
        operations = counted(form)
        found[form] = {core: [] for core in CORES}
        for method in METHODS:
            for kind in _kinds(operations, method):
                number = operations.entry(method, kind).median
                for core in CORES:
                    instructions = results.costs[core, form].entry(method, kind).median
                    found[form][core].append((int(number), float(instructions / number)))
    return found


def ratios(results: Results) -> Rows:
    """Instructions for each operation, over all jobs: by form and core."""
    rows: Rows = [["Update", "core", "least", "median", "most", "most, from 1,000 operations on"]]
    for form, by_core in per_operation(results).items():
        for core, of_jobs in by_core.items():
            every = [ratio for _, ratio in of_jobs]
            large = [ratio for number, ratio in of_jobs if number >= 1000]
            cells = [f"{value:.2f}" for value in (min(every), median(every), max(every), max(large))]
            rows.append([form, SOURCES[core], *cells])
    return rows


def speeds(found: Sequence[Compared], form: CovarianceFormName) -> Rows:
    """Least speeds of the first design, in units of the standard filter's, by every source."""
    names = list(dict.fromkeys(one.source for one in found))
    rows: Rows = [["Method", "counted", *(SOURCES[name] for name in names), DIFFER]]
    for method in METHODS[1:]:
        of_method = {one.source: one for one in found if (one.form, one.method, one.timing) == (form, method, FIRST)}
        first = next(iter(of_method.values()))
        cells = [_speed(of_method[name]) for name in names]
        emulated = largest(one for one in of_method.values() if one.source in CORES)
        rows.append([METHOD_NAMES[method], f"{float(first.counted):.3f}", *cells, signed(emulated.deviation)])
    return rows


def answer(halves: Mapping[str, Sequence[Row]]) -> Rows:
    """For a spreadsheet: of what is timed here, in columns of its own."""
    rows: Rows = [["of", "source", "least", "most", *map(marked, ("timed here", "least", "most"))]]
    for half, found in halves.items():
        for row in found:
            cells, none = [row.name, *(f"{float(end):.4f}" for end in row.ends)], [""] * 3
            rows.append([half, *none, *cells] if MARK in row.name else [half, *cells, *none])
    return rows


def measurements(results: Results) -> Rows:
    """What each measurement gives: least speeds of the first design, in units of the standard filter's, by medians."""

    def of(method: str) -> Shown[CostTable]:
        return lambda table: f"{float(relative_speed(table, method, FIRST)):.2f}"

    rows: Rows = []
    for name in HERE:
        for form in FORMS:
            if (name, form) in results.costs:
                figures = {METHOD_NAMES[method]: of(method) for method in PAPERS}
                heading, *body = measurement_rows(results.measurements(name, form), figures)
                rows = rows or [[marked("Source"), marked("Update"), *heading]]
                rows += [[unmarked(SOURCES[name]), form, *row] for row in body]
    return rows


def without(rows: Rows, sources: Sequence[str]) -> Rows:
    """Of `speeds`, without the columns of these sources, and of what is said of them."""
    left_out = {SOURCES[name] for name in sources} | ({DIFFER} if set(sources) == set(CORES) else set())
    kept = [number for number, heading in enumerate(rows[0]) if heading not in left_out]
    return [[row[number] for number in kept] for row in rows]


def _speed(one: Compared) -> str:
    if one.source in CORES:
        return f"{float(one.speed):.3f}"
    ends = (f"{float(end):.2f}" for end in (one.least, one.most))
    return f"{float(one.speed):.2f} ({span(*ends)})"


def deviations(found: Sequence[Compared]) -> Rows:
    """The largest of all designs, by form, methods and source."""
    names = list(dict.fromkeys(one.source for one in found))
    rows: Rows = [["Update", "methods", *(f"{SOURCES[name]}, %" for name in names)]]
    for form in FORMS:
        for name_of, methods in (("Steffes 2014", PAPERS), ("others", OTHERS)):
            of = [one for one in found if one.form == form and one.method in methods]
            cells = [signed(largest(one for one in of if one.source == name).deviation) for name in names]
            rows.append([form, name_of, *cells])
    return rows


def all_speeds(found: Sequence[Compared]) -> Rows:
    """For a spreadsheet."""
    rows: Rows = [["update", "N", "M", "L", "method", "counted", *_columns(found)]]
    keys = list(dict.fromkeys((one.form, one.timing, one.method) for one in found))
    by_key = {(one.form, one.timing, one.method, one.source): one for one in found}
    names = list(dict.fromkeys(one.source for one in found))
    for form, timing, method in keys:
        of = [by_key[form, timing, method, name] for name in names]
        numbers = [f"{float(one.speed):.4f}" for one in of]
        row = [form, str(timing.N), str(timing.M), str(timing.L), method, f"{float(of[0].counted):.4f}"]
        rows.append([*row, *numbers])
    return rows


def _columns(found: Sequence[Compared]) -> list[str]:
    return [SOURCES[name] for name in dict.fromkeys(one.source for one in found)]
