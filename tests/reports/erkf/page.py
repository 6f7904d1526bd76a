"""The report on the robust filter as the code makes it of the results that are stored."""

from __future__ import annotations

from functools import cache

from reports.erkf.report import build
from reports.erkf.results import Results, read
from tests.reports import published

PUBLISHED = published.FOLDER / "erkf"


@cache
def stored() -> Results:
    return read(PUBLISHED)


@cache
def rebuilt() -> dict[str, bytes]:
    return build(stored())


def text() -> str:
    return published.text(rebuilt())


def rows(name: str) -> list[dict[str, str]]:
    return published.rows(rebuilt(), name)


def costs_of(way: str, column: str) -> int:
    """A cell of the table of counts. column: the system, with a finite μ where nothing else is said."""
    (row,) = (row for row in rows("costs.csv") if row["Way"] == way)
    return int(row[column if "μ" in column else f"{column}, finite μ"])
