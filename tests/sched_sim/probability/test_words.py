"""Probabilities in words: never a bare 0, never more digits than are known, never less than an upper bound."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.costs.autocorrelation import by_chance
from sched_sim.probability.outcome import Bounds, Tail
from sched_sim.probability.responses import exceeded_at_most, period_in
from sched_sim.probability.samples import unseen_mass
from sched_sim.probability.words import at_most, chance, clause_of, dependence


@pytest.mark.parametrize(
    ("lower", "upper", "floor", "said"),
    [
        (1e-6, 1e-6, 0.0, "1e-6"),
        (1e-6, 1.0000000001e-6, 0.0, "1e-6"),
        (0.999999, 0.999999, 0.0, "0.999999"),
        (2.03e-9, 2.69e-9, 0.0, "2e-9 to 2.7e-9"),
        (0.0, 2e-9, 0.0, "at most 2e-9"),
        (1e-40, 1e-40, 0.0, "at most 1e-30"),
        (0.0, 0.0, 0.0, "impossible"),
        (1.0, 1.0, 0.0, "1"),
        (1 - 1e-16, 1.0, 0.0, "1"),
        (0.0, 0.0, 3e-3, "not resolved below 0.003"),
        (1e-3, 1e-3, 3e-3, "not resolved below 0.003"),
        (1e-3, 1e-2, 3e-3, "at most 0.014"),
        (0.2, 0.2, 3e-3, "0.2"),
        (1.0, 1.0, 3e-3, "at least 0.997"),
        (1.0, 1.0, 1.0, "not resolved below 1"),
        (0.9, 0.9, 0.95, "not resolved below 0.95"),
    ],
)
def test_by_hand(lower: float, upper: float, floor: float, said: str) -> None:
    assert chance(Bounds(lower, upper), floor) == said


@given(st.floats(1e-29, 1, exclude_max=True), st.floats(1, 10))
def test_bounds_are_rounded_outwards(lower: float, factor: float) -> None:
    upper = min(lower * factor, 1 - 1e-12)
    said = chance(Bounds(min(lower, upper), upper))
    if " to " in said:
        low, high = map(float, said.split(" to "))
        assert low <= lower
        assert upper <= high
    else:
        assert float(said) == pytest.approx(upper, rel=5e-3)
    assert float(at_most(upper)) >= upper


def test_what_a_sample_has_not_seen() -> None:
    for n in (100, 1000, 100_000):
        assert (1 - unseen_mass(n)) ** n == pytest.approx(0.05, rel=0.05)
        assert 2 * (1 - unseen_mass(n, 2)) ** n == pytest.approx(0.05, rel=0.08)
    assert unseen_mass(2) == 1


def test_dependence_is_said_with_what_chance_makes() -> None:
    assert dependence("x", 0.39, 1000) == "Rank autocorrelation 0.39 (x, n = 1,000): independence doubtful"
    assert dependence("x", -0.39, 1000).endswith("independence doubtful")
    assert dependence("x", 0.06, 100).endswith("independence doubtful; chance alone makes up to 0.20")
    assert dependence("x", 0.01, 100).endswith("too few to tell, chance alone makes up to 0.20")
    assert dependence("x", 0.01, 10_000).endswith("nothing against independence from one execution to the next")
    assert dependence("x", 0.0, 1) == "Rank autocorrelation of x: not known, n = 1"
    assert by_chance(4) < 1 <= by_chance(3)
    assert by_chance(10_000) == pytest.approx(0.0196)


@pytest.mark.parametrize(
    ("said", "clause"),
    [
        ("vanishes", "vanishes"),
        ("impossible", "is impossible"),
        ("not resolved below 0.003", "is not resolved below 0.003"),
        ("1e-6", "with 1e-6"),
        ("at most 1e-6", "with at most 1e-6"),
    ],
)
def test_what_a_table_says_fits_into_a_sentence(said: str, clause: str) -> None:
    assert clause_of(said) == clause


def test_response_times_are_by_the_upper_bound() -> None:
    import numpy as np

    tail = Tail(np.array([1.0, 1e-4, 0.0]), np.array([1.0, 1e-2, 1e-6]))
    assert exceeded_at_most(tail, 1e-3, 4) == Fraction(2, 4)
    assert exceeded_at_most(tail, 1e-2, 4) == Fraction(1, 4)
    assert exceeded_at_most(tail, 1e-9, 4) is None
    assert period_in(None) == (1.0, "HR periods")
    assert period_in(Fraction(400)) == (2.5, "ms")
    assert period_in(Fraction(200_000)) == (5.0, "us")
