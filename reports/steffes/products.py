"""Multiplies of one HR step against the length of the state."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator

from reports.drawing.axes import end_labels
from reports.drawing.legend import line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import METHOD_LINES, NOISE_LINES, Line, drawing
from reports.steffes.signs import hollow_entry
from studies.steffes.products import STEPS, Multiplies

HEIGHT_MM, RIGHT_MM = 42.0, 34.0
LINES: dict[tuple[str, str], Line] = {
    ("standard", "propagate"): METHOD_LINES["standard"],
    ("larsen", "propagate_accumulate"): METHOD_LINES["larsen"]._replace(size=7.0),
    ("dual-rate", "hr_propagate"): METHOD_LINES["dual-rate"],
    ("dual-rate", "hr_propagate_sum"): NOISE_LINES["sum"]._replace(size=7.0),
    ("dual-rate", "hr_propagate_euler"): NOISE_LINES["euler"],
}

BEHIND = (("larsen", "propagate_accumulate"), ("dual-rate", "hr_propagate_sum"))
"""Drawn hollow, since another lies on each of them."""
ENDS = {
    ("dual-rate", "hr_propagate"): "one more product",
    ("standard", "propagate"): "standard",
    ("dual-rate", "hr_propagate_sum"): "two fewer: $Q'$, $Q''$",
}


def products_figure(counted: Sequence[Multiplies]) -> Figure:
    """In units of one n x n x n product, so that curves one product apart are 1 apart."""
    n = [one.n for one in counted]
    with drawing():
        legend = [
            hollow_entry(STEPS[job], line, line.size) if job in BEHIND else line_entry(STEPS[job], line)
            for job, line in LINES.items()
        ]
        drawn = sheet(1, 1, legend, height_mm=HEIGHT_MM, right_mm=RIGHT_MM)
        ((axes,),) = drawn.plots
        for job, line in LINES.items():
            up = [one.by_job[job] / one.n**3 for one in counted]
            look = {"mfc": "none", "mew": 0.9, "zorder": 2.5} if job in BEHIND else {"mew": 0, "zorder": 3}
            axes.plot(
                n,
                up,
                marker=line.marker,
                color=line.colour,
                ls=line.dashes,
                lw=1.0,
                ms=line.size,
                label=STEPS[job],
                **look,
            )
        last = counted[-1]
        axes.set(ylim=(0, 1.1 * max(value / one.n**3 for one in counted for value in one.by_job.values())))
        axes.xaxis.set_major_locator(FixedLocator(n))
        heights = [last.by_job[job] / last.n**3 for job in ENDS]
        end_labels(axes, heights, list(ENDS.values()), HEIGHT_MM)
        label(axes, "In an HR step", "states $n$", "multiplies / $n^3$")
        return drawn.figure
