"""`sched-sim report`: measure, simulate, analyse and write a report, or all of them."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Mapping
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from sched_sim.cli.measured_note import say_busy
from sched_sim.cli.output import say
from sched_sim.cli.progress import Progress, progress_bar
from sched_sim.errors import InputError

if TYPE_CHECKING:
    from reports.pages.made import Made

Name = Annotated[
    Literal["steffes2014", "patent-multirate", "erkf", "modular", "accuracy", "embedded"] | None,
    typer.Argument(
        help="Which report: steffes2014, which is the default: what processor a late measurement asks for; "
        "patent-multirate: a gain in every n-th step; erkf: an extended robust filter; modular: filters composed of "
        "parts; accuracy: what landing later costs; embedded: how near counts come to boards.",
        show_default=False,
    ),
]
All = Annotated[
    bool, typer.Option("--all", help="Make every report, one after another; if one fails, the others are made.")
]
Folder = Annotated[
    Path,
    typer.Option("--output", "-o", help="Folder of the reports' own folders, and of index.html, the page of them all."),
]
Thorough = Annotated[
    bool,
    typer.Option("--thorough", help="Measure ten times as many rounds; patent-multirate and accuracy measure nothing."),
]


def report(
    name: Name = None, all_reports: All = False, thorough: Thorough = False, output: Folder = Path("build/reports")
) -> None:
    """Regenerate a report, or all: HTML, Markdown, figures (SVG), tables (CSV), and when, where and in how long it was
    made (made.toml). steffes2014, erkf, modular and embedded measure here. Ctrl-C keeps the reports that are done.

    sched-sim report
    sched-sim report patent-multirate
    sched-sim report modular --output mine
    sched-sim report --thorough
    sched-sim report --all
    """
    from reports.pages.overview import check_overview
    from reports.pages.render import make_folder

    if name is not None and all_reports:
        raise InputError(f"{name} and --all: --all makes every report; leave out one of them")
    make_folder(output)
    check_overview(output)
    name = name or "steffes2014"
    try:
        if all_reports:
            _make_all(thorough, output)
            return
        with progress_bar(name) as progress:
            _make(name, thorough, output, progress)
    except KeyboardInterrupt:
        done = f"; what is done is in {output}" if any((output / name).exists() for name in REPORTS) else ""
        say(f"Stopped: what was being made is not written, and nothing of before is lost{done}")
        raise typer.Exit(128 + signal.SIGINT) from None
    say(f"Wrote {_page(output / name)}, the same as index.md, its figures and tables; all reports: {_page(output)}")


def _make(name: str, thorough: bool, output: Path, progress: Progress) -> float:
    """Writes the report, and the page of all reports anew; the seconds that it took to make it."""
    from reports.pages.made import made_here, with_made
    from reports.pages.overview import overview
    from reports.pages.render import make_folder, write_report

    folder = output / name
    if os.path.lexists(folder):
        make_folder(folder)  # to know before the work that it can be written
    begun = monotonic()
    files = REPORTS[name](thorough, progress)
    seconds = monotonic() - begun
    make_folder(folder)
    write_report(with_made(files, made_here(seconds)), folder)
    write_report(overview(output, REPORTS), output)
    return seconds


def _make_all(thorough: bool, output: Path) -> None:
    """Raises InputError if some could not be made, once the others are."""
    from reports.pages.numbers import duration

    if not thorough:
        say(_expected(output))
    begun, failed = monotonic(), []
    with progress_bar("Reports") as show:
        for number, name in enumerate(REPORTS, start=1):
            which = f"{number} of {len(REPORTS)}, {name}"

            def progress(done: int, total: int | None, what: str, which: str = which) -> None:
                show(done, total, f"{which}: {what}")

            show(0, None, which)
            try:
                seconds = _make(name, thorough, output, progress)
            except Exception as error:  # of any kind: the other reports are to be made
                failed.append(name)
                say(f"{name}: not made: {error or type(error).__name__}")
            else:
                say(f"{name}: {duration(seconds)}, {_page(output / name)}")
    if failed:
        raise InputError(
            f"{len(failed)} of {len(REPORTS)} reports could not be made; the others are in {output}. To see why: "
            + ", ".join(f"`sched-sim report {name}`" for name in failed)
        )
    say(f"Wrote {len(REPORTS)} reports in {duration(monotonic() - begun)}: {_page(output)}")


def _expected(output: Path) -> str:
    """How long it will take, by how long each report took when it was last made here, or where it is published."""
    import reports
    from reports.pages.numbers import duration

    published = Path(reports.__file__).parent / "published"
    last = {name: _last(output / name) or _last(published / name) for name in REPORTS}
    seconds = {name: made.seconds for name, made in last.items() if made is not None and made.seconds is not None}
    if not seconds:
        return f"{len(REPORTS)} reports; how long they take is not known here: some minutes"
    each = ", ".join(f"{name} {duration(seconds[name])}" if name in seconds else f"{name} ?" for name in REPORTS)
    return f"{len(REPORTS)} reports, about {duration(sum(seconds.values()))} by their last runs: {each}"


def _last(folder: Path) -> Made | None:
    """What its last making wrote of itself; None if that cannot be read: it is about to be replaced."""
    from reports.pages.made import made_of

    try:
        return made_of(folder)
    except InputError:
        return None


def _page(folder: Path) -> Path:
    return folder / "index.html"


def _steffes(thorough: bool, progress: Progress) -> dict[str, bytes]:
    from filters.systems.example import example_system
    from reports.steffes.report import build
    from sched_sim.costs.methods import PAPER_METHODS
    from studies.machines.store import kept
    from studies.measurement.methods import measure

    measured = measure(
        example_system(9, 3, 3),
        "compiled",
        name="measured-9-3-3",
        thorough=thorough,
        progress=progress,
        methods=PAPER_METHODS,
    )
    say_busy(measured.name, measured.provenance)
    return build(measured, kept(measured.name))


def _patent_multirate(_thorough: bool, progress: Progress) -> dict[str, bytes]:
    from reports.multirate.report import build
    from reports.multirate.results import results

    figures = results(progress)
    return build(figures)


def _erkf(thorough: bool, progress: Progress) -> dict[str, bytes]:
    from reports.erkf.report import build
    from reports.erkf.results import results

    figures = results(thorough, progress)
    for measured in figures.measured.values():
        say_busy(measured.name, measured.provenance)
    return build(figures)


def _modular(thorough: bool, progress: Progress) -> dict[str, bytes]:
    from reports.modular.report import build
    from reports.modular.results import results

    figures = results(thorough, progress)
    return build(figures)


def _accuracy(_thorough: bool, progress: Progress) -> dict[str, bytes]:
    from reports.accuracy.report import build
    from reports.accuracy.results import results

    figures = results(progress)
    return build(figures)


def _embedded(thorough: bool, progress: Progress) -> dict[str, bytes]:
    from reports.embedded.report import build
    from reports.embedded.results import results

    found = results(thorough, progress)
    for measured in found.costs.values():
        say_busy(measured.name, measured.provenance)
    for missing in filter(None, found.said.values()):
        say(f"Note: {missing}")
    return build(found)


REPORTS: Mapping[str, Callable[[bool, Progress], dict[str, bytes]]] = {
    "steffes2014": _steffes,
    "patent-multirate": _patent_multirate,
    "erkf": _erkf,
    "modular": _modular,
    "accuracy": _accuracy,
    "embedded": _embedded,
}
