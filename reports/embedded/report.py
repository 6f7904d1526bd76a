"""The report on counts, emulated cores, times here and published timings side by side."""

from __future__ import annotations

from reports.embedded import board_tables, tables
from reports.embedded.answer_figure import answer_figure, rows_of
from reports.embedded.compared import compared
from reports.embedded.instructions_figure import instructions_figure
from reports.embedded.least_speed_figure import least_speed_figure
from reports.embedded.live import about_live, live_rows, recorded
from reports.embedded.memory_figure import memory_figure
from reports.embedded.published_figure import published_figure
from reports.embedded.results import Results
from reports.embedded.said import ASSUMED, about_boards, about_jobs, about_memory, about_speeds, provenance
from reports.embedded.words import CORES, HERE, OTHERS, PAPERS, SHOWN, SOURCES, on_page
from reports.live.staircase import staircase_figure
from reports.pages.machine import marked
from reports.pages.pictures import files, pictures
from reports.pages.render import csv_bytes, render
from studies.embedded.sources import FORMS
from studies.measurement.published_timings import published_timings

TITLE = "Can counted operations tell what a filter asks of a board?"


def build(results: Results) -> dict[str, bytes]:
    """All files of the report by name, as a pure function of what was emulated and timed."""
    found, live = compared(results), recorded(results.tables)
    halves = rows_of(found, published_timings())
    rows = {
        **{f"jobs-{form}": tables.jobs(results, form) for form in FORMS},
        **{f"times-{form}": tables.times(results, form) for form in FORMS},
        **{f"speeds-{form}": tables.speeds(found, form) for form in FORMS},
        "ratios": tables.ratios(results),
        "deviations": tables.deviations(found),
        "all-speeds": tables.all_speeds(found),
        "measurements": tables.measurements(results),
        "published": board_tables.with_addresses(board_tables.published(results)),
        "groups": board_tables.groups(),
        "memory": board_tables.memory(results, "textbook"),
        "folders": board_tables.folders(results),
        "checks": board_tables.checks(results),
        "staircase": live_rows(live.runs),
        "answer": tables.answer(halves),
    }
    boards = about_boards(results)
    by_jobs = {
        SOURCES[core]: board_tables.memory_bytes(results, core, "textbook")
        for core in board_tables.IN_PRECISION.values()
    }
    figures = pictures(
        {
            "answer.svg": answer_figure(halves),
            "least-speed.svg": least_speed_figure([one for one in found if one.method in PAPERS]),
            "least-speed-others.svg": least_speed_figure([one for one in found if one.method in OTHERS]),
            "instructions.svg": instructions_figure(tables.per_operation(results), ASSUMED),
            "published.svg": published_figure(board_tables.timings(), boards["within"]),
            "memory.svg": memory_figure(board_tables.whole_bytes(results)),
            "memory-jobs.svg": memory_figure(by_jobs),
            "staircase.svg": staircase_figure(live.runs, marked("")),
        }
    )
    shown = {
        **rows,
        "published": board_tables.published(results),
        **{f"jobs-{form}": tables.jobs(results, form, SHOWN) for form in FORMS},
        **{f"times-{form}": tables.times(results, form, SHOWN) for form in FORMS},
        **{f"emulated-{form}": tables.without(rows[f"speeds-{form}"], HERE) for form in FORMS},
        **{f"timed-{form}": tables.without(rows[f"speeds-{form}"], CORES) for form in FORMS},
    }
    pages = render(
        "embedded",
        TITLE,
        figures,
        **{name.replace("-", "_"): on_page(table) for name, table in shown.items()},
        speed=about_speeds(results, found),
        job=about_jobs(results),
        board=boards,
        ram=about_memory(results),
        live={**about_live(live), "not_run": results.said["live"]},
        made=provenance(results),
    )
    return {
        **pages,
        **files(figures),
        **results.files(),
        **{f"{name}.csv": csv_bytes(table) for name, table in rows.items()},
    }
