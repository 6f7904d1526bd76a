"""A sweep's results as CSV or Parquet."""

from __future__ import annotations

import csv
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import IO, Any

from sched_sim.errors import InputError
from sched_sim.files.writable import check_writable, writing
from sched_sim.text import csv_cell
from studies.sweep.rows import Row
from studies.sweep.store import Store

AT_A_TIME = 50_000
"""Rows in memory, and in one row group of Parquet."""


def check_export(path: Path) -> None:
    """Raises InputError if `path` has no known suffix or cannot be written; look before hours of work, not after."""
    if path.suffix not in WRITERS:
        raise InputError(f"--export {path}: the name must end in {' or '.join(WRITERS)}")
    check_writable(path, "--export")


def export(store: Store, path: Path) -> None:
    """All rows of the view `results` in order of their design index, by the suffix of `path`; memory stays flat."""
    with writing(path, "--export") as file:
        WRITERS[path.suffix](store, file)


def write_csv(store: Store, file: IO[bytes]) -> None:
    """A header and a line for each point; empty where there is no figure, booleans as true and false."""
    from io import TextIOWrapper

    flags = [number for number, column in enumerate(store.columns) if column.kind == "bool"]
    text = TextIOWrapper(file, encoding="utf-8", newline="", write_through=True)
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([column.name for column in store.columns])
    for rows in store.results(AT_A_TIME):
        writer.writerows(_spelled(row, flags) for row in rows)
    text.detach()


def _spelled(row: Row, flags: Sequence[int]) -> list[Any]:
    cells: list[Any] = [csv_cell(cell) for cell in row]
    for number in flags:
        cells[number] = SPELLED[row[number]]
    return cells


SPELLED: Mapping[Any, str] = {True: "true", False: "false", None: ""}


def write_parquet(store: Store, file: IO[bytes]) -> None:
    """A typed column for each figure, null where there is none."""
    from pyarrow import parquet

    from studies.sweep.arrow import schema, tables

    with parquet.ParquetWriter(file, schema(store.columns)) as writer:
        for table in tables(store, AT_A_TIME):
            writer.write_table(table)


WRITERS: dict[str, Callable[[Store, IO[bytes]], None]] = {".csv": write_csv, ".parquet": write_parquet}
