"""A need never looks smaller than it is, wherever it is told."""

from __future__ import annotations

from fractions import Fraction

import pytest

from sched_sim.rounding import percent_up
from tests.command_line import Run


@pytest.mark.parametrize(
    ("share", "text"),
    [
        (Fraction(1), "100 %"),
        (Fraction("1.0001"), "101 %"),
        (Fraction("0.44801"), "44.9 %"),
        (Fraction("0.9100"), "91.0 %"),
        (Fraction("9.990001"), "1000 %"),
        (Fraction("0.0000003121"), "0.0000313 %"),
        (Fraction("158.6301"), "15,864 %"),
    ],
)
def test_a_share_is_rounded_up(share: Fraction, text: str) -> None:
    assert percent_up(share) == text


def test_design_needs_of_a_part_what_minimum_needs_of_it(sched_sim: Run) -> None:
    asked = "-N 80 -M 44 --hr-hz 400 --costs counted-9-3-3 --processor rp2040 --method delayed-horizon"
    assert " 78.5 % " in sched_sim(f"minimum {asked.replace('--costs counted-9-3-3 ', '')}").out
    assert " 78.5 % " in sched_sim(f"design --within 0.4 --model ins-gps --every 1 {asked}").out
