"""Rows as a table of plain text, for `print` and the interactive shell."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import Any

from sched_sim.text import visible


def plain_table(caption: str, headings: Sequence[str], rows: Iterable[Sequence[Any]], notes: Sequence[str] = ()) -> str:
    """Numbers are aligned right, to six digits; a dash stands for None, and for what is not said."""
    table = [list(row) for row in rows]
    texts = [[_text(value) for value in row] for row in table]
    right = [all(value is None or _is_number(value) for value in column) for column in zip(*table, strict=True)]
    widths = [max(map(len, column)) for column in zip(headings, *texts, strict=True)]

    def line(cells: Sequence[str]) -> str:
        aligned = (
            cell.rjust(width) if number else cell.ljust(width)
            for cell, width, number in zip(cells, widths, right, strict=True)
        )
        return "  ".join(aligned).rstrip()

    body = [line(headings), *map(line, texts)] if table else []
    return "\n".join([visible(caption), *body, *map(visible, notes)])


def _text(value: Any) -> str:
    if value is None or value == "":
        return "-"
    if isinstance(value, int):
        return f"{value:,}"
    return f"{float(value):.6g}" if _is_number(value) else visible(str(value))


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float | Fraction)
