"""Negative numbers have a true minus sign on the page; what is no number keeps its hyphen."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from reports.pages.markdown import markdown_table
from reports.pages.minus import true_minus

MINUS = "\N{MINUS SIGN}"


@given(st.floats(min_value=-1e30, max_value=-1e-30))
def test_every_negative_number_of_a_table_has_it(value: float) -> None:
    for cell in (f"{value:g}", f"{value:.3f}", f"{value:.1e}", f"{value:.2f} to 3", f"0.1 ({value:.2f})"):
        page = true_minus(markdown_table([["error"], [cell]]))
        assert "-" not in page.splitlines()[-1]
        assert page.splitlines()[-1].replace("\N{NO-BREAK SPACE}", " ") == f"| {cell.replace('-', MINUS)} |"


@given(st.text(alphabet="-−1a .,(|\n`"))
def test_nothing_is_left_to_do_a_second_time_and_nothing_but_hyphens_changes(text: str) -> None:
    once = true_minus(text)
    assert true_minus(once) == once
    assert once.replace(MINUS, "-") == text.replace(MINUS, "-")


@pytest.mark.parametrize(
    "text",
    [
        "2026-11-29", "Tables 1-3", "`-L 8 --speed -1`", "[a](late-3.csv)", "cortex-m4f", "| --- | ---: |", "- 3 of 4",
        "k-1", "U-D", '<td class="a -3">',
    ],
)  # fmt: skip
def test_what_is_no_negative_number_stays(text: str) -> None:
    assert true_minus(text) == text


def test_columns_of_negative_numbers_are_aligned_right_with_either_sign() -> None:
    for sign in ("-", MINUS):
        assert markdown_table([["change"], [f"{sign}1.5"], ["+2"]]).splitlines()[1] == "| ---: |"
