"""A choice as a table that a notebook shows."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sched_sim.html_table import html_table

if TYPE_CHECKING:
    from studies.selection.choose import Candidate, Choice

HEADINGS = (
    "method",
    "how",
    "every",
    "land by L",
    "std then",
    "least speed",
    "part",
    "of its speed",
    "lands at L",
    "std",
)


def choice_html(choice: Choice) -> str:
    """The best way of each method, then why the others do not."""
    unit = f" {choice.outputs.unit}" if choice.outputs.unit else ""
    caption = (
        f"{choice.model.name}: {choice.metric} of {choice.outputs.name} within {choice.within:g}{unit}; least speed in "
        f"{choice.unit}s per HR period"
    )
    rows = [_cells(candidate) for candidate in choice.best]
    rows += [(of.variant.method, of.reason, of.variant.every, *[None] * 7) for of in choice.others]
    return html_table(caption, HEADINGS, rows)


def _cells(of: Candidate) -> tuple[Any, ...]:
    on = of.cheapest
    speed = None if of.least is None else float(of.least.speed)
    start = (of.variant.method, of.variant.how, of.variant.every, of.L, of.std, speed)
    if on is None:
        return (*start, of.reason or None, None, of.landed, of.landed_std)
    return (*start, on.part.name, on.needed, on.landed, on.std)
