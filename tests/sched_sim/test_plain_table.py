"""A table of plain text: aligned, and of one line a row whatever is in it."""

from __future__ import annotations

from fractions import Fraction

from sched_sim.plain_table import plain_table


def test_numbers_are_aligned_right_and_nothing_is_a_dash() -> None:
    shown = plain_table("title", ("name", "value"), [("a\nb", 12345), ("c", None), ("", Fraction(1, 3))], ["note"])
    assert shown.splitlines() == [
        "title",
        "name     value",
        "a\\nb    12,345",
        "c            -",
        "-     0.333333",
        "note",
    ]


def test_no_rows_are_no_table() -> None:
    assert plain_table("title", ("name",), []) == "title"
