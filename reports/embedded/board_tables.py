"""Tables of published timings, of memory and of the known loop."""

from __future__ import annotations

from collections.abc import Mapping

from filters.covariance_forms import CovarianceFormName
from reports.charts.panels import METHOD_NAMES
from reports.embedded.results import PRECISIONS, Results
from reports.embedded.words import CORES, SOURCES, WRITTEN, as_ratio, factor
from reports.pages.numbers import significant, span
from reports.pages.stored import Rows
from studies.embedded.folders import FOLDERS
from studies.embedded.known_loop import INSTRUCTIONS
from studies.embedded.published import times_us
from studies.embedded.sources import METHODS
from studies.measurement.emulation.targets import TARGETS
from studies.measurement.published_timings import PublishedTiming, published_timings

KB = 1024
IN_PRECISION = {"single": "cortex-m4f", "double": "cortex-m7"}
"""The core that has such numbers."""


def timings() -> Mapping[str, PublishedTiming]:
    """Published ones, by a name that says what was timed."""
    return {f"{timing.source}: {timing.job}, n = {timing.states}": timing for timing in published_timings()}


def published(results: Results) -> Rows:
    """Each timing beside what counts, and instructions on the emulated core, say of it."""
    rows: Rows = [["Source", "part", "n, p", "job", "published, µs", "by counts, µs", "ratio", "by instructions, µs"]]
    numbers = [row["instructions"] for row in results.records("boards")]
    for timing, number in zip(published_timings(), numbers, strict=True):
        sizes = f"{timing.states}, {timing.measurements}" if timing.measurements else str(timing.states)
        us = span(*(significant(end) for end in (timing.least_us, timing.most_us)))
        ends = span(*(significant(end) for end in times_us(timing, int(number)))) if number else "-"
        over = span(*map(as_ratio, timing.ratios))
        row = [timing.source, f"{timing.part}, {timing.clock_mhz} MHz", sizes, timing.job]
        rows.append([*row, us, significant(timing.predicted_us), over, ends])
    return rows


def with_addresses(rows: Rows) -> Rows:
    """The same with the page on which each timing was published, and what the code is in its words."""
    heading, *body = rows
    more = [[timing.code, timing.url] for timing in published_timings()]
    return [[*heading, "code", "published at"], *([*row, *of] for row, of in zip(body, more, strict=True))]


def groups() -> Rows:
    """Published over predicted, by how the code is written."""
    rows: Rows = [["Code", "timings", "published over predicted", "within a factor of"]]
    for written, name in WRITTEN.items():
        of = [timing for timing in published_timings() if timing.written == written]
        ends = [end for timing in of for end in timing.ratios]
        rows.append([name, len(of), span(*map(as_ratio, (min(ends), max(ends)))), factor(ends)])
    return rows


def memory_bytes(results: Results, core: str, form: CovarianceFormName) -> dict[str, dict[str, int]]:
    """Of each method: RAM of its tasks, stacks, and code, in bytes; without the model."""
    found = {}
    for method, tasks in results.costs[core, form].provenance["memory"].items():
        own = {task: of for task, of in tasks.items() if task != "model"}
        found[method] = {
            **{task: of["ram"] for task, of in own.items()},
            "stack": sum(of["stack"] for of in own.values()),
            "code": sum(of["code"] for of in own.values()),
        }
    return found


def whole_bytes(results: Results) -> dict[str, dict[str, dict[str, int]]]:
    """Of the folder of each method: RAM and code, in bytes, by core and method, in the order of all methods."""
    found = {(row["method"], row["precision"]): row for row in results.records("folders")}
    return {
        SOURCES[core]: {
            method: {part: int(found[method, precision][part]) for part in ("ram", "code")}
            for method in METHOD_NAMES
            if (method, precision) in found
        }
        for precision, core in IN_PRECISION.items()
    }


def memory(results: Results, form: CovarianceFormName) -> Rows:
    """By method, in single and in double precision: code, RAM of its tasks, stacks."""
    rows: Rows = [["Method", "precision", "code", "RAM, HR", "RAM, LR", "stack, HR", "stack, LR", "RAM and stacks, KB"]]
    for method in METHODS:
        for core in IN_PRECISION.values():
            tasks = results.costs[core, form].provenance["memory"][method]
            both = [tasks["HR"], *([tasks["LR"]] if "LR" in tasks else [])]
            pairs = [cell for what in ("ram", "stack") for cell in [*(f"{of[what]:,}" for of in both), "-"][:2]]
            total = sum(of["ram"] + of["stack"] for of in both) / KB
            code = f"{sum(of['code'] for of in both):,}"
            rows.append([METHOD_NAMES[method], TARGETS[core].precision, code, *pairs, f"{total:.2f}"])
    return rows


def folders(results: Results) -> Rows:
    """What the folder of `sched-sim code` compiles to, by method, in the order of all methods."""
    by_key = {(row["method"], row["precision"]): row for row in results.records("folders")}
    rows: Rows = [["Method", *(f"{what}, {precision}" for precision in PRECISIONS for what in ("code", "RAM"))]]
    for method in (name for name in METHOD_NAMES if name in FOLDERS):
        of = [by_key[method, precision] for precision in PRECISIONS]
        rows.append([METHOD_NAMES[method], *(f"{int(row[what]):,}" for row in of for what in ("code", "ram"))])
    return rows


def checks(results: Results) -> Rows:
    """The known loop, and jobs run twice, on each core."""
    rows: Rows = [["Core", "the loop has", "counted", "again", "jobs run twice", "of which differ"]]
    by_target = {row["target"]: row for row in results.records("checks")}
    for core in CORES:
        cells = [f"{int(by_target[core][key]):,}" for key in ("loop", "loop_again", "jobs", "differing")]
        rows.append([SOURCES[core], f"{INSTRUCTIONS:,}", *cells])
    return rows
