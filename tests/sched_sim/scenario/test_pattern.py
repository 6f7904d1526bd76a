"""How measurements meet, on average, against counting them one by one over a whole pattern."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from math import ceil, floor

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.scenario.pattern import going_back, in_flight
from sched_sim.scenario.scenario import Sensor
from tests.scenarios import HR, LR, sensor

PREDICT = 100.0
CORRECTIONS = 1.0, 7.0, 31.0
"""So unlike that a sum says what it is of."""
PATTERN = 60
"""Steps after which all of the sensors below repeat."""


@st.composite
def certain(draw: st.DrawFn) -> list[Sensor]:
    """Up to three sensors, each with one delay."""
    found = []
    for name in "abc"[: draw(st.integers(1, 3))]:
        every = draw(st.sampled_from([1, 2, 3, 4, 5, 6, Fraction(4, 3), Fraction(5, 2), Fraction(10, 3)]))
        delay = draw(st.integers(0, 7) | st.sampled_from([Fraction(1, 3), Fraction(5, 2), Fraction(14, 3)]))
        offset = draw(st.integers(0, floor(every) - 1) | st.sampled_from([Fraction(1, 2), Fraction(5, 3)]))
        priority = draw(st.sampled_from([HR - 5, HR, LR]))
        found.append(sensor(name, every, delay, offset=offset, priority=priority))
    return found


def counted(sensors: list[Sensor], number: int) -> float:
    """Each measurement of one sensor, of the second pattern, by itself."""
    taken = [
        (t, other, ceil(one.offset + i * one.every + one.delays[0]))
        for other, one in enumerate(sensors)
        for i, t in enumerate(one.takes(3 * PATTERN))
    ]
    work = 0.0
    priority = sensors[number].priority
    for t, _, m in [one for one in taken if one[1] == number and PATTERN <= one[0] < 2 * PATTERN]:
        together = [(u, other) for u, other, n in taken if u < n == m and sensors[other].priority == priority]
        if t < m and min(together) < (t, number):
            continue
        found = [
            CORRECTIONS[other]
            for u, other, n in taken
            if t <= u <= m and (t, number) != (u, other) and (n < m or (n == m and sensors[other].priority < priority))
        ]
        work += (m - t) * PREDICT + sum(found) if t < m else 0.0
    return work / PATTERN


@given(certain())
def test_going_back(sensors: list[Sensor]) -> None:
    """All late ones of a priority that arrive in a step m go back together, to the earliest. It finds corrected what
    has arrived before m, or in m and is more urgent."""
    for number, found in enumerate(going_back(sensors, PREDICT, CORRECTIONS[: len(sensors)])):
        assert found == pytest.approx(counted(sensors, number))


def test_random_delays_weigh_by_their_share() -> None:
    """3 steps to three quarters, else 1; of the others, which are more urgent, one in each step is found."""
    a, b = sensor("a", 4, [1, 3, 3, 3]), sensor("b", 1, priority=HR)
    expected = (2.5 * PREDICT + 3.5 * 7.0) / 4
    assert going_back([a, b], PREDICT, [1.0, 7.0])[0] == pytest.approx(expected)


def test_what_does_not_go_with_another_of_its_step_may_have_come_before_it() -> None:
    """The first comes after 1 or 2 steps, the second after 2: half of them go together, to the first's; of the others
    each finds the first corrected. One of another step is late too."""
    a, b = sensor("a", 3, [1, 2], offset=1), sensor("b", 3, 2, offset=1)
    nothing = sensor("c", 2, priority=LR + 1)
    found = going_back([a, b, nothing], PREDICT, [1.0, 7.0, 0.0])[1]
    assert found == pytest.approx((2 * PREDICT + 1.0) / 6)
    found = going_back([replace(a, offset=2), b, nothing], PREDICT, [1.0, 7.0, 0.0])[1]
    assert found == pytest.approx(2 * PREDICT / 3)


A = sensor("a", 9, 5, offset=2)
LOST = sensor("a", 3, 1, offset=1, dropout=1.0)
AT_ONCE_OR_LATE = sensor("a", 3, [0, 2], offset=1, dropout=0.5)
NOW_AND_THEN, EVERY_STEP = sensor("b", 3, offset=1, priority=HR), sensor("b", 1, offset=5, priority=HR)


def as_urgent(of: Sensor) -> Sensor:
    """As the other ones, whose corrections of the same step come first."""
    return replace(of, priority=LR)


@pytest.mark.parametrize(
    ("sensors", "of", "share"),
    [
        ([A], None, 5 / 9),
        ([replace(A, dropout=0.4)], None, 0.4 + 0.6 * 5 / 9),
        ([A], NOW_AND_THEN, 2 / 3),  # two and five steps after it was taken, and eight
        ([A], as_urgent(NOW_AND_THEN), 1 / 3),
        ([LOST], None, 1),
        ([LOST], EVERY_STEP, 2 / 3),  # in the step of its own the next is taken before
        ([LOST], NOW_AND_THEN, 0),
        ([LOST], replace(NOW_AND_THEN, offset=2), 1),
        ([AT_ONCE_OR_LATE], None, 2 / 3 + (1 / 4 + 1 / 4) / 3),  # the last that was late was lost: 0.5 of 0.75
        ([AT_ONCE_OR_LATE], EVERY_STEP, 2 / 3 + (1 / 4 + 1 / 4) / 3),
        ([AT_ONCE_OR_LATE], as_urgent(EVERY_STEP), 2 / 3 + 1 / 4 / 3),
        ([sensor("a", 6, 1, dropout=1.0), sensor("c", 6, 1, offset=3, dropout=1.0)], None, 1),
        ([sensor("a", 6, 1, dropout=1.0), sensor("c", 6, 1, offset=2)], None, 3 / 6),  # until the next is taken
        ([sensor("a", 6, 1, dropout=1.0), sensor("c", 6, 3, offset=3)], None, 1),
        ([sensor("a", 6, 1, dropout=1.0), sensor("c", 6, [0, 1], offset=3)], None, 1),  # that is late for certain
        ([A, sensor("b", 1)], None, 5 / 9),
        ([sensor("a", 6, 1)], None, 1 / 6),
        ([sensor("a", Fraction(9, 2), Fraction(5, 2))], None, 5 / 9),  # of step 0 until 3, of step 5 until 7
        ([sensor("a", Fraction(9, 2), Fraction(5, 2))], sensor("b", Fraction(9, 2), offset=3, priority=HR), 1 / 2),
        ([sensor("a", Fraction(9, 2), Fraction(5, 2))], as_urgent(sensor("b", Fraction(9, 2), offset=3)), 0),
        ([sensor("a", Fraction(9, 2), [0, 2], dropout=0.5)], None, 2 / 3 + 1 / 4 * 4 / 9),
        ([sensor("b", 1)], None, 0),
    ],
)
def test_in_flight(sensors: list[Sensor], of: Sensor | None, share: float) -> None:
    assert in_flight(sensors, of) == pytest.approx(share)
