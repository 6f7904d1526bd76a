"""Which designs no other one beats."""

from __future__ import annotations

from fractions import Fraction

from studies.selection.unbeaten import unbeaten


def test_a_design_that_needs_more_and_is_no_better_is_beaten() -> None:
    designs = [(Fraction(1), 3.0), (Fraction(2), 2.0), (Fraction(3), 2.0), (Fraction(3), 1.0), (Fraction(4), 2.5)]
    assert unbeaten(designs) == [True, True, False, True, False]


def test_equal_ones_do_not_beat_each_other() -> None:
    assert unbeaten([(1.0, 2.0), (1.0, 2.0)]) == [True, True]


def test_what_differs_by_rounding_is_equally_accurate() -> None:
    assert unbeaten([(1.0, 2.0), (1.5, 2.0 * (1 - 1e-12)), (1.5, 2.0 * (1 - 1e-6))]) == [True, False, True]
