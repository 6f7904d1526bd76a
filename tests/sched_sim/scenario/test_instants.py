"""Instants between steps: in which steps they are used, against looking at each step."""

from __future__ import annotations

from fractions import Fraction
from itertools import count, pairwise
from math import ceil

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.scenario.instants import Spread, lag, roundings, spread, taken
from tests.scenarios import sensor

steps = st.fractions(0, 20, max_denominator=12)
periods = st.fractions(1, 20, max_denominator=12)


def first_at_or_after(instant: Fraction) -> int:
    return next(step for step in count() if step >= instant)


def test_a_30_hz_camera_at_400_hz() -> None:
    assert taken(Fraction(40, 3), 0, 54) == [0, 14, 27, 40]
    camera = sensor("camera", Fraction(40, 3), Fraction(10, 3))
    assert [*camera.measurements(41, 0)] == [(0, 4), (14, 3), (27, 3), (40, 4)]
    assert (camera.least_delay, camera.longest_delay) == (3, 4)


@given(periods, steps, st.integers(1, 60))
def test_each_measurement_is_taken_in_the_first_step_at_its_instant_or_after_it(
    every: Fraction, offset: Fraction, many: int
) -> None:
    of_all = [first_at_or_after(offset + number * every) for number in range(many)]
    assert [*taken(every, offset, many)] == [step for step in of_all if step < many]
    assert all(one < following for one, following in pairwise(taken(every, offset, many)))


@given(periods, steps, steps)
def test_delays_count_from_the_instant(every: Fraction, offset: Fraction, delay: Fraction) -> None:
    of = sensor("s", every, delay, offset=offset)
    instants = [offset + number * every for number in range(of.every.denominator * 2)]
    lags = [first_at_or_after(instant + delay) - first_at_or_after(instant) for instant in instants]
    assert [lag(instant, delay) for instant in instants] == lags
    assert (of.least_delay, of.longest_delay) == (min(lags), max(lags))
    waits = [first_at_or_after(instant) - instant for instant in instants]
    assert roundings(every, offset) == (min(waits), max(waits))
    drawn = of.measurements(ceil(instants[-1]) + 1, 0)
    assert [*drawn] == [(first_at_or_after(instant), late) for instant, late in zip(instants, lags, strict=True)]


@given(steps, steps)
def test_a_spread_has_both_ends_and_each_step_once(one: Fraction, other: Fraction) -> None:
    least, most = sorted([one, other])
    delays = spread(least, most)
    assert (delays[0], delays[-1], len(delays)) == (least, most, len([*delays]))
    arrivals = [ceil(delay) for delay in delays]
    assert {*arrivals} == {*range(ceil(least), ceil(most) + 1)}
    assert len({*arrivals}) == len(arrivals) or ceil(least) == ceil(most)
    apart = {following - delay for delay, following in pairwise(delays)}
    assert len(apart) <= 1


@pytest.mark.parametrize(
    ("least", "most", "delays"), [(48, 80, range(48, 81)), ("7/2", "7/2", [3.5]), ("1/2", "5/2", [0.5, 1.5, 2.5])]
)
def test_a_spread_of_whole_steps_is_a_range(least: object, most: object, delays: object) -> None:
    found = spread(Fraction(least), Fraction(most))  # type: ignore[call-overload]
    assert found == delays if isinstance(delays, range) else [*found] == delays


def test_a_long_spread_takes_no_room() -> None:
    delays = spread(Fraction(1, 3), Fraction(10**5))
    assert isinstance(delays, Spread)
    assert len(delays) == 10**5
    assert len(delays[::1000]) == 100
    of = sensor("s", Fraction(4, 3), delays)
    assert of.longest_delay == 10**5
