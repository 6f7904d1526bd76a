"""What is said of a schedule beside its title."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as some

from reports.charts.panels import busy, method_panel
from sched_sim.costs.table_file import load_costs
from sched_sim.design.least_speed import least_speed
from sched_sim.design.methods import select
from sched_sim.design.timing import Timing


@pytest.mark.parametrize(
    ("share", "said"),
    [
        ("1", "100 % busy"),
        ("0.873", "87 % busy"),
        ("0.0996", "10 % busy"),
        ("0.0412", "4.1 % busy"),
        ("0.000412", "0.041 % busy"),
        ("0.0000012", "under 0.001 % busy"),
        ("0", "0 % busy"),
    ],
)
def test_a_processor_that_does_little_is_not_said_to_do_nothing(share: str, said: str) -> None:
    assert busy(Fraction(share)) == said


@given(some.fractions(Fraction(1, 100_000), 1))
def test_what_is_said_is_right_to_two_digits(share: Fraction) -> None:
    assert float(busy(share).partition(" ")[0]) == pytest.approx(100 * float(share), rel=0.0501)


@pytest.mark.parametrize(
    ("method", "costs", "timing", "said"),
    [
        ("multirate", "patent-multirate", Timing(5, 0, 5), "gain 1 is in use"),
        ("dual-rate", "steffes2014", Timing(10, 4, 8), "correction 1 lands"),
    ],
)
def test_what_lands_is_a_gain_or_a_correction(method: str, costs: str, timing: Timing, said: str) -> None:
    table = load_costs(costs)
    speed = least_speed(select(table, method), timing).speed
    marks = method_panel(table, method, timing, speed).marks
    assert any(mark.meaning.startswith(said) for mark in marks)
