"""Rows for people (a table) and for scripts (JSON, CSV: no colour, no progress, all digits)."""

from __future__ import annotations

import csv
import sys
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

from sched_sim.text import csv_cell, json_text, visible, visible_lines

if TYPE_CHECKING:
    from rich.text import Text

Row = Mapping[str, Any]
Format = Literal["table", "json", "csv"]

PLURALS = {"standard step": "standard steps", "second": "seconds", "operation": "operations"}


def units(unit: str) -> str:
    """The plural of a cost table's unit, where it is a word; "ms" stays."""
    return PLURALS.get(unit, unit)


def say(message: str) -> None:
    """A message to the person who is at it, on standard error."""
    print(visible_lines(message), file=sys.stderr)


def print_json(document: Any) -> None:
    print(json_text(document, indent=2))


def print_csv(rows: Sequence[Row]) -> None:
    writer = csv.DictWriter(sys.stdout, fieldnames=list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows({key: csv_cell(value) for key, value in row.items()} for row in rows)


def print_table(title: str, rows: Sequence[Row], note: str = "") -> None:
    """Columns are the rows' keys; numbers are aligned right. Nothing is cut off: long headings wrap, and a table that
    goes into a file or a pipe is as wide as it needs to be."""
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table

    console = Console()
    if not console.is_terminal:
        console.width = 1000
    console.print(_text(visible(title), "bold"))
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    for key, value in rows[0].items():
        table.add_column(key, justify="left" if _is_text(value) else "right", overflow="fold")
    for row in rows:
        table.add_row(*(_text("-" if value is None else visible(str(value))) for value in row.values()))
    console.print(table)
    if note:
        console.print(_text("\n".join(map(visible, note.split("\n")))))


def _text(text: str, style: str = "") -> Text:
    """Not taken for markup; what standard output cannot encode is an escape before the columns are laid out."""
    from rich.text import Text

    encoding = sys.stdout.encoding or "utf-8"
    return Text(text.encode(encoding, "backslashreplace").decode(encoding), style)


def lines(*notes: str) -> str:
    """Those that are not empty, one below the other."""
    return "\n".join(note for note in notes if note)


def _is_text(value: Any) -> bool:
    return isinstance(value, str) and not value[:1].isdigit()
