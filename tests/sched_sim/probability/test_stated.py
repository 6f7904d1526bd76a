"""What is said of a cost is a distribution, or refused with what is wrong and what to do."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.errors import InputError
from sched_sim.probability.stated import StatedCost, by_exceedance, probability, with_the_rest


def numbers(*values: object) -> list[Fraction]:
    return [Fraction(str(value)) for value in values]


@pytest.mark.parametrize(
    ("values", "probabilities", "worst", "said"),
    [
        (
            [56, 61],
            ["0.99", "1e-6"],
            None,
            "sum to 0.990001, 0.009999 too little: they must sum to 1",
        ),
        ([56, 61], [1, "1e-9"], None, "the probabilities sum to 1.000000001, 1e-09 too much"),
        ([56, 61], ["1.1", "-0.1"], None, "the probability -0.1 is negative: give numbers from 0 to 1"),
        ([56, 61], [1], None, "there are 2 values and 1 probabilities: give one for each"),
        ([0, 61], ["0.5", "0.5"], None, "the value 0 must be greater than 0"),
        ([5, 9, 7], None, 8, "the worst case 8 is below 9, which was measured: give more"),
        ([5, 9], ["0.5", "0.5"], 8, "the worst case 8 is below 9, which has a probability"),
        ([], None, None, "there is no value"),
    ],
)
def test_what_is_no_distribution_is_refused(values: list[int], probabilities: object, worst: object, said: str) -> None:
    shares = None if probabilities is None else numbers(*probabilities)  # type: ignore[misc]
    with pytest.raises(InputError, match=r"^mine: ") as error:
        StatedCost(numbers(*values), shares, None if worst is None else numbers(worst)[0], source="mine")
    assert said in str(error.value)


def test_a_value_without_a_probability_gets_the_rest() -> None:
    assert with_the_rest([None, Fraction(1, 10**9)], "x") == [1 - Fraction(1, 10**9), Fraction(1, 10**9)]
    assert with_the_rest([None], "x") == [1]
    with pytest.raises(InputError, match=r"2 of 2 values have no probability: leave it out for one at most"):
        with_the_rest([None, None], "x")
    with pytest.raises(InputError, match=r"sum to 1, which leaves nothing"):
        with_the_rest([Fraction(1), None], "x")


@given(
    st.lists(st.tuples(st.integers(1, 50), st.integers(0, 9)), min_size=1, max_size=8, unique_by=lambda each: each[0])
)
def test_a_curve_is_a_distribution_that_exceeds_each_value_as_often_as_it_says(points: list[tuple[int, int]]) -> None:
    values = [Fraction(value) for value, _ in sorted(points)]
    exceedance = sorted((Fraction(share, 10) for _, share in points), reverse=True)
    cost = by_exceedance(values, exceedance, Fraction(60), "curve")
    assert cost.probabilities is not None
    for value, more in zip(values, exceedance, strict=True):
        above = [share for at, share in zip(cost.values, cost.probabilities, strict=True) if at > value]
        assert sum(above) == more


@pytest.mark.parametrize(
    ("values", "exceedance", "worst", "said"),
    [
        ([10, 12], ["0.1", "1e-12"], None, "beyond 12 there is a probability of 1e-12: say with worst = ..."),
        ([10, 12], ["0.1", "1e-12"], 12, "the worst case 12 is not above 12"),
        ([10, 12], ["0.1", "0.2"], 20, "the exceedance probabilities must not rise"),
        ([12, 10], ["0.1", "0"], None, "the values must rise"),
        ([12], ["0.1", "0"], None, "there are 1 values and 2 exceedance probabilities"),
    ],
)
def test_a_curve_that_is_none_is_refused(values: list[int], exceedance: list[str], worst: object, said: str) -> None:
    with pytest.raises(InputError, match=r"^mine: ") as error:
        by_exceedance(numbers(*values), numbers(*exceedance), None if worst is None else numbers(worst)[0], "mine")
    assert said in str(error.value)


def test_a_probability_is_what_it_writes() -> None:
    assert probability("1e-30", "it") == Fraction(1, 10**30)
    assert probability("1/3", "it") == Fraction(1, 3)
    for wrong in ("often", "", "1e-999999999", "1/0"):
        with pytest.raises(InputError, match=r"^it is "):
            probability(wrong, "it")
