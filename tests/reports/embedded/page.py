"""The published report on boards, made anew from what is stored in it."""

from __future__ import annotations

from functools import cache

from reports.embedded.report import build
from reports.embedded.results import Results, read
from tests.reports import published

PUBLISHED = published.FOLDER / "embedded"


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


def number(cell: str) -> float:
    return float(cell.replace(",", "").replace("−", "-"))
