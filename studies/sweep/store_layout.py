"""What a results file of a sweep holds beside its rows, and whose file it is."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, fields
from fractions import Fraction
from functools import cached_property
from hashlib import sha256
from pathlib import Path
from typing import Any, Literal
from zlib import crc32

from sched_sim.design.options import Options
from sched_sim.errors import InputError, option
from studies.sweep.grid import Block
from studies.sweep.rows import Column, Row

APPLICATION_ID = 0x53575031

KINDS: Mapping[type, Literal["text", "int", "float"]] = {str: "text", int: "int", Fraction: "float"}
"""Kinds of the columns for choices of `Options`."""

BLOCK_COLUMNS = (
    Column("costs", "text"),
    Column("processor", "text"),
    Column("method", "text"),
    *(Column(choice.name, KINDS[type(choice.default)]) for choice in fields(Options)),
)

MEASURED = Column("measured_on_busy_machine", "bool")
"""Of the costs of a row; no figure depends on it, so that it is not in the file."""

SQL_TYPES = {"int": "INTEGER", "bool": "INTEGER", "float": "REAL", "text": "TEXT"}

CHECKSUM = Column("checksum", "int")


def digest(description: Mapping[str, Any]) -> str:
    """The same for two sweeps only if they have the same points and the same costs (SHA-256, hexadecimal)."""
    return sha256(_canonical(description).encode()).hexdigest()


@dataclass(frozen=True)
class Layout:
    """The file of the sweep that `description` describes; columns: of its rows, the point and its block first."""

    description: Mapping[str, Any]
    blocks: Sequence[Block]
    columns: Sequence[Column]

    @property
    def given_columns(self) -> tuple[Column, ...]:
        """Those of a row as it is given out: of the view, and what the file does not hold."""
        return (*self.result_columns, MEASURED)

    @property
    def result_columns(self) -> tuple[Column, ...]:
        """Columns of the view `results`: the block's instead of its number."""
        point, _block, *figures = self.columns
        return (point, *BLOCK_COLUMNS, *figures)

    @cached_property
    def mark(self) -> int:
        """SQLite's `user_version`: stands in the header of the file, the same whatever happens to the rest of it."""
        return int(digest(self.description)[:8], 16) >> 1 | 1

    def checksum(self, row: Row) -> int:
        """The checksum of a row as SQLite gives it back: another for another sweep."""
        return crc32(repr(row).encode(), self.mark)

    @cached_property
    def block_rows(self) -> list[Row]:
        """Rows of the table `blocks`."""
        return [_block_row(block) for block in self.blocks]

    def new_file(self) -> bytes:
        """A file without rows."""
        with closing(self._new_database()) as connection:
            return connection.serialize()

    def is_whole(self, connection: sqlite3.Connection) -> bool:
        """Whether all that is not rows is as it was when the file was new, whatever else a user may have added."""
        with closing(self._new_database()) as new:
            return all(set(new.execute(sql)) <= set(connection.execute(sql)) for sql in _FIXED)

    def _new_database(self) -> sqlite3.Connection:
        """In memory."""
        connection = sqlite3.connect(":memory:")
        with connection:
            connection.execute(f"PRAGMA application_id = {APPLICATION_ID}")
            connection.execute(f"PRAGMA user_version = {self.mark}")
            connection.execute("CREATE TABLE sweep (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID")
            about = {"description": _canonical(self.description), "sha256": digest(self.description)}
            connection.executemany("INSERT INTO sweep VALUES (?, ?)", about.items())
            connection.execute(f"CREATE TABLE blocks (block INTEGER PRIMARY KEY, {_declared(BLOCK_COLUMNS)})")
            marks = ", ".join("?" * (len(BLOCK_COLUMNS) + 1))
            connection.executemany(f"INSERT INTO blocks VALUES ({marks})", self.block_rows)
            point, *others = self.columns
            connection.execute(
                f"CREATE TABLE rows ({point.name} INTEGER PRIMARY KEY, {_declared([*others, CHECKSUM])})"
            )
            names = ", ".join(column.name for column in self.result_columns)
            connection.execute(f"CREATE VIEW results AS SELECT {names} FROM rows JOIN blocks USING (block)")
        return connection


_FIXED = ("SELECT type, name, sql FROM sqlite_schema", "SELECT * FROM sweep", "SELECT * FROM blocks")


def check_owner(path: Path, layout: Layout) -> None:
    """Raises InputError unless the header of the file in `path` is that of this very sweep's; only reads.

    The header says it in every state of the file: half written back from its log, or not at all.
    """
    header = _header(path)
    application, mark = (int.from_bytes(header[at : at + 4], "big") for at in (68, 60))
    if not header.startswith(b"SQLite format 3\0") or application != APPLICATION_ID:
        raise InputError(
            f"{path} is not a results file of a sweep: give another {option('results')}; it is left as it was"
        )
    if mark == layout.mark:
        return
    if mark == 0:
        raise InputError(
            f"results file {path} is of an earlier version, which kept no checksums of its rows: give another "
            f"{option('results')}, and all points are computed anew; it is left as it was, for any SQLite program to "
            f"read"
        )
    description = _description_in(path)
    if description is None or description == layout.description:
        raise InputError(
            f"{path} is not a results file of this sweep, but another's or damaged: give another {option('results')}; "
            f"it is left as it was"
        )
    raise InputError(
        f"results file {path} belongs to another sweep ({_difference(description, layout.description)}): "
        f"give another {option('results')}, or the sweep it belongs to; it is left as it was"
    )


def _header(path: Path) -> bytes:
    """Nothing of what is no file."""
    try:
        if not path.is_file():
            return b""
        with path.open("rb") as file:
            return file.read(100)
    except OSError as error:
        raise InputError(
            f"results file {path} cannot be read: {error.strerror}; give another {option('results')}"
        ) from None


def _description_in(path: Path) -> Any:
    """The description that a results file carries, without what is in the log beside it; None if it cannot be read."""
    uri = f"{path.resolve().as_uri()}?mode=ro&immutable=1"
    try:
        with closing(sqlite3.connect(uri, uri=True)) as connection:
            (text,) = connection.execute("SELECT value FROM sweep WHERE key = 'description'").fetchone()
            return json.loads(text)
    except (sqlite3.Error, TypeError, ValueError):
        return None


def _canonical(description: Mapping[str, Any]) -> str:
    return json.dumps(description, sort_keys=True, separators=(",", ":"))


def _difference(there: Any, here: Mapping[str, Any]) -> str:
    if not isinstance(there, dict):
        return "it describes none that this version knows"
    keys = [key for key in here if there.get(key) != here[key]]
    return "; ".join(f"{key} is {_short(there.get(key))} there and {_short(here[key])} here" for key in keys)


def _short(value: Any, limit: int = 60) -> str:
    text = json.dumps(value).replace('"', "")
    return text if len(text) <= limit else f"{text[: limit // 2]} ... {text[-limit // 3 :]}"


def _declared(columns: Iterable[Column]) -> str:
    return ", ".join(f"{column.name} {SQL_TYPES[column.kind]}" for column in columns)


def _block_row(block: Block) -> Row:
    choices = (getattr(block.options, choice.name) for choice in fields(Options))
    shown = (float(value) if isinstance(value, Fraction) else value for value in choices)
    return (block.number, block.table, block.processor, block.method, *shown)
