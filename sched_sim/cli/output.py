"""Rows for people (a table) and for scripts (JSON, CSV: no colour, no progress, nothing rounded)."""

from __future__ import annotations

import csv
import json
import sys
from collections.abc import Mapping, Sequence
from typing import Any, Literal

Row = Mapping[str, Any]
Format = Literal["table", "json", "csv"]


def print_json(document: Any) -> None:
    print(json.dumps(document, indent=2))


def print_csv(rows: Sequence[Row]) -> None:
    writer = csv.DictWriter(sys.stdout, fieldnames=list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)


def print_table(title: str, rows: Sequence[Row], note: str = "") -> None:
    """Columns are the rows' keys; numbers are aligned right."""
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table

    console = Console()
    console.print(title, style="bold", highlight=False)
    table = Table(box=SIMPLE_HEAD, pad_edge=False)
    for key, value in rows[0].items():
        table.add_column(key, justify="left" if isinstance(value, str) else "right", no_wrap=isinstance(value, str))
    for row in rows:
        table.add_row(*("-" if value is None else str(value) for value in row.values()))
    console.print(table)
    if note:
        console.print(note, highlight=False)
