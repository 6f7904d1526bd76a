"""Rows for people (a table) and for scripts (JSON, CSV: no colour, no progress, nothing rounded)."""

from __future__ import annotations

import csv
import json
import sys
from collections.abc import Mapping, Sequence
from typing import Any, Literal

Row = Mapping[str, Any]
Format = Literal["table", "json", "csv"]

PLURALS = {"standard step": "standard steps", "second": "seconds", "operation": "operations"}


def units(unit: str) -> str:
    """The plural of a cost table's unit, where it is a word; "ms" stays."""
    return PLURALS.get(unit, unit)


def print_json(document: Any) -> None:
    print(json.dumps(document, indent=2))


def print_csv(rows: Sequence[Row]) -> None:
    writer = csv.DictWriter(sys.stdout, fieldnames=list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)


def print_table(title: str, rows: Sequence[Row], note: str = "") -> None:
    """Columns are the rows' keys; numbers are aligned right. Nothing is cut off: long headings wrap, and a table that
    goes into a file or a pipe is as wide as it needs to be."""
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table

    console = Console()
    if not console.is_terminal:
        console.width = 1000
    console.print(title, style="bold", highlight=False, markup=False)
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    for key, value in rows[0].items():
        table.add_column(key, justify="left" if _is_text(value) else "right", overflow="fold")
    for row in rows:
        table.add_row(*("-" if value is None else str(value) for value in row.values()))
    console.print(table)
    if note:
        console.print(note, highlight=False, markup=False)


def _is_text(value: Any) -> bool:
    return isinstance(value, str) and not value[:1].isdigit()
