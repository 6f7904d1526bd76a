"""Figures of a processor in words: a need never looks smaller than it is, nor a limit larger, nor either otherwise than
rounding asks."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.cli.parts import HIGHEST_HR_HZ, WORDS
from tests.command_line import Run

SHARE, SLACK = WORDS["of its speed"][1], WORDS["slack"][1]


@pytest.mark.parametrize(
    ("share", "needed", "left"),
    [
        (Fraction(41, 1000), "4.10 %", "95.9 %"),
        (Fraction(29, 100), "29.0 %", "71.0 %"),
        (Fraction(7, 1000), "0.700 %", "99.3 %"),
        (Fraction(1, 3), "33.4 %", "66.6 %"),
        (Fraction(9999, 100_000), "10.0 %", "90.0 %"),
        (Fraction(410_000_001, 10**10), "4.11 %", "95.8 %"),
        (Fraction(0), "0.00 %", "100 %"),
        (Fraction(123_456_789), "12,345,678,900 %", "-12345678800 %"),
    ],
)
def test_by_hand(share: Fraction, needed: str, left: str) -> None:
    assert (SHARE(share), SLACK(1 - share)) == (needed, left)


@given(st.fractions(min_value=Fraction(1, 10**6), max_value=10**6, max_denominator=10**9))
def test_rounding_goes_its_way_and_by_less_than_one_digit(share: Fraction) -> None:
    shown = Fraction(SHARE(share).removesuffix(" %").replace(",", ""))
    assert 100 * share <= shown < 100 * share * Fraction(101, 100)
    limit = Fraction(WORDS[HIGHEST_HR_HZ][1](share))
    assert share * Fraction(999, 1000) < limit <= share


@given(st.integers(1, 999))
def test_what_three_digits_say_exactly_is_not_rounded(tenths: int) -> None:
    assert Fraction(SHARE(Fraction(tenths, 1000)).removesuffix(" %")) == Fraction(tenths, 10)


@given(st.integers(1000, 9999))
def test_a_float_stands_for_its_decimal(tenths: int) -> None:
    assert WORDS[HIGHEST_HR_HZ][1](tenths / 10) == f"{tenths / 10:g}"


@pytest.mark.parametrize(
    ("rate", "shown"),
    [
        (Fraction(892), "892"),
        (Fraction(27_860), "27860"),
        (Fraction("892.5"), "892.5"),
        (Fraction("12.14956"), "12.14956"),
        (Fraction(400, 7), "400/7"),
        (Fraction(10**9, 1_234_567), "810.0"),
    ],
)
def test_the_highest_rate_is_shown_as_it_fits(rate: Fraction, shown: str) -> None:
    assert WORDS[HIGHEST_HR_HZ][1](rate) == shown


def test_the_patents_load_is_shown_as_it_is(sched_sim: Run) -> None:
    shown = sched_sim("minimum -N 5 --method multirate --costs patent-multirate --processor patent --hr-hz 1").out
    assert shown.count("4.10 %") == 2
    assert "95.9 %" in shown
