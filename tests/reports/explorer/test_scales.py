"""Scales of the plots in the browser, beside what exact numbers say."""

from __future__ import annotations

import json
from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise
from math import isclose, log10
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from playwright.sync_api import Browser

from tests.reports.explorer.scripts import Ask, asking

number = st.floats(-1e9, 1e9, allow_nan=False, width=32)
positive = st.floats(1e-9, 1e9, allow_nan=False)
in_browser = settings(deadline=None, max_examples=40)


@pytest.fixture(scope="module")
def ask(browser: Browser) -> Iterator[Ask]:
    with asking(browser, "scales") as ask:
        yield ask


def lead_and_power(value: Fraction) -> tuple[int, int]:
    power = 0
    while value >= 10:
        value, power = value / 10, power + 1
    while value < 1:
        value, power = value * 10, power - 1
    return int(value), power


@in_browser
@given(low=number, width=positive, count=st.integers(1, 12))
def test_ticks_are_all_multiples_of_1_2_or_5_times_a_power_of_ten(
    ask: Ask, low: float, width: float, count: int
) -> None:
    high = low + width
    if width < 1e-6 * abs(low):
        return
    found = ask("return of.ticks(a, b, c)", low, high, count)
    assert len(found) <= count + 1
    exact = [Fraction(repr(tick)) for tick in found]
    if len(exact) > 1:
        (step,) = {after - before for before, after in pairwise(exact)}
        lead, power = lead_and_power(step)
        assert step == lead * Fraction(10) ** power
        assert lead in (1, 2, 5)
        assert all((tick / step).denominator == 1 for tick in exact)
        assert exact[0] - step < low
        assert exact[-1] + step > high
    assert all(low - 1e-6 * width <= tick <= high + 1e-6 * width for tick in found)


@pytest.mark.parametrize(
    ("low", "high", "count", "expected"),
    [
        (0, 1, 5, [0, 0.2, 0.4, 0.6, 0.8, 1]),
        (0.1, 0.3, 2, [0.1, 0.2, 0.3]),
        (-1, 1, 4, [-1, -0.5, 0, 0.5, 1]),
        (45, 80, 7, [45, 50, 55, 60, 65, 70, 75, 80]),
        (3, 3, 5, []),
        (0, float("inf"), 5, []),
    ],
)
def test_ticks_of_some_axes(ask: Ask, low: float, high: float, count: int, expected: list[float]) -> None:
    assert ask("return of.ticks(a, b, c)", low, high, count) == expected


@pytest.mark.parametrize(
    ("low", "high", "count", "expected"),
    [
        (1, 1000, 5, [1, 10, 100, 1000]),
        (0.5, 20, 6, [0.5, 1, 2, 5, 10, 20]),
        (0.6, 0.8, 5, [0.6, 0.7, 0.8]),
        (0.62, 0.68, 4, [0.62, 0.64, 0.66, 0.68]),
        (1e-18, 1, 5, [1e-16, 1e-12, 1e-8, 1e-4, 1]),
        (1000, 200000, 5, [1000, 3000, 10000, 30000, 100000]),
    ],
)
def test_logarithmic_ticks_of_some_axes(ask: Ask, low: float, high: float, count: int, expected: list[float]) -> None:
    assert ask("return of.logarithmic([a, b], [0, 100]).ticks(c)", low, high, count) == expected


@in_browser
@given(low=positive, ratio=st.floats(1.001, 1e9), count=st.integers(2, 10))
def test_a_logarithmic_axis_has_ticks_within_it_and_minor_ones_between_them(
    ask: Ask, low: float, ratio: float, count: int
) -> None:
    high = low * ratio
    asked = "const scale = of.logarithmic([a, b], [0, 1]); return [scale.ticks(c), scale.minor(c)]"
    major, minor = ask(asked, low, high, count)
    assert len(major) <= count + 1
    assert major
    assert not set(major) & set(minor)
    for tick in [*major, *minor]:
        assert low * (1 - 1e-8) <= tick <= high * (1 + 1e-8)


@pytest.mark.parametrize("kind", ["linear", "logarithmic"])
@in_browser
@given(low=positive, ratio=st.floats(1.01, 1e6), share=st.floats(0, 1))
def test_what_a_scale_says_it_takes_back(ask: Ask, kind: str, low: float, ratio: float, share: float) -> None:
    high = low * ratio
    value = low + share * (high - low)
    asked = f"const scale = of.{kind}([a, b], [40, 640]); return [scale(c), scale.invert(scale(c))]"
    pixel, back = ask(asked, low, high, value)
    expected = share if kind == "linear" else log10(value / low) / log10(ratio)
    assert isclose(pixel, 40 + 600 * expected, abs_tol=1e-6)
    assert isclose(back, value, rel_tol=1e-9)


DEGENERATE = [None, [], [5, 5], [0, 0], [-3, -3], [None, None], [None, 4], [0, 7], [-1, 1], [7, 2], ["Infinity", 1]]


@pytest.mark.parametrize("kind", ["linear", "logarithmic"])
@pytest.mark.parametrize("domain", DEGENERATE, ids=str)
def test_no_domain_makes_a_scale_that_says_what_is_no_number(ask: Ask, kind: str, domain: list[Any] | None) -> None:
    ends = "a && a.map((end) => (end === 'Infinity' ? Infinity : end))"
    made = f"const scale = of.{kind}({ends}, [0, 100]);"
    every = "[scale.domain, scale(2), scale.invert(50), scale.ticks(5), scale.minor(5)]"
    said = ask(f"{made} return JSON.stringify({every})", domain)
    (low, high), pixel, middle, major, _ = json.loads(said)
    assert low < high
    assert pixel is not None
    assert low < middle < high
    assert major
    nothing = made + "return [scale(null), scale(undefined), scale(NaN), scale(Infinity)]"
    assert ask(nothing, domain) == [None] * 4


def test_a_logarithmic_scale_has_no_place_for_zero_and_less(ask: Ask) -> None:
    assert ask("const scale = of.logarithmic([1, 10], [0, 1]); return [scale(0), scale(-1), scale(1)]") == [
        None,
        None,
        0,
    ]


def test_an_extent_passes_over_what_is_no_number(ask: Ask) -> None:
    assert ask("return of.extent([3, null, -2, NaN, Infinity], [7])") == [-2, 7]
    assert ask("return of.extent([null, NaN])") is None


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0, "0"),
        (-0.5, "−0.5"),
        (0.3, "0.3"),
        (12345, "12,345"),
        (1e6, "10⁶"),
        (2.5e7, "2.5·10⁷"),
        (-2e-4, "−2·10⁻⁴"),
        (1e-12, "10⁻¹²"),
    ],
)
def test_a_tick_reads_as_in_print(ask: Ask, value: float, text: str) -> None:
    assert ask("return of.tickText(a)", value) == text
