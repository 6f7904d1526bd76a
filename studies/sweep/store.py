"""The results file of a sweep: SQLite, written by one process, whole after any kill, and checked when it is read.

Tables: `sweep` (what the sweep is), `blocks` (cost table, method and options), `rows` (a row for each point that is
done, by design index, with its checksum); view `results`: rows with their block spelled out.
"""

from __future__ import annotations

import os
import sqlite3
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import closing, contextmanager
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from sched_sim.errors import InputError, option
from sched_sim.files.writable import write
from studies.sweep.file_lock import FileLock
from studies.sweep.rows import Cell, Row
from studies.sweep.store_layout import Layout, check_owner

AT_A_TIME = 50_000
"""Rows in memory."""

REMEDIES = {
    "SQLITE_FULL": "make room there, and the same command goes on",
    "SQLITE_BUSY": "close the program that holds it, and the same command goes on",
    "SQLITE_IOERR": "make room there, and the same command goes on, or give another {results}",
    "SQLITE_CANTOPEN": "give another {results}",
    "SQLITE_READONLY": "give another {results}",
}
"""By the errors of SQLite that are not of a damaged file."""

MOST_NAMED = 20
"""Points in a message."""


class Store:
    """An open results file; a context manager. Raises InputError, naming the file, wherever it cannot be used."""

    def __init__(self, path: Path, layout: Layout) -> None:
        """Open the file of a sweep, or make it. A file that is no results file, or another sweep's, is not touched."""
        self.path = path
        self.layout = layout
        self.columns = layout.given_columns
        where = _file_meant(path)
        if os.path.exists(where):
            check_owner(path, layout)
        self._lock = FileLock(where)
        try:
            if os.path.exists(where):
                check_owner(path, layout)
            else:
                _refuse_remains(where)
                write(where, layout.new_file(), "results file")
            self._connection = self._connect(where)
        except BaseException:
            self._lock.release()
            raise
        self._insert = f"INSERT INTO rows VALUES ({', '.join('?' * (len(layout.columns) + 1))})"

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._connection.close()
        self._lock.release()

    def add(self, rows: Iterable[Row]) -> None:
        """Keep `rows`; when this returns they outlive any kill, and a loss of power."""
        checksum = self.layout.checksum
        with self._explained(), self._connection:
            self._connection.executemany(self._insert, ((*row, checksum(row)) for row in rows))

    def count(self) -> int:
        """How many rows there are."""
        return int(self.query("SELECT COUNT(*) FROM rows")[0][0])

    def missing(self, size: int) -> list[range]:
        """The gaps in the design indexes 0 .. size-1: what is still to be done. Raises InputError for damaged rows."""
        gaps, done = [], 0
        for rows in self._checked(AT_A_TIME):
            for point, *_ in rows:
                if point > done:
                    gaps.append(range(done, point))
                done = point + 1
        return gaps if done == size else [*gaps, range(done, size)]

    def query(self, sql: str, parameters: Sequence[Cell] = ()) -> list[tuple[Any, ...]]:
        """All rows of a query."""
        with self._explained():
            return self._connection.execute(sql, parameters).fetchall()

    def results(self, at_a_time: int) -> Iterator[list[Row]]:
        """The rows of the view `results` in order of their design index, in portions; with whether their costs were
        measured on a busy machine.

        Raises InputError, at the end, for rows that are damaged: what has been given out is not.
        """
        spelled = {block[0]: block[1:] for block in self.layout.block_rows}
        busy = {block.number: block.busy for block in self.layout.blocks}
        for rows in self._checked(at_a_time):
            yield [(row[0], *spelled[row[1]], *row[2:], busy[row[1]]) for row in rows]

    def _checked(self, at_a_time: int) -> Iterator[list[tuple[Any, ...]]]:
        """Rows in the order of their points, those left out that are not what was written: they are in the error."""
        checksum = self.layout.checksum
        rows, damaged, last = [], [], -1
        with (
            self._explained(lambda: "no row can be read" if last < 0 else f"rows after point {last} cannot be read"),
            closing(self._connection.cursor()) as cursor,
        ):
            for *cells, written in cursor.execute("SELECT * FROM rows ORDER BY point"):
                row = tuple(cells)
                if row[0] <= last:
                    raise self._damaged(f"its rows are out of order after point {last}")
                last = row[0]
                if checksum(row) == written:
                    rows.append(row)
                else:
                    damaged.append(last)
                if len(rows) == at_a_time:
                    yield rows
                    rows = []
        yield rows
        if damaged:
            raise self._damaged(*_which(self.path, damaged))

    def _connect(self, where: Path) -> sqlite3.Connection:
        with self._explained():
            connection = sqlite3.connect(where)
            try:
                connection.execute("PRAGMA journal_mode = WAL")
                connection.execute("PRAGMA synchronous = FULL")
                if not self.layout.is_whole(connection):
                    raise self._damaged("what it says of its sweep has changed")
            except BaseException:
                connection.close()
                raise
            return connection

    def _damaged(self, how: str, remedy: str = "") -> InputError:
        return InputError(
            f"results file {self.path} is damaged: {how}; {remedy}give another {option('results')}, and all is "
            f"computed anew"
        )

    @contextmanager
    def _explained(self, damage: Callable[[], str] = lambda: "SQLite cannot read it") -> Iterator[None]:
        """Turns the errors of SQLite into one that names the file. damage: what to say where the file is damaged, where
        texts from it are too."""
        try:
            yield
        except (sqlite3.Error, UnicodeDecodeError) as error:
            name = getattr(error, "sqlite_errorname", "")
            remedy = next((REMEDIES[kind] for kind in REMEDIES if name.startswith(kind)), None)
            if remedy is None:
                raise self._damaged(damage()) from error
            remedy = remedy.format(results=option("results"))
            raise InputError(f"results file {self.path} cannot be read or written: {error}; {remedy}") from error


def _which(path: Path, points: Sequence[int]) -> tuple[str, str]:
    """Which rows are damaged, and what can be done if they are few."""
    named = ", ".join(map(str, points[:MOST_NAMED]))
    if len(points) > MOST_NAMED:
        return f"{len(points)} rows are not what was written, those of points {named}, ...", ""
    plural = (
        "rows are not what was written, those of points" if len(points) > 1 else "row is not what was written, of point"
    )
    sql = f"DELETE FROM rows WHERE point IN ({named})"
    remedy = f'delete them, sqlite3 "{path}" "{sql}", and the same command computes them anew, or '
    return f"{len(points)} {plural} {named}", remedy


def _file_meant(path: Path) -> Path:
    """Links followed. Raises InputError for a file of several names: its log stands by one of them only."""
    try:
        where = Path(os.path.realpath(path))
        names = where.stat().st_nlink if os.path.lexists(where) and not where.is_dir() else 1
    except OSError as error:
        raise InputError(
            f"results file {path} cannot be read: {error.strerror}; give another {option('results')}"
        ) from None
    if names > 1:
        raise InputError(
            f"results file {path} has {names} names (hard links), and its write-ahead log would stand by one of them "
            f"only: give a copy of it as {option('results')}, or another; it is left as it was"
        )
    return where


def _refuse_remains(path: Path) -> None:
    """Raises InputError if the log of another file of this name is there: SQLite would take it for the new one's."""
    for kind in ("-wal", "-shm", "-journal"):
        if os.path.lexists(remains := f"{path}{kind}"):
            raise InputError(
                f"results file {path} is not there, but {remains} is, which may hold rows of one that was: move that "
                f"file back, or this one away, or give another {option('results')}"
            )
