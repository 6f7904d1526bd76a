"""Which pieces of work carry their label inside, and which are labelled from above."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from reports.charts.scale import Scale
from reports.drawing.placing import spread, worst_shift
from reports.drawing.style import SMALL_PT, drawable, text_width_mm
from sched_sim.schedule.intervals import TASK, Bar

PADDING_MM = 0.5
GAP_MM = 1.0
FARTHEST_MM = 3.5
"""No callout stands farther from its work."""
APART_MM, APART_INSIDE_MM = 12.0, 30.0
"""How far apart, on average, callouts of one label are at the least; and if others of the row carry it inside."""


class Callout(NamedTuple):
    """A label above its row. centre: of the text; start, end: of the work it names; all in mm along the axis."""

    text: str
    centre: float
    start: float
    end: float


def shown_label(bar: Bar) -> str:
    """What a bar is labelled with: nothing for context switches."""
    return "" if bar.style == "switch" else drawable(bar.style.removeprefix(TASK))


def label_fits(bar: Bar, scale: Scale) -> bool:
    """Whether the bar is long enough, where it is visible, to hold its label."""
    start, end = scale.visible_mm(bar.start, bar.end)
    text = shown_label(bar)
    return bool(text) and end - start >= text_width_mm(text, SMALL_PT) + 2 * PADDING_MM


def callouts(row_bars: Sequence[Bar], scale: Scale) -> list[Callout]:
    """Labels for the jobs of a row in which no bar is long enough to hold it; none where they would crowd.

    A user's task is not called out: its row is its label.
    """
    wanted: defaultdict[str, list[tuple[float, float]]] = defaultdict(list)
    inside = set()
    for (_, _, style), pieces in _by_job(row_bars).items():
        if any(label_fits(bar, scale) for bar in pieces):
            inside.add(style)
            continue
        if style.startswith(TASK) or style == "switch":
            continue
        start, end = scale.visible_mm(pieces[0].start, pieces[-1].end)
        if start < end:
            wanted[style].append((start, end))
    kept = {
        text: spans
        for text, spans in wanted.items()
        if len(spans) * (APART_INSIDE_MM if text in inside else APART_MM) <= scale.width_mm
    }
    while True:
        placed, shift = _placed(kept, scale)
        if shift <= FARTHEST_MM:
            return placed
        del kept[max(kept, key=lambda text: len(kept[text]))]


def _placed(spans_of: Mapping[str, Sequence[tuple[float, float]]], scale: Scale) -> tuple[list[Callout], float]:
    """The labels beside one another along the row, and how far the worst of them is from its work."""
    spans = sorted(
        ((start + end) / 2, start, end, text) for text, own_spans in spans_of.items() for start, end in own_spans
    )
    centres = [centre for centre, _, _, _ in spans]
    widths = [text_width_mm(text, SMALL_PT) for _, _, _, text in spans]
    centres_placed = spread(centres, widths, 0.0, scale.width_mm, GAP_MM)
    placed = [
        Callout(text, centre, start, end) for centre, (_, start, end, text) in zip(centres_placed, spans, strict=True)
    ]
    return placed, worst_shift(centres, centres_placed)


def _by_job(row_bars: Sequence[Bar]) -> Mapping[tuple[str, int, str], list[Bar]]:
    pieces: defaultdict[tuple[str, int, str], list[Bar]] = defaultdict(list)
    for bar in row_bars:
        pieces[bar.kind, bar.step, bar.style].append(bar)
    return pieces
