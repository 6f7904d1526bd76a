"""Rows for people (a table) and for scripts (JSON, CSV: no colour, no progress, all digits)."""

from __future__ import annotations

import csv
import os
import sys
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

from sched_sim.text import csv_cell, json_text, visible, visible_lines

if TYPE_CHECKING:
    from rich.text import Text

    from sched_sim.cli.columns import Column

Row = Mapping[str, Any]
Format = Literal["table", "json", "csv"]

UNBOUNDED = 10**6
"""Columns of a file or a pipe, unless COLUMNS says how many."""


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
    """Columns are the rows' keys; numbers are aligned right. A table that goes into a file or a pipe is as wide as it
    needs to be, or at most as wide as the variable COLUMNS says. Where there is too little room, headings wrap, then
    the least important columns are left out, which a line below says; where that is not enough, each row is a list of
    its own."""
    from rich.console import Console
    from rich.text import Text

    from sched_sim.cli.columns import fitted

    console = Console()
    if not console.is_terminal:
        console.width = asked_width() or UNBOUNDED
    console.print(_text(visible(title), "bold"))
    columns = [_column(key, [row[key] for row in rows]) for key in rows[0]]
    columns[0] = columns[0]._replace(words=False)  # names
    found = fitted(columns, console)
    if found is None:
        for number in range(len(rows)):
            console.print()
            for column in columns:
                console.print(Text.assemble(column.heading, ": ", column.cells[number]))
        console.print()
    else:
        console.print(found.table)
        if found.left_out:
            narrow = "the terminal is narrow" if console.is_terminal else f"COLUMNS is {console.width}"
            note = lines(f"left out, as {narrow}: {', '.join(found.left_out)}; --format json has all", note)
    if note:
        console.print(_text("\n".join(map(visible, note.split("\n")))))


def asked_width() -> int | None:
    """What the variable COLUMNS says; None where it says no number of columns."""
    said = os.environ.get("COLUMNS", "")
    return int(said) or None if said.isascii() and said.isdigit() and len(said) < MOST_DIGITS else None


MOST_DIGITS = 7
"""Of COLUMNS."""


def _column(heading: str, values: Sequence[Any]) -> Column:
    from sched_sim.cli.columns import Column

    texts = ["-" if value is None else visible(str(value)) for value in values]
    words = not any(character.isdigit() for text in texts for character in text)
    return Column(_text(heading), [_text(text) for text in texts], not _is_text(values[0]), words)


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
