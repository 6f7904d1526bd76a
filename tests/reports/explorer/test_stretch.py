"""The stretch of steps that a chart shows."""

from __future__ import annotations

from collections.abc import Iterator
from math import isclose

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from playwright.sync_api import Browser

from tests.reports.explorer.scripts import Ask, asking

in_browser = settings(deadline=None, max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture])
share = st.floats(0, 1)


@pytest.fixture(scope="module")
def ask(browser: Browser) -> Iterator[Ask]:
    with asking(browser, "stretch") as ask:
        yield ask


Stretch = dict[str, float]


@st.composite
def stretches(draw: st.DrawFn) -> tuple[Stretch, Stretch]:
    """A stretch and the whole that it is of."""
    origin, steps = draw(st.integers(0, 10_000)), draw(st.integers(1, 100_000))
    length = draw(st.floats(0.02, steps))
    first = origin + draw(share) * (steps - length)
    return {"first": first, "end": first + length}, {"first": origin, "end": origin + steps}


def within(stretch: Stretch, whole: Stretch) -> bool:
    return whole["first"] <= stretch["first"] < stretch["end"] <= whole["end"] * (1 + 1e-12)


@in_browser
@given(stretches(), st.floats(0.01, 100), share)
def test_zooming_keeps_the_step_under_the_pointer_where_it_can(
    ask: Ask, given: tuple[Stretch, Stretch], factor: float, where: float
) -> None:
    stretch, whole = given
    at = stretch["first"] + where * (stretch["end"] - stretch["first"])
    zoomed = ask("return of.zoomedStretch(a[0], b, c, a[1]);", given, factor, at)
    assert within(zoomed, whole)
    if whole["first"] < zoomed["first"] and zoomed["end"] < whole["end"]:
        got = (at - zoomed["first"]) / (zoomed["end"] - zoomed["first"])
        assert isclose(got, where, abs_tol=1e-5)


@in_browser
@given(stretches(), st.floats(-1e5, 1e5))
def test_moving_keeps_its_length_and_stays_within_the_schedule(
    ask: Ask, given: tuple[Stretch, Stretch], by: float
) -> None:
    stretch, whole = given
    moved = ask("return of.movedStretch(a[0], b, a[1]);", given, by)
    assert within(moved, whole)
    assert isclose(moved["end"] - moved["first"], stretch["end"] - stretch["first"], rel_tol=1e-6)


@in_browser
@given(stretches(), share, share)
def test_it_moves_no_farther_than_to_show_a_job(
    ask: Ask, given: tuple[Stretch, Stretch], one: float, other: float
) -> None:
    stretch, whole = given
    start, end = sorted(whole["first"] + each * (whole["end"] - whole["first"]) for each in (one, other))
    shown = ask("return of.stretchWith(a[0], b[0], b[1], a[1]);", given, [start, end])
    assert within(shown, whole)
    length = stretch["end"] - stretch["first"]
    slack = 1e-9 * whole["end"]
    assert shown["first"] - slack <= start
    if end - start <= length:
        assert end <= shown["end"] + slack
    if stretch["first"] <= start and end <= stretch["end"]:
        assert shown == stretch


def test_zoomed_out_it_is_the_whole(ask: Ask) -> None:
    assert ask(
        """const whole = of.wholeStretch(3, 80);
        const part = of.zoomedStretch(whole, 0.3, 50, whole);
        return of.sameStretch(of.zoomedStretch(part, 4, 50, whole), whole) && !of.sameStretch(part, whole);"""
    )
