"""The highest rate: the highest of all, whatever N, M and L become, and whichever rate was asked about."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from math import floor

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sched_sim.costs.table_file import load_costs
from sched_sim.design.fit import fit
from sched_sim.design.highest_rate import highest_rate
from sched_sim.design.landing import landing
from sched_sim.design.least_speed import least_speed
from sched_sim.design.methods import method_of, select
from sched_sim.design.necessary import Range, demands
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs, DualRateCosts, LarsenCosts, RecalculateCosts, converted
from sched_sim.design.times import Times
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.processors.part import on_part
from sched_sim.processors.part_file import load_part
from sched_sim.schedule.tasks import Task
from tests.designs import Design, designs


def on(part: str, method: str) -> Costs:
    return select(on_part(load_costs("counted-9-3-3"), load_part(part)), method)


def fits(costs: Costs, times: Times, rate: Fraction, options: Options) -> bool:
    """From the words of `Times`, without the pieces; a wait of a part of a step counts as one."""
    law = method_of(costs).law(options.feedback)
    N, M, L = (replace(times, delay_ms=Fraction(0)) if law.undelayed else times).steps(rate)
    assert N is not None
    if L is not None and times.land_within_ms is not None and times.wait(rate):
        L = floor(times.land_within_ms * rate / 1000) - 1
    latest = law.latest(N, M or 0)
    try:
        timing = Timing(N, M or 0, latest if L is None else min(L, latest))
        method_of(costs).check_design(costs, timing, options.feedback)
    except InputError:
        return False
    return landing(costs, timing, 1 / rate, options, ()) is not None


seconds = st.fractions(0, 2, max_denominator=12) | st.sampled_from([Fraction(1), Fraction(1, 2), Fraction(0)])


@settings(max_examples=20)
@given(designs, seconds, st.none() | seconds, st.sampled_from([1, 3, 20]))
def test_it_fits_and_none_above_it_does(
    design: Design, delay: Fraction, more: Fraction | None, per_second: int
) -> None:
    """Costs are 1 to 100 parts of a second."""
    costs, options = converted(design.costs, lambda cost: Fraction(cost) / (100 * per_second)), design.options
    times = Times(Fraction(1), 1000 * delay, None if more is None else 1000 * (delay + more))
    found = highest_rate(costs, times, Fraction(1), options)
    least = found or Fraction(1)
    assert found is None or fits(costs, times, found, options)
    if isinstance(costs, DualRateCosts) and max(delay, delay + (more or 0)) >= 1:
        return  # several corrections on their way: searched, not computed
    unit = Fraction(10) ** (len(str(int(least))) - 4)  # it is rounded down to four digits
    grid = {least + unit * step for step in range(1, 60)} | {least * (1 + Fraction(step, 97)) for step in range(1, 100)}
    changes = (1000 / ms for ms in (Fraction(1000), times.delay_ms, times.land_within_ms) if ms)
    grid |= {change * step for change in changes for step in range(1, 80) if change * step >= least + unit}
    assert not [rate for rate in grid if fits(costs, times, rate, options)]


@settings(max_examples=100)
@given(designs, st.integers(0, 3), st.integers(0, 3), st.integers(0, 3))
def test_what_is_needed_of_a_range_is_needed_of_each_timing_in_it(design: Design, N: int, M: int, L: int) -> None:
    costs, timing, options = design
    timings = Range(max(timing.N - N, 1), timing.N + L, max(timing.M - M, 0), timing.M + N, timing.L + L)
    speed = least_speed(costs, timing, options).speed
    assert all(work <= periods * speed for work, periods in demands(costs, timings, options))


@pytest.mark.parametrize("asked", [400, 53, 12])
def test_a_higher_piece_is_found_from_any_rate(asked: int) -> None:
    """Bisection said 68.5 Hz from 400 and none from 12."""
    costs, times = on("cortex-m0plus", "dual-rate"), Times.of(5, 110)
    highest = Fraction("70.08")
    assert highest_rate(costs, times, Fraction(asked)) == highest
    assert fits(costs, times, highest, Options())
    assert fit(costs, Timing.at(highest, 5, 110), highest, times=times).highest_hz == highest


def test_with_tasks_a_higher_piece_is_looked_at() -> None:
    """Bisection said 27.27 Hz from 400 and none from 12."""
    costs, times = on("cortex-m0plus", "dual-rate"), Times.of(5, 110)
    for asked in map(Fraction, (400, 12)):
        task = Task("control", asked * Fraction(2, 5), Fraction(1, 50), 5)
        assert highest_rate(costs, times, asked, Options(), [task]) == Fraction("30.16")


@pytest.mark.parametrize("scale", [Fraction(1), Fraction(2), Fraction(1, 3)])
@pytest.mark.parametrize("method", ["recalculate", "larsen", "dual-rate"])
def test_with_tasks_it_does_not_hang_on_the_rate_asked_about(method: str, scale: Fraction) -> None:
    """A task of 20 ms in each 400 ms, on a slow part."""
    costs, times = on("cortex-m0plus", method), Times.of(2, 100)
    asked = 400 * scale
    task = Task("control", asked * Fraction(2, 5), Fraction(1, 50), 5)
    there = highest_rate(costs, times, asked, Options(), [task])
    near = Fraction(12)
    assert there == highest_rate(costs, times, near, Options(), [replace(task, period=near * Fraction(2, 5))])
    assert there is not None
    N, M, _ = times.steps(there)
    timing = Timing(N or 0, M or 0, method_of(costs).law("next-step").latest(N or 0, M or 0))
    assert landing(costs, timing, 1 / there, Options(), [replace(task, period=there * Fraction(2, 5))]) is not None


def test_thousands_of_pieces_are_quick() -> None:
    """Those of a desktop at a measurement in each second: more than 500,000 steps."""
    highest = highest_rate(on("desktop", "dual-rate"), Times.of(1, 500), Fraction(400))
    assert highest is not None
    assert highest > 500_000


def test_a_rate_that_fits_alone_is_not_rounded() -> None:
    """Lands when it arrives, after 7/100 of a second, which is whole steps only at n / 0.07, as the interval is."""
    costs = RecalculateCosts(Fraction(1, 200), Fraction(1, 200), Fraction(1, 1000))
    times = Times.of(Fraction(8, 7), 70, 70)
    assert highest_rate(costs, times, Fraction(100)) == Fraction(400, 7)


def test_a_correction_that_would_land_in_a_busier_step() -> None:
    """M = 0: landing in step k + 1, whose HR job takes 0.9 with the correction, it does not fit at once where it could
    land there."""
    costs = DualRateCosts(*(Fraction(cost, 100) for cost in (20, 80, 10, 10, 0, 10)))
    times = Times.of(Fraction(1, 20), 0)
    highest = highest_rate(costs, times, Fraction(1))
    assert highest is not None
    assert fits(costs, times, highest, Options())


def test_with_tasks_it_has_four_digits_where_the_rate_from_which_it_is_searched_has_more_before_the_point() -> None:
    """It was searched from above 1000 Hz to whole hertz: 833 of 833.4."""
    hr = Fraction(59987, 10**8)
    costs, times = DualRateCosts(hr, hr, Fraction(0), Fraction(1, 10**4), hr, Fraction(1, 10**4)), Times.of(5, 110)
    task = Task("control", Fraction(8, 5), Fraction(6, 10**4), 5)
    assert highest_rate(costs, times, Fraction(400), Options(), [task]) == Fraction("833.4")


@pytest.mark.parametrize("asked", [400, 500, 600, 640, 700, 800])
def test_at_rates_at_which_phases_are_locked_tasks_have_their_offsets(asked: int) -> None:
    """A task each 5 ms, 2.5 ms after the measurements, which are on the grid too: at any phase it may come in the step
    with the update, 1.75 ms in all."""
    costs, times = LarsenCosts(*(Fraction(us, 10**6) for us in (400, 600, 550))), Times.of(5, 110)
    task = Task("control", Fraction(asked, 200), Fraction(6, 10**4), 5, Fraction(asked, 400))
    at_any = highest_rate(costs, times, Fraction(asked), Options(), [replace(task, offset="any")])
    found = highest_rate(costs, times, Fraction(asked), Options(), [task])
    assert at_any is not None
    assert at_any < 600
    assert found == 800
    there = [replace(task, period=Fraction(4), offset=Fraction(2))]
    assert landing(costs, Timing(160, 88, 88), 1 / found, Options(), there) is not None


def test_of_tasks_of_any_phase_beside_those_of_given_offset_the_phase_is_any() -> None:
    costs, times = LarsenCosts(*(Fraction(us, 10**6) for us in (400, 600, 550))), Times.of(5, 110)
    tasks = [
        Task("control", Fraction(2), Fraction(6, 10**4), 5, Fraction(1)),
        Task("telemetry", Fraction(40), Fraction(4, 10**4), 6),
    ]
    found = highest_rate(costs, times, Fraction(400), Options(), tasks)
    at_any = highest_rate(costs, times, Fraction(400), Options(), [replace(task, offset="any") for task in tasks])
    assert found == 600
    assert at_any is not None
    assert at_any < 500


@pytest.mark.parametrize("asked", [400, 600, 800])
def test_one_task_whose_phase_is_locked_will_do(asked: int) -> None:
    """Telemetry is never in the way of the HR loop, and its period whole HR periods at multiples of 3 Hz only."""
    costs, times = LarsenCosts(*(Fraction(us, 10**6) for us in (400, 600, 550))), Times.of(5, 110)
    tasks = [
        Task("control", Fraction(asked, 200), Fraction(6, 10**4), 5, Fraction(asked, 400)),
        Task("telemetry", Fraction(asked, 3), Fraction(4, 10**4), 30, Fraction(asked, 1000)),
    ]
    assert highest_rate(costs, times, Fraction(asked), Options(), tasks) == 800
