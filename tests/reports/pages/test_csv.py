"""A table as CSV is for programs: each number in it is read as one."""

from __future__ import annotations

import csv
import io

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reports.pages.minus import true_minus
from reports.pages.render import csv_bytes


def read(*cells: object) -> list[str]:
    return next(csv.reader(io.StringIO(csv_bytes([cells]).decode())))


@given(st.integers(-(10**12), 10**12), st.floats(-1e9, 1e9).map(lambda value: round(value, 3)))
def test_a_number_for_people_is_one_for_programs(whole: int, real: float) -> None:
    cells = read(true_minus(f"{whole:,}"), true_minus(f"{real:+,.3f}"))
    assert [float(cell) for cell in cells] == [whole, real]


@pytest.mark.parametrize(
    "cell", ["10, 4, 8", "l \N{MINUS SIGN} k", "-", "2.5 to 1,200", "1,23", "", "LR update, m to l"]
)
def test_what_is_no_number_stays(cell: str) -> None:
    assert read(cell) == [cell]
