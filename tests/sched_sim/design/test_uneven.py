"""Several measurements on their way at intervals of N and N + 1 steps: each HR job counted step by step, where k are as
they come, is no longer than the least speed, and one is as long."""

from __future__ import annotations

from fractions import Fraction
from math import ceil, floor

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from sched_sim.costs.table_file import load_costs
from sched_sim.design.highest_rate import highest_rate
from sched_sim.design.landing import landing
from sched_sim.design.least_speed import least_speed
from sched_sim.design.load import loads
from sched_sim.design.long_pattern import LONGEST_PATTERN, without_restarts
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.pieces import (
    CarriedCosts,
    CarriedGainInFlightCosts,
    CloneInFlightCosts,
    DualRateCosts,
    LarsenInFlightCosts,
    beside_others,
    product,
    works,
)
from sched_sim.design.simulate import simulate
from sched_sim.design.steady import run_until_steady
from sched_sim.design.times import Instants, Times
from sched_sim.design.timing import Timing
from sched_sim.schedule.tasks import Task

COUNTED = load_costs("counted-9-3-3")
SEVERAL = ["larsen", "clone", "carried-gain"]

Several = LarsenInFlightCosts[int] | CarriedCosts[int]


def longest_of(costs: Several, ks: list[int], ms: list[int], steps: range) -> int:
    """By the words of the timeline."""
    longest = 0
    for step in steps:
        there = [k for k, m in zip(ks, ms, strict=True) if k < step <= m]
        landing = [k for k, m in zip(ks, ms, strict=True) if m == step]
        since = sum(landing[0] < k < step for k in ks) if landing else 0
        if isinstance(costs, LarsenInFlightCosts):
            work = costs.propagate + sum(step - k >= 2 for k in there) * product(costs)
            work += (costs.correct + since * costs.compensate) * len(landing) + (step in ks) * costs.gain
        else:
            propagate, at_k, carry, at_m = works(costs)[:4]
            couple, compensate = beside_others(costs)
            others = len(there) - len(landing)
            work = propagate + others * carry + (at_m + since * compensate) * len(landing)
            work += (step in ks) * (at_k + others * couple)
        longest = max(longest, work)
    return longest


@settings(max_examples=80, deadline=None)
@given(
    every=st.fractions(1, 9, max_denominator=7),
    late=st.fractions(1, 4, max_denominator=3),
    pieces=st.lists(st.sampled_from([0, 1, 3, 20]), min_size=6, max_size=6),
    kind=st.sampled_from([LarsenInFlightCosts, CloneInFlightCosts, CarriedGainInFlightCosts]),
    whole=st.booleans(),
)
def test_the_longest_job_is_that_of_some_step(
    every: Fraction, late: Fraction, pieces: list[int], kind: type[Several], whole: bool
) -> None:
    """Each used M steps after its k, or in the first step after it is there."""
    delay = Fraction(ceil(late * every)) if whole else late * every
    N, M = floor(every), ceil(delay)
    assume(every.denominator > 1 and M > N)
    costs, timing = kind(*pieces), Timing(N, M, M, Instants(every, delay))
    steps = range(M + every.numerator, M + 2 * every.numerator + 1)
    numbers = range(int(steps.stop / every) + 2)
    ks = [ceil(number * every) for number in numbers]
    by_steps = longest_of(costs, ks, [k + M for k in ks], steps)
    at_once = longest_of(costs, ks, [ceil(number * every + delay) for number in numbers], steps)
    speed = least_speed(costs, timing).speed
    assert speed == max(by_steps, at_once)
    if by_steps == speed > 0:
        cycles = timing.taken.before(steps.stop)
        assert simulate(costs, timing, speed, cycles).misses == 0
        assert simulate(costs, timing, speed * Fraction(999, 1000), cycles).misses > 0


@pytest.mark.parametrize(("delay_ms", "speed"), [("67.5", 9390), (35, 7851), (100, 10929)])
def test_by_hand(delay_ms: str | int, speed: int) -> None:
    """400 Hz and 30 Hz, k = 0, 14, 27, 40, ...: 67.5 ms are 27 steps, and in that of 27 gain, correction, what is known
    at 14, and the products of 0 and 14 come together."""
    timing = Timing.at(400, 30, delay_ms)
    assert least_speed(select(COUNTED, "larsen"), timing).speed == speed


def test_of_little_beside_landing_it_is_what_meets() -> None:
    """In step 27 one is carried and coupled, and what is expected of it compensated."""
    costs = CarriedGainInFlightCosts(100, 20, 1, 40, 1, 1)
    assert least_speed(costs, Timing.at(400, 30, "67.5")).speed == 100 + 1 + 20 + 1 + 40 + 1


@pytest.mark.parametrize("method", [*SEVERAL, "recalculate", "dual-rate"])
@pytest.mark.parametrize(("hr_hz", "hz"), [(400, 30), (100, 7), (8, 5)])
@pytest.mark.parametrize("late", [Fraction(11, 10), Fraction(2), Fraction(5, 2)])
def test_at_the_least_speed_nothing_is_missed_and_below_it_something(
    method: str, hr_hz: int, hz: int, late: Fraction
) -> None:
    """Delays in intervals, to whole steps."""
    steps = ceil(late * hr_hz / hz)
    timing = Timing.at(hr_hz, hz, Fraction(1000 * steps, hr_hz))
    costs = select(COUNTED, method)
    speed = least_speed(costs, timing).speed
    assert run_until_steady(costs, timing, speed).repeats
    assert not run_until_steady(costs, timing, speed * Fraction(999, 1000)).repeats


def test_one_step_apart_not_every_step_restarts() -> None:
    """8 Hz and 5 Hz: k = 0, 2, 4, 5, ...; the HR job of a step that is not just after a k is the long one."""
    costs = DualRateCosts(hr=60, hr_restart=4, hr_update=1, lr_propagate=1, lr_gain=0, lr_update=1)
    timing = Timing.at(8, 5, 0, 300)
    assert (timing.N, timing.L) == (1, 1)
    assert least_speed(costs, timing).speed >= 60


@settings(max_examples=6, deadline=None)
@given(
    every=st.fractions(1, 5, max_denominator=3),
    M=st.integers(0, 8),
    more=st.integers(1, 6),
    pieces=st.tuples(*[st.integers(1, 40)] * 5),
)
def test_with_each_interval_the_shorter_one_and_no_restart_it_is_a_bound(
    every: Fraction, M: int, more: int, pieces: tuple[int, int, int, int, int]
) -> None:
    hr, restart, update, lr_propagate, lr_update = pieces
    N, L = floor(every), max(M, floor(every)) + more
    costs = DualRateCosts(hr, min(hr, restart), update, lr_propagate, 0, lr_update)
    timing = Timing(N, M, L, Instants(every, Fraction(M)))
    options = Options(lr_propagate_by="l")
    bound = least_speed(without_restarts(costs), Timing(N, M, L), options).speed
    assert least_speed(costs, timing, options).speed <= bound


def test_a_long_pattern_has_that_bound() -> None:
    costs, timing = select(COUNTED, "dual-rate"), Timing.at(400, "29.97", 40)
    assert isinstance(costs, DualRateCosts)
    assert timing.taken.steps > LONGEST_PATTERN
    bound = least_speed(without_restarts(costs), Timing(timing.N, timing.M, timing.L))
    assert least_speed(costs, timing) == bound


def test_of_a_long_pattern_a_later_landing_needs_no_more() -> None:
    """Than that before the next measurement, which has a closed form."""
    costs = select(load_costs("counted-9-3-3"), "dual-rate")
    later = Timing(70, 13, 95, Times.of("0.91", 190).instants(Fraction(64)))
    assert later.taken.steps > LONGEST_PATTERN
    least = least_speed(costs, later)
    assert least == least_speed(costs, Timing(70, 13, 70))
    assert landing(costs, later, least.speed, Options(), ()) == 34


@pytest.mark.parametrize("method", SEVERAL)
def test_tasks_of_any_phase_have_a_bound(method: str) -> None:
    costs, timing = select(COUNTED, method), Timing.at(400, 30, "67.5")
    task = Task("control", Fraction(3), Fraction(2_000), priority=5)
    speed = least_speed(costs, timing, tasks=[task]).speed
    for offset in (Fraction(0), Fraction(1, 2), Fraction(2)):
        known = Task("control", Fraction(3), Fraction(2_000), priority=5, offset=offset)
        assert least_speed(costs, timing, tasks=[known]).speed <= speed


@pytest.mark.parametrize("method", [*SEVERAL, "recalculate", "dual-rate"])
def test_the_load_is_what_a_long_simulation_is_busy(method: str) -> None:
    costs, timing = select(COUNTED, method), Timing.at(400, 30, "67.5")
    speed = 2 * least_speed(costs, timing).speed
    busy = [simulate(costs, timing, speed, cycles).utilization for cycles in (33, 66)]
    (load,) = loads(costs, timing, speed)
    assert abs(2 * busy[1] - busy[0] - load) < Fraction(1, 200)


@pytest.mark.parametrize(("hz", "delay_ms"), [(4, 2000), (30, "67.5"), (7, 350)])
@pytest.mark.parametrize("method", SEVERAL)
def test_at_the_highest_rate_it_fits_and_at_none_above(method: str, hz: int, delay_ms: str | int) -> None:
    costs = select(COUNTED, method)
    second = Fraction(1, 9_000 * 1290)  # so many seconds an operation
    in_seconds = type(costs)(*(second * work for work in works(costs)))
    times = Times.of(hz, delay_ms)
    highest = highest_rate(in_seconds, times, Fraction(100))
    assert highest is not None

    def fits(rate: Fraction) -> bool:
        return least_speed(in_seconds, Timing.at(rate, hz, delay_ms)).speed <= 1 / rate

    assert fits(highest)
    unit = Fraction(10) ** (len(str(int(highest))) - 4)  # it is rounded down to four digits
    above = {highest * (1 + Fraction(step, 1009)) for step in range(1, 300)}
    whole = {Fraction(rate) for rate in range(ceil(highest) + 1, ceil(highest) + 300)}
    digit = {highest + Fraction(step, 10) for step in range(1, 200)}
    assert not [float(rate) for rate in above | whole | digit if rate >= highest + unit and fits(rate)]
