"""Tables that a report is made from and that are stored beside it, since they depend on the machine: as CSV files."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from filters.arrays import FloatArray
from reports.pages.markdown import Row
from reports.pages.render import csv_bytes

Rows = list[Row]
"""The first one is the heading."""

Tables = Mapping[str, Rows]


def columns(rows: Rows) -> dict[str, FloatArray]:
    """A table of numbers; nan where a cell is empty."""
    heading, *body = rows
    return {str(head): np.array([float(row[number] or "nan") for row in body]) for number, head in enumerate(heading)}


def records(rows: Rows) -> list[dict[str, str]]:
    """The rows by their heading."""
    heading, *body = rows
    return [dict(zip(heading, row, strict=True)) for row in body]


def rows_of(columns: Mapping[str, FloatArray], form: str) -> Rows:
    """A table of numbers written by `form`, such as "{:.3f}"; nan is an empty cell."""
    body = [["" if np.isnan(value) else form.format(value) for value in row] for row in np.array([*columns.values()]).T]
    return [list(columns), *body]


def digits(value: float) -> str:
    """Three of them: what is simulated is stored with no more."""
    return f"{value:#.3g}"


def as_stored(tables: Tables) -> dict[str, Rows]:
    """The same tables as `read_tables` will read them: every cell a text."""
    return {name: [[str(cell) for cell in row] for row in rows] for name, rows in tables.items()}


def table_files(tables: Tables) -> dict[str, bytes]:
    """What `read_tables` reads."""
    return {f"stored-{name}.csv": csv_bytes(rows) for name, rows in tables.items()}


def read_tables(folder: Path, names: Iterable[str]) -> dict[str, Rows]:
    """The tables of these names that a report in `folder` was made from."""
    tables: dict[str, Rows] = {}
    for name in names:
        with (folder / f"stored-{name}.csv").open(encoding="utf-8", newline="") as file:
            tables[name] = list(csv.reader(file))
    return tables
