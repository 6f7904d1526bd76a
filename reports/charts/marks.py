"""The lines and labels at k, m, l, k+N ... of a Gantt panel."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes

from reports.charts.scale import Scale
from reports.drawing.placing import spread, worst_shift
from reports.drawing.style import FONT_PT, INK, text_width_mm
from sched_sim.design.cycle_marks import Mark

GAP_MM = 1.2
FARTHEST_MM = 4.0
"""A label stands no farther from its line."""
STRIDES = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000)
NARROWEST_MM = 2.0
"""A label and the gap beside it take at least so much: spares measuring labels by the thousand."""
BEYOND_MM = 5.0
"""So far a label may reach beyond the ends of the axis."""


def labels(marks: Sequence[Mark], scale: Scale) -> list[tuple[Mark, float]]:
    """The marks that can be labelled without crowding, with the centres of their labels in mm.

    Where not all fit, m and l of later cycles go first, then all m and l, then every second k, and so on.
    """
    marks = [mark for mark in marks if scale.first <= mark.step <= scale.end]
    first_cycle = min((mark.cycle for mark in marks), default=0)
    choices = [marks, [mark for mark in marks if mark.is_k or mark.cycle == first_cycle]]
    choices += [[mark for mark in marks if mark.is_k and mark.cycle % stride == 0] for stride in STRIDES]
    for chosen in choices:
        if len(chosen) * NARROWEST_MM > scale.width_mm:
            continue
        centres = [scale.mm(mark.step) for mark in chosen]
        widths = [text_width_mm(f"${mark.text}$") for mark in chosen]
        placed = spread(centres, widths, -BEYOND_MM, scale.width_mm + BEYOND_MM, GAP_MM)
        if worst_shift(centres, placed) <= FARTHEST_MM:
            return list(zip(chosen, placed, strict=True))
    return []


def draw_marks(axes: Axes, marks: Sequence[Mark], scale: Scale, height_mm: float) -> None:
    """Dashed lines down the panel, and their labels above it. The y axis of `axes` is in mm."""
    for mark, centre in labels(marks, scale):
        at = scale.mm(mark.step)
        axes.plot([mark.step, mark.step], [0, height_mm], color=INK, lw=0.7, dashes=(4, 2), zorder=0.6, clip_on=False)
        axes.plot(
            [mark.step, scale.at(at + (centre - at) * 0.6)],
            [height_mm, height_mm + 0.9],
            color=INK,
            lw=0.6,
            zorder=0.6,
            clip_on=False,
        )
        axes.text(scale.at(centre), height_mm + 1.1, f"${mark.text}$", ha="center", va="bottom", size=FONT_PT)
