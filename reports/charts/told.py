"""A Gantt panel as the plain data that a script draws it from."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from reports.charts.panels import Panel
from reports.drawing.readout import plain_text
from studies.explorer.document import document
from studies.explorer.schedule import StepMark, shown

DECIMALS = 4
"""Of an instant, in HR periods."""
BUSY = " % busy"
"""How a note ends that the chart says of itself."""


def told(panel: Panel) -> dict[str, Any]:
    """Its "title", "notes" and "schedule": a document of `studies.explorer.schedule`, with instants to `DECIMALS`, and
    with its first step as "origin" where the panel begins later than at 0; of steps not shown it has no jobs."""
    schedule, period = panel.schedule, panel.schedule.period
    first, end = panel.first * period, panel.end * period
    alive = {(piece.kind, piece.step) for piece in schedule.slices if piece.end > first and piece.release < end}
    seen = replace(schedule, slices=tuple(piece for piece in schedule.slices if (piece.kind, piece.step) in alive))
    marks = [StepMark(mark.step, mark.text, mark.meaning) for mark in panel.marks]
    whole = document(shown(seen, panel.end, marks))
    return {
        "title": panel.title,
        "notes": [plain_text(note) for note in panel.notes if not note.endswith(BUSY)],
        "schedule": {
            **rounded(whole),
            "busy": float(f"{whole['busy']:.3g}"),
            **({"origin": panel.first} if panel.first else {}),
        },
    }


def rounded(value: Any) -> Any:
    """A document whose numbers have so many decimals, and whole ones no point: shorter in JSON."""
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    if isinstance(value, list):
        return [rounded(item) for item in value]
    if isinstance(value, float):
        return int(value) if value.is_integer() else round(value, DECIMALS)
    return value
