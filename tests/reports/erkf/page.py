"""The report on the robust filter as the code makes it of the results that are stored."""

from __future__ import annotations

import csv
import io
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
    (cells,) = (line for line in csv.reader(io.StringIO(rebuilt()["costs.csv"].decode())) if line[0] == way)
    heading = ["", "attitude, μ = ∞", "attitude", "", "position, μ = ∞", "position", ""]
    return int(cells[heading.index(column)].replace(",", ""))
