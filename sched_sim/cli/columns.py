"""Which columns of a table there is room for in a terminal, and how wide each is: no number and no name is broken."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.measure import Measurement
from rich.table import Table
from rich.text import Text

SPARE = ("preempted", "exactly", "load", "on the way", "jobs", "taken", "mean", "min", "p95", "median", "precision",
         "believed", "jump", "parts that do", "slack", "highest HR Hz", "logic per arithmetic", "std steps",
         "function", "after, ms", "rms", "oldest age, ms", "oldest age, steps", "how", "structure")  # fmt: skip
"""Headings that a narrow terminal goes without, of whichever table, the least important first."""


class Column(NamedTuple):
    """cells: from top to bottom; right: whether they are aligned so; words: whether they may wrap between words."""

    heading: Text
    cells: Sequence[Text]
    right: bool
    words: bool


class Fitted(NamedTuple):
    """A table that fits, and the headings for which there was no room."""

    table: Table
    left_out: Sequence[str]


def fitted(columns: Sequence[Column], console: Console) -> Fitted | None:
    """As many of the columns as fit the console's width, headings wrapped between words where they must, and where that
    is not enough words in cells too; None if the columns do not fit without the spare ones."""
    headings = {column.heading.plain for column in columns}
    spare = [heading for heading in SPARE if heading in headings]
    for wrapped in (False, True):
        for number in range(len(spare) + 1):
            left_out = spare[:number]
            kept = [
                column._replace(words=column.words and wrapped)
                for column in columns
                if column.heading.plain not in left_out
            ]
            if widths := _widths(kept, console):
                return Fitted(_table(kept, widths), left_out)
    return None


def _widths(columns: Sequence[Column], console: Console) -> Sequence[int]:
    """Taken from the columns that can be narrower than their longest text, always from the one that can be by most;
    none if they do not fit."""
    bounds = [_bounds(column, console) for column in columns]
    least, widths = [bound for bound, _ in bounds], [most for _, most in bounds]
    around = Measurement.get(console, console.options.update(max_width=10**6), _table(columns, widths)).maximum
    over = around - console.width
    if over > sum(widths) - sum(least):
        return ()
    for _ in range(over):
        slack = [width - bound for width, bound in zip(widths, least, strict=True)]
        widths[slack.index(max(slack))] -= 1
    return widths


def _bounds(column: Column, console: Console) -> tuple[int, int]:
    """The least width at which nothing is broken, and that at which nothing wraps."""
    heading, *cells = (Measurement.get(console, console.options, text) for text in (column.heading, *column.cells))
    least = max(heading.minimum, *(cell.minimum if column.words else cell.maximum for cell in cells))
    return least, max(heading.maximum, *(cell.maximum for cell in cells))


def _table(columns: Sequence[Column], widths: Sequence[int]) -> Table:
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    for column, width in zip(columns, widths, strict=True):
        table.add_column(column.heading, justify="right" if column.right else "left", width=width, overflow="fold")
    for row in zip(*(column.cells for column in columns), strict=True):
        table.add_row(*row)
    return table
