"""The report on modular filters as the code makes it of the results that are stored."""

from __future__ import annotations

import re
from functools import cache

from reports.modular.report import build
from reports.modular.results import Results, read
from tests.reports import published


@cache
def stored() -> Results:
    return read(published.FOLDER / "modular")


@cache
def rebuilt() -> dict[str, bytes]:
    return build(stored())


def text() -> str:
    return published.text(rebuilt())


def rows(name: str) -> list[dict[str, str]]:
    return published.rows(rebuilt(), name)


def number(cell: str) -> float:
    """Without its interval."""
    return float(re.split(r" \(| ± ", cell)[0].replace(",", ""))


def interval(cell: str) -> tuple[float, float]:
    """Of "3.2 (3.1 to 3.4)", or "none (≤ 0.4)"."""
    if none := re.fullmatch(r"none \(≤ (.*)\)", cell):
        return 0.0, float(none[1])
    low, high = re.fullmatch(r".* \((.*) to (.*)\)", cell).groups()  # type: ignore[union-attr]
    return float(low.replace(",", "")), float(high.replace(",", ""))
