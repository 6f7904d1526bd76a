"""`sched-sim report`: measure, simulate, analyse and write the published report."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

Name = Annotated[Literal["steffes2014"], typer.Argument(help="Which report.")]
Folder = Annotated[Path, typer.Option("--output", "-o", help="Folder in which the report's own folder is written.")]


def report(
    name: Name = "steffes2014",
    thorough: Annotated[bool, typer.Option("--thorough", help="Measure ten times as many rounds.")] = False,
    output: Folder = Path("reports/published"),
) -> None:
    """Measure the filters here and regenerate a report: HTML, Markdown, figures (SVG) and tables (CSV).

    sched-sim report --thorough
    """
    from filters.systems.example import example_system
    from reports.render import make_folder, write_report
    from reports.steffes import build
    from sched_sim.cli.progress import progress_bar
    from studies.measure import measure

    folder = output / name
    make_folder(folder)
    with progress_bar("Measuring") as progress:
        measured = measure(
            example_system(9, 3, 3), "compiled", name="measured-9-3-3", thorough=thorough, progress=progress
        )
    write_report(build(measured), folder)
    typer.echo(f"Wrote {folder / 'index.html'}, the same as index.md, its figures and tables", err=True)
