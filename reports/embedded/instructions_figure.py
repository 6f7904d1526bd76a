"""How many instructions an operation takes on each core."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from filters.covariance_forms import CovarianceFormName
from reports.drawing.axes import plain
from reports.drawing.legend import line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import GREY, Line, drawing
from reports.embedded.signs import numbers_at
from reports.embedded.words import IN_HARDWARE, LINES, SOURCES

PerOperation = Mapping[CovarianceFormName, Mapping[str, Sequence[tuple[int, float]]]]
"""By form and core, of each job: its operations, and instructions for each."""

ASSUMED = Line(GREY, (0, (4.0, 1.5)), "None")


def instructions_figure(of_jobs: PerOperation, assumed: float) -> Figure:
    """Instructions for each operation against the operations of the job: a column for each form, above with arithmetic
    in software, below in hardware; a sign for each core.

    assumed: what the files of parts take for it.
    """
    cores = list(dict.fromkeys(core for by_core in of_jobs.values() for core in by_core))
    with drawing():
        legend = [line_entry(SOURCES[core], LINES[core], dashes=False) for core in cores]
        legend.append(line_entry(f"{assumed:g}: what parts' files take", ASSUMED))
        figure, rows = sheet(2, len(of_jobs), legend, height_mm=30.0, stacked=True)
        for column, (form, by_core) in enumerate(of_jobs.items()):
            above, below = rows[0][column], rows[1][column]
            _jobs(above, {core: jobs for core, jobs in by_core.items() if core not in IN_HARDWARE})
            _jobs(below, {core: jobs for core, jobs in by_core.items() if core in IN_HARDWARE})
            below.axhline(assumed, color=ASSUMED.colour, lw=0.9, ls=ASSUMED.dashes, zorder=1)
            numbers = [operations for jobs in by_core.values() for operations, _ in jobs]
            for axes in (above, below):
                axes.set(xscale="log", xlim=(min(numbers) / 1.3, 1.3 * max(numbers)))
                numbers_at(axes.xaxis, (10, 30, 100, 300, 1000, 3000, 10_000))
            label(above, f"{form} update")
            label(below, across="operations of the job (logarithmic)")
        for row in rows:
            highest = max(axes.get_ylim()[1] for axes in row)
            for axes in row:
                axes.set_ylim(0, highest)
        rows[0][0].set_ylabel("instructions for each", labelpad=2)
        rows[1][0].set_ylabel("instructions for each", labelpad=2)
        return figure


def _jobs(axes: Axes, by_core: Mapping[str, Sequence[tuple[int, float]]]) -> None:
    for core, jobs in by_core.items():
        across, up = zip(*jobs, strict=True)
        line = LINES[core]
        axes.plot(across, up, line.marker, color=line.colour, ms=line.size, mew=0, ls="none", label=SOURCES[core])
    axes.set_ylim(0, 1.12 * max(ratio for jobs in by_core.values() for _, ratio in jobs))
    plain(axes)
