"""Rows as a table that a notebook shows."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fractions import Fraction
from html import escape
from typing import Any

from sched_sim.text import visible


def html_table(caption: str, headings: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """Numbers are aligned right, to six digits; nothing stands for None."""
    head = "".join(f"<th>{_text(heading)}</th>" for heading in headings)
    body = "".join(f"<tr>{''.join(map(_cell, row))}</tr>" for row in rows)
    return f"<table><caption>{_text(caption)}</caption><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _cell(value: Any) -> str:
    if value is None:
        return "<td></td>"
    if isinstance(value, bool):
        return f"<td>{'yes' if value else 'no'}</td>"
    if isinstance(value, int | float | Fraction):
        shown = f"{value:,}" if isinstance(value, int) else f"{float(value):.6g}"
        return f'<td style="text-align: right">{shown}</td>'
    return f'<td style="text-align: left">{_text(str(value))}</td>'


def _text(text: str) -> str:
    return escape(visible(text))
