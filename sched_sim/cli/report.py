"""`sched-sim report`: measure, simulate, analyse and write a report."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated, Literal

import typer

from sched_sim.cli.measured_note import say_busy
from sched_sim.cli.output import say

Name = Annotated[
    Literal["steffes2014", "patent-multirate", "erkf", "modular", "accuracy", "embedded"],
    typer.Argument(help="Which report."),
]
Folder = Annotated[Path, typer.Option("--output", "-o", help="Folder in which the report's own folder is written.")]
Thorough = Annotated[
    bool,
    typer.Option("--thorough", help="Measure ten times as many rounds; patent-multirate and accuracy measure nothing."),
]


def report(name: Name = "steffes2014", thorough: Thorough = False, output: Folder = Path("build/reports")) -> None:
    """Regenerate a report: HTML, Markdown, figures (SVG), tables (CSV). steffes2014, erkf, modular and embedded measure
    here.

    sched-sim report --thorough
    sched-sim report patent-multirate
    sched-sim report erkf
    sched-sim report modular --output mine
    sched-sim report accuracy
    sched-sim report embedded
    """
    from reports.pages.render import make_folder, write_report

    folder = output / name
    make_folder(folder)
    write_report(REPORTS[name](thorough), folder)
    say(f"Wrote {folder / 'index.html'}, the same as index.md, its figures and tables")


def _steffes(thorough: bool) -> dict[str, bytes]:
    from filters.systems.example import example_system
    from reports.steffes.report import build
    from sched_sim.cli.progress import progress_bar
    from sched_sim.costs.methods import PAPER_METHODS
    from studies.measurement.methods import measure

    with progress_bar("Measuring") as progress:
        measured = measure(
            example_system(9, 3, 3),
            "compiled",
            name="measured-9-3-3",
            thorough=thorough,
            progress=progress,
            methods=PAPER_METHODS,
        )
    say_busy(measured.name, measured.provenance)
    return build(measured)


def _patent_multirate(_thorough: bool) -> dict[str, bytes]:
    from reports.multirate.report import build
    from reports.multirate.results import results
    from sched_sim.cli.progress import progress_bar

    with progress_bar("Computing") as progress:
        figures = results(progress)
    return build(figures)


def _erkf(thorough: bool) -> dict[str, bytes]:
    from reports.erkf.report import build
    from reports.erkf.results import results
    from sched_sim.cli.progress import progress_bar

    with progress_bar("Measuring and simulating") as progress:
        figures = results(thorough, progress)
    for measured in figures.measured.values():
        say_busy(measured.name, measured.provenance)
    return build(figures)


def _modular(thorough: bool) -> dict[str, bytes]:
    from reports.modular.report import build
    from reports.modular.results import results
    from sched_sim.cli.progress import progress_bar

    with progress_bar("Simulating and measuring") as progress:
        figures = results(thorough, progress)
    return build(figures)


def _accuracy(_thorough: bool) -> dict[str, bytes]:
    from reports.accuracy.report import build
    from reports.accuracy.results import results
    from sched_sim.cli.progress import progress_bar

    with progress_bar("Computing") as progress:
        figures = results(progress)
    return build(figures)


def _embedded(thorough: bool) -> dict[str, bytes]:
    from reports.embedded.report import build
    from reports.embedded.results import results
    from sched_sim.cli.progress import progress_bar

    with progress_bar("Emulating and measuring") as progress:
        found = results(thorough, progress)
    for measured in found.costs.values():
        say_busy(measured.name, measured.provenance)
    for missing in filter(None, found.said.values()):
        say(f"Note: {missing}")
    return build(found)


REPORTS: Mapping[str, Callable[[bool], dict[str, bytes]]] = {
    "steffes2014": _steffes,
    "patent-multirate": _patent_multirate,
    "erkf": _erkf,
    "modular": _modular,
    "accuracy": _accuracy,
    "embedded": _embedded,
}
