"""What is said of a schedule beside its title."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as some

from reports.charts.panels import busy


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
