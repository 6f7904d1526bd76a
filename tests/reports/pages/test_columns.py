"""Columns of numbers are aligned right, however their numbers are written."""

from __future__ import annotations

import pytest

from reports.pages.markdown import markdown_table


@pytest.mark.parametrize(
    "cell",
    [
        "-12",
        "−12",
        "+304",
        "1,827",
        "2.09",
        "< 0.001",
        "> 50,000",
        "≥ 20",
        "<\N{NO-BREAK SPACE}0.001",
        "5 %",
        "-",
        "–",
        "9 × 10⁻⁵",
        "6.0 to 10.4",
    ],
)
def test_a_number_is_aligned_right(cell: str) -> None:
    assert markdown_table([["head"], [cell], ["3"]]).splitlines()[1] == "| ---: |"


@pytest.mark.parametrize("cell", ["n = 4", "no sqrt", "0.357 m", "exact", ""])
def test_words_are_not(cell: str) -> None:
    assert markdown_table([["head"], [cell], ["3"]]).splitlines()[1] == "| --- |"
