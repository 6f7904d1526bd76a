"""The results file of a sweep: SQLite, written by one process, whole after any kill.

Tables: `sweep` (what the sweep is), `blocks` (cost table, method and options), `rows` (a row for each point that is
done, by design index); view `results`: rows with their block spelled out.
"""

from __future__ import annotations

import json
import os
import sqlite3
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from hashlib import sha256
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from sched_sim.errors import InputError
from studies.file_lock import FileLock
from studies.grid import Block
from studies.rows import Cell, Column, Row

APPLICATION_ID = 0x53575031

BLOCK_COLUMNS = (
    Column("costs", "text"),
    Column("method", "text"),
    Column("lr_propagate_by", "text"),
    Column("feedback", "text"),
    Column("gain", "text"),
    Column("low_rate_noise", "text"),
    Column("cpus", "int"),
    Column("context_switch", "float"),
)

SQL_TYPES = {"int": "INTEGER", "bool": "INTEGER", "float": "REAL", "text": "TEXT"}


def result_columns(columns: Sequence[Column]) -> tuple[Column, ...]:
    """Those of the view `results`, for rows with `columns`: block by block's columns instead of its number."""
    point, _block, *figures = columns
    return (point, *BLOCK_COLUMNS, *figures)


def digest(description: Mapping[str, Any]) -> str:
    """The same for two sweeps only if they have the same points and the same costs (SHA-256, hexadecimal)."""
    return sha256(_canonical(description).encode()).hexdigest()


class Store:
    """An open results file; a context manager. Raises InputError, naming the file, wherever it cannot be used."""

    def __init__(
        self, path: Path, description: Mapping[str, Any], blocks: Sequence[Block], columns: Sequence[Column]
    ) -> None:
        """Open the file of the sweep that `description` describes, or make it.

        A file that is no results file, or another sweep's, is refused and not touched.
        """
        self.path = path
        self.columns = result_columns(columns)
        if os.path.lexists(path):
            _check_identity(path, description)
        self._lock = FileLock(path)
        try:
            if os.path.lexists(path):
                _check_identity(path, description)
            else:
                with _explained(path):
                    _create(path, description, blocks, columns)
            self._connection = _connect(path)
        except BaseException:
            self._lock.release()
            raise
        self._insert = f"INSERT INTO rows VALUES ({', '.join('?' * len(columns))})"

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._connection.close()
        self._lock.release()

    def add(self, rows: Iterable[Row]) -> None:
        """Keep `rows`; when this returns they outlive any kill, and a loss of power."""
        with _explained(self.path), self._connection:
            self._connection.executemany(self._insert, rows)

    def count(self) -> int:
        """How many rows there are."""
        return int(self.query("SELECT COUNT(*) FROM rows")[0][0])

    def missing(self, size: int) -> list[range]:
        """The gaps in the design indexes 0 .. size-1: what is still to be done."""
        edges = self.query(
            "SELECT point, following FROM (SELECT point, LEAD(point) OVER (ORDER BY point) AS following FROM rows) "
            "WHERE following > point + 1 ORDER BY point"
        )
        first, last = self.query("SELECT MIN(point), MAX(point) FROM rows")[0]
        if first is None:
            return [range(size)]
        gaps = [range(first), *(range(point + 1, following) for point, following in edges), range(last + 1, size)]
        return [gap for gap in gaps if gap]

    def query(self, sql: str, parameters: Sequence[Cell] = ()) -> list[tuple[Any, ...]]:
        """All rows of a query."""
        with _explained(self.path):
            return self._connection.execute(sql, parameters).fetchall()

    def results(self, at_a_time: int) -> Iterator[list[Row]]:
        """The rows of the view `results` in order of their design index, in portions."""
        with _explained(self.path), closing(self._connection.cursor()) as cursor:
            cursor.execute("SELECT * FROM results ORDER BY point")
            while batch := cursor.fetchmany(at_a_time):
                yield batch


def _canonical(description: Mapping[str, Any]) -> str:
    return json.dumps(description, sort_keys=True, separators=(",", ":"))


def _check_identity(path: Path, description: Mapping[str, Any]) -> None:
    """Raises InputError unless `path` holds the results of this very sweep; reads without touching anything."""
    found = _description_in(path)
    if found is None:
        raise InputError(f"{path} is not a results file of a sweep: give another --results; it is left as it was")
    if found != description:
        raise InputError(
            f"results file {path} belongs to another sweep ({_difference(found, description)}): "
            f"give another --results, or the sweep it belongs to; it is left as it was"
        )


def _description_in(path: Path) -> Any:
    """The description that a results file carries; None for anything else.

    It is in the file itself, never in a write-ahead log beside it, so that `immutable` finds it.
    """
    if not path.is_file():
        return None
    uri = f"{path.resolve().as_uri()}?mode=ro&immutable=1"
    try:
        with closing(sqlite3.connect(uri, uri=True)) as connection:
            if connection.execute("PRAGMA application_id").fetchone() != (APPLICATION_ID,):
                return None
            (text,) = connection.execute("SELECT value FROM sweep WHERE key = 'description'").fetchone()
            return json.loads(text)
    except (sqlite3.Error, TypeError, ValueError):
        return None


def _difference(there: Any, here: Mapping[str, Any]) -> str:
    if not isinstance(there, dict):
        return "it describes none that this version knows"
    keys = [key for key in here if there.get(key) != here[key]]
    return "; ".join(f"{key} is {_short(there.get(key))} there and {_short(here[key])} here" for key in keys)


def _short(value: Any, limit: int = 60) -> str:
    text = json.dumps(value).replace('"', "")
    return text if len(text) <= limit else f"{text[: limit // 2]} ... {text[-limit // 3 :]}"


def _create(path: Path, description: Mapping[str, Any], blocks: Sequence[Block], columns: Sequence[Column]) -> None:
    """Make an empty results file under another name, then give it its own: it is there whole or not at all."""
    new = path.with_name(f"{path.name}-new")
    new.unlink(missing_ok=True)
    try:
        with closing(sqlite3.connect(new)) as connection, connection:
            connection.execute(f"PRAGMA application_id = {APPLICATION_ID}")
            connection.execute("CREATE TABLE sweep (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID")
            about = {"description": _canonical(description), "sha256": digest(description)}
            connection.executemany("INSERT INTO sweep VALUES (?, ?)", about.items())
            connection.execute(f"CREATE TABLE blocks (block INTEGER PRIMARY KEY, {_declared(BLOCK_COLUMNS)})")
            marks = ", ".join("?" * (len(BLOCK_COLUMNS) + 1))
            connection.executemany(f"INSERT INTO blocks VALUES ({marks})", map(_block_row, blocks))
            point, *others = columns
            connection.execute(f"CREATE TABLE rows ({point.name} INTEGER PRIMARY KEY, {_declared(others)})")
            names = ", ".join(column.name for column in result_columns(columns))
            connection.execute(f"CREATE VIEW results AS SELECT {names} FROM rows JOIN blocks USING (block)")
        new.replace(path)
    finally:
        new.unlink(missing_ok=True)


def _declared(columns: Iterable[Column]) -> str:
    return ", ".join(f"{column.name} {SQL_TYPES[column.kind]}" for column in columns)


def _block_row(block: Block) -> Row:
    options = block.options
    return (
        block.number,
        block.table,
        block.method,
        options.lr_propagate_by,
        options.feedback,
        options.gain,
        options.low_rate_noise,
        options.cpus,
        float(options.context_switch),
    )


def _connect(path: Path) -> sqlite3.Connection:
    with _explained(path):
        connection = sqlite3.connect(path)
        try:
            connection.execute("PRAGMA journal_mode = WAL")
            connection.execute("PRAGMA synchronous = FULL")
        except sqlite3.Error:
            connection.close()
            raise
        return connection


@contextmanager
def _explained(path: Path) -> Iterator[None]:
    """Turns the errors of SQLite and of the file system into one that names the file."""
    try:
        yield
    except (sqlite3.Error, OSError) as error:
        raise InputError(
            f"results file {path} cannot be read or written: {error}; give another --results or make room"
        ) from error
