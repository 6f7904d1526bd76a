"""The axes below a Gantt chart: steps, and below them milliseconds."""

from __future__ import annotations

from fractions import Fraction

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from reports.charts.scale import Scale
from reports.drawing.style import FONT_PT, SMALL_PT, axes_at, text_width_mm

STEPS_MM, MS_MM = 10.0, 9.0
"""Heights of the two."""
MOST_TICKS, FEWEST_TICKS = 20, 2
APART_MM = 1.5
"""Between the numbers of an axis, at the least."""


def step_ticks(axes: Axes, scale: Scale) -> None:
    """Ticks at whole steps, as many as their numbers leave room for."""
    axes.xaxis.set_major_locator(_locator(scale.first, scale.end, scale.width_mm, integer=True))


def name_steps(axes: Axes, scale: Scale) -> None:
    words = ("start of step $j$ (high-rate periods)", "start of step $j$", "step $j$")
    axes.set_xlabel(_that_fits(words, scale.width_mm), labelpad=2)


def draw_ms(figure: Figure, scale: Scale, hr_hz: Fraction, left: float, top: float) -> None:
    """An axis of the same stretch in ms, `left` and `top` mm from the figure's edges; 0 is the start of step 0."""
    first, end = (float(1000 * Fraction(step) / hr_hz) for step in (scale.first, scale.end))
    axes = axes_at(figure, left, top, scale.width_mm, 0.1)
    axes.set(xlim=(first, end), yticks=[])
    axes.spines[["left", "right", "top"]].set_visible(False)
    axes.xaxis.set_major_locator(_locator(first, end, scale.width_mm, integer=False))
    axes.xaxis.set_major_formatter(lambda ms, _: f"{ms:.10g}")
    axes.set_xlabel(_that_fits((f"time (ms), HR loop at {float(hr_hz):g} Hz", "time (ms)"), scale.width_mm), labelpad=2)


def _locator(first: float, end: float, width_mm: float, *, integer: bool) -> MaxNLocator:
    locators = [
        MaxNLocator(nbins=most, integer=integer, steps=[1, 2, 5, 10])
        for most in range(MOST_TICKS, FEWEST_TICKS - 1, -1)
    ]
    return next((locator for locator in locators if _has_room(locator, first, end, width_mm)), locators[-1])


def _has_room(locator: MaxNLocator, first: float, end: float, width_mm: float) -> bool:
    shown = [float(tick) for tick in locator.tick_values(first, end) if first <= tick <= end]
    widest = max((text_width_mm(f"{tick:.10g}", SMALL_PT) for tick in shown), default=0.0)
    return len(shown) < 2 or (shown[1] - shown[0]) / (end - first) * width_mm >= widest + APART_MM


def _that_fits(texts: tuple[str, ...], width_mm: float) -> str:
    """The first that is no wider than the axis, else the last."""
    return next((text for text in texts if text_width_mm(text, FONT_PT) <= width_mm), texts[-1])
