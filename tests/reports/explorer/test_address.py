"""A design in a link, and the same in steps or in hertz and milliseconds."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from math import ceil, floor

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from playwright.sync_api import Browser

from tests.reports.explorer.scripts import Ask, asking

MANY = 40


@pytest.fixture(scope="module")
def ask(browser: Browser) -> Iterator[Ask]:
    with asking(browser, "address") as ask:
        yield ask


@settings(max_examples=3, deadline=None)
@given(
    texts=st.lists(st.dictionaries(st.text(max_size=6), st.text(max_size=6), max_size=4), min_size=MANY, max_size=MANY)
)
def test_a_query_is_read_as_it_was_written(ask: Ask, texts: list[dict[str, str]]) -> None:
    read = "return a.map((one) => Object.fromEntries(of.queryOf(of.textOf(new Map(Object.entries(one))))));"
    assert ask(read, texts) == texts


def test_what_is_nothing_is_left_out(ask: Ask) -> None:
    changed = 'return of.textOf(of.changedQuery(of.queryOf("N=10&M=4&L=8"), {L: "", M: null, method: "clone"}));'
    assert ask(changed) == "N=10&method=clone"


@settings(max_examples=3, deadline=None)
@given(
    designs=st.lists(
        st.tuples(st.fractions(1, 5000, max_denominator=1000), st.integers(1, 5000), st.integers(0, 5000)),
        min_size=MANY,
        max_size=MANY,
    )
)
def test_steps_become_exactly_these_steps_again(ask: Ask, designs: list[tuple[Fraction, int, int]]) -> None:
    """By the rule of `Times`: N rounded down, M up."""
    turn = """return a.map(([hr, N, M]) => {
      const design = {hr_hz: hr, N, M, measurement_hz: null, delay_ms: null};
      return Object.fromEntries(of.asTimes(new Map([["N", N]]), design));
    });"""
    for (hr, N, M), times in zip(designs, ask(turn, [(str(hr), N, M) for hr, N, M in designs]), strict=True):
        assert "N" not in times
        assert floor(hr / Fraction(times["measurement_hz"])) == N
        assert ceil(Fraction(times["delay_ms"]) * hr / 1000) == M


@pytest.mark.parametrize(
    ("hr", "steps", "rate", "time"), [("400", 80, "5", "200"), ("1e3", 3, "1000/3", "3"), ("0.5", 4, "0.125", "8000")]
)
def test_numbers_are_as_people_write_them(ask: Ask, hr: str, steps: int, rate: str, time: str) -> None:
    assert ask("return [of.perStep(a, b), of.stepsInMs(b, a)];", hr, steps) == [rate, time]


def test_to_steps_and_back_a_landing_that_was_said_is_kept(ask: Ask) -> None:
    turn = "return of.textOf(of.asSteps(of.queryOf(a), {N: 80, M: 44, L: 62, hr_hz: '400'}));"
    assert ask(turn, "hr_hz=400&measurement_hz=5&delay_ms=110") == "hr_hz=400&N=80&M=44"
    assert ask(turn, "hr_hz=400&measurement_hz=5&delay_ms=110&land_within_ms=156") == "hr_hz=400&N=80&M=44&L=62"


@pytest.mark.parametrize(
    ("query", "mode"),
    [("", "times"), ("N=10&M=4", "steps"), ("N=10&delay_ms=3&hr_hz=400", "times"), ("method=clone", "times")],
)
def test_in_what_a_link_speaks(ask: Ask, query: str, mode: str) -> None:
    assert ask("return of.modeOf(of.queryOf(a));", query) == mode
