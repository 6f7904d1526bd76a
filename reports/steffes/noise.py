"""What Q' and Q'' cost in accuracy, against how much of P is process noise."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure

from reports.drawing.axes import decades
from reports.drawing.legend import Entry, line_entry
from reports.drawing.sheet import label, sheet
from reports.drawing.style import NOISE_LINES, Line, drawing
from reports.steffes.signs import hollow_entry
from studies.steffes.noise import Approximated

HEIGHT_MM = 48.0
NAMES = {"sum": "Q′", "euler": "Q″"}
SHARE = "mean share of $Q_{k-N\\to k}$ in $P_{k^-}$"
SYSTEMS, HOLLOW = ("turning", "inertial"), "inertial"


def noise_figure(found: Sequence[Approximated]) -> Figure:
    """Left: of the covariance that the filter believes; right: of its estimate."""
    lines: dict[tuple[str, str], Line] = {
        (noise, system): line for noise, line in NOISE_LINES.items() for system in SYSTEMS
    }
    with drawing():
        legend = [
            _entry(f"{NAMES[noise]}, {system}", line, hollow=system == HOLLOW)
            for (noise, system), line in lines.items()
        ]
        drawn = sheet(1, 2, legend, height_mm=HEIGHT_MM)
        left, right = drawn.plots[0]
        for (noise, system), line in lines.items():
            of = [one for one in found if (one.noise, one.system) == (noise, system)]
            look = {"mfc": "white", "mew": 0.9} if system == HOLLOW else {"mew": 0}
            for axes, up in ((left, [one.covariance for one in of]), (right, [one.estimate for one in of])):
                axes.plot(
                    [one.share for one in of],
                    up,
                    marker=line.marker,
                    color=line.colour,
                    ls=line.dashes,
                    ms=line.size,
                    label=f"{NAMES[noise]}, {system}",
                    **look,
                )
        for axes, low, every in ((left, 3e-5, 1), (right, 1e-10, 2)):
            decades(axes, "x", 1e-3, 1.0)
            decades(axes, "y", low, 1.0, every=every)
        label(left, "$P_{k^-}$ that the filter believes", SHARE, "error, as a share")
        label(right, "Standard deviation of its estimate", SHARE, "increase, as a share")
        return drawn.figure


def _entry(text: str, line: Line, *, hollow: bool) -> Entry:
    return hollow_entry(text, line, line.size) if hollow else line_entry(text, line)
