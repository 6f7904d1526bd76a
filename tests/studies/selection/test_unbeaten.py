"""Which designs no other one beats."""

from __future__ import annotations

from fractions import Fraction

from hypothesis import given
from hypothesis import strategies as st

from studies.selection.unbeaten import ROUNDING, unbeaten


def test_a_design_that_needs_more_and_is_no_better_is_beaten() -> None:
    designs = [(Fraction(1), 3.0), (Fraction(2), 2.0), (Fraction(3), 2.0), (Fraction(3), 1.0), (Fraction(4), 2.5)]
    assert unbeaten(designs) == [True, True, False, True, False]


def test_equal_ones_do_not_beat_each_other() -> None:
    assert unbeaten([(1.0, 2.0), (1.0, 2.0)]) == [True, True]


def test_what_differs_by_rounding_is_equally_accurate() -> None:
    assert unbeaten([(1.0, 2.0), (1.5, 2.0 * (1 - 1e-12)), (1.5, 2.0 * (1 - 1e-6))]) == [True, False, True]


few = st.sampled_from([1.0, 1.0 + ROUNDING / 2, 1.0 + 2 * ROUNDING, 2.0, 3.0])


@given(st.lists(st.tuples(few, few)))
def test_it_is_what_comparing_each_with_each_finds(designs: list[tuple[float, float]]) -> None:
    def beats(other: tuple[float, float], design: tuple[float, float]) -> bool:
        (others_speed, others_std), (speed, std) = other, design
        as_good = others_speed <= speed and others_std <= std * (1 + ROUNDING)
        return as_good and (others_speed < speed or others_std < std * (1 - ROUNDING))

    assert unbeaten(designs) == [not any(beats(other, design) for other in designs) for design in designs]
