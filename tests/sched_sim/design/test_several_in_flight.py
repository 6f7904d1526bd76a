"""Measurements that are taken before others have arrived, M > N, and corrections that land after the next, L > N."""

from __future__ import annotations

from collections import defaultdict, deque
from fractions import Fraction
from typing import Any, Literal

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from filters.delayed import clone, cloning, high_rate_task, larsen, larsen_in_flight, low_rate_task
from filters.delayed import dual_rate as dual_rate_filter
from filters.systems.example import example_system
from sched_sim.costs.table_file import load_costs
from sched_sim.design.least_speed import achieved_l, least_speed, staircase
from sched_sim.design.load import loads
from sched_sim.design.methods import METHODS, select
from sched_sim.design.options import Options
from sched_sim.design.pieces import (
    CloneCosts,
    CloneInFlightCosts,
    DualRateCosts,
    LarsenInFlightCosts,
    RecalculateCosts,
)
from sched_sim.design.search import least_speed_by_simulation, search_resolution
from sched_sim.design.simulate import simulate
from sched_sim.design.steady import run_until_steady
from sched_sim.design.timing import Feedback, Timing
from sched_sim.errors import InputError
from sched_sim.schedule.outcome import Schedule
from sched_sim.schedule.tasks import Task
from tests.designs import Design, designs_in_flight
from tests.strategies import problem

COUNTED = load_costs("counted-9-3-3")


def works(schedule: Schedule, kind: str) -> dict[int, dict[str, int]]:
    """By step of the job, its parts."""
    return {piece.step: dict(piece.parts) for piece in schedule.slices if piece.kind == kind}


def test_recalculate_replays_more_steps_than_lie_between_measurements() -> None:
    """N = 3, M = 7: m = 7, 10, 13, ...; 2 + 5 + 7 x 3 = 28 in each."""
    schedule = simulate(RecalculateCosts(2, 5, 3), Timing(3, 7, 7), 28, cycles=3, keep_slices=True)
    found = works(schedule, "hr")
    assert [step for step, parts in found.items() if "U" in parts] == [7, 10, 13]
    assert found[7] == {"P": 2, "U": 5, "R": 21}
    assert (schedule.misses, schedule.achieved) == (0, {7: 3})
    assert least_speed(RecalculateCosts(2, 5, 3), Timing(3, 7, 7)).speed == 28


def test_larsen_has_a_product_for_each_that_is_on_its_way() -> None:
    """N = 3, M = 7: in step 12 those of k = 6 and 9; that of k = 3 landed in 10; in step 13, too, which corrects the
    state by that of k = 6, and what was known at k = 9 and 12."""
    costs = LarsenInFlightCosts(10, 13, 99, 20, 4, 1)
    found = works(simulate(costs, Timing(3, 7, 7), 100, cycles=5, keep_slices=True), "hr")
    assert found[0] == {"P": 10, "G": 20}
    assert found[1] == {"P": 10}
    assert found[2] == {"P": 13}
    assert [found[step]["P"] for step in range(5, 14)] == [16] * 9
    assert found[12] == {"P": 16, "G": 20}
    assert found[13] == {"P": 16, "U": 6}


def test_dual_rate_goes_through_each_cycle_since() -> None:
    """N = 4, M = 5, L = 10: at a speed at which the LR update of k, due k + 10, finishes in step k + 8 or 9."""
    costs = DualRateCosts(hr=6, hr_restart=6, hr_update=1, lr_propagate=5, lr_gain=0, lr_update=8)
    speed = least_speed(costs, Timing(4, 5, 10)).speed
    schedule = simulate(costs, Timing(4, 5, 10), speed, cycles=6, keep_slices=True)
    assert schedule.misses == 0
    (landed,) = {L for L in schedule.achieved if L > 8} or {8}
    hr, lr = works(schedule, "hr"), works(schedule, "lr_update")
    steady = [k for k in lr if k >= 12 and k + landed in hr]
    for k in steady:
        assert hr[k + landed]["HRU"] == -(-landed // 4)
        assert lr[k]["LRU"] == 8 + -(-landed // 4) - 1


class ByTheTick:
    """The dual-rate filter on one processor, tick by tick: another simulation, of M and L beyond N, next-step feedback.

    Written from the timeline: of what is ready, HR jobs in order, then LR jobs in the order of cycles.
    """

    def __init__(self, costs: DualRateCosts[int], timing: Timing, by_l: bool) -> None:
        self.costs, self.timing, self.early = costs, timing, costs.lr_gain > 0
        self.due = timing.L if by_l or timing.M == 0 else timing.M

    def run(self, period: int, steps: int) -> tuple[dict[int, int], bool]:
        """(achieved L by cycle, whether something was missed)."""
        c, (N, M, L) = self.costs, (self.timing.N, self.timing.M, self.timing.L)
        high: deque[list[int]] = deque()  # [work left, step]
        done: dict[tuple[str, int], int] = {}
        left: dict[tuple[str, int], int] = {}
        released: list[tuple[str, int]] = []
        landed: dict[int, int] = {}
        missing: dict[int, int] = {}
        missed = False
        for now in range(steps * period + 1):
            while high and not high[0][0]:
                _, step = high.popleft()
                missed |= now > (step + 1) * period
                if step % N == 0:
                    released.append(("P", step // N))
            if now % period == 0:
                j = now // period
                work = c.hr_restart if j % N == 1 % N else c.hr
                for kind, cycle in list(done):
                    if kind == "U" and cycle not in landed and done[kind, cycle] <= now:
                        landed[cycle] = j - cycle * N
                        work += c.hr_update * max(-(-landed[cycle] // N), 1)
                if j % N == 0:
                    missing[j // N] = j // N - len(landed)
                if j >= M and (j - M) % N == 0:
                    released.append(("U", (j - M) // N))
                high.append([work, j])
            if now == steps * period:
                break
            if high:
                high[0][0] -= 1
                continue
            job = self._next_low(released, done)
            if job is None:
                continue
            kind, cycle = job
            if job not in left:
                compensation = missing[cycle] * c.hr_update
                left[job] = c.lr_propagate + c.lr_gain if kind == "P" else c.lr_update + compensation
            left[job] -= 1
            if not left[job]:
                done[job] = now + 1
                missed |= now + 1 > (cycle * N + (self.due if kind == "P" else L)) * period
        for kind, cycle in released:
            at = (cycle * N + (self.due if kind == "P" else L)) * period
            missed |= (kind, cycle) not in done and at <= steps * period
        missed |= any(left_now and (step + 1) * period <= steps * period for left_now, step in high)
        return landed, missed

    def _next_low(self, released: list[tuple[str, int]], done: dict[tuple[str, int], int]) -> tuple[str, int] | None:
        ready = []
        for order, (kind, cycle) in enumerate(released):
            if (kind, cycle) in done:
                continue
            before = ("P", cycle) if kind == "U" else ("U", cycle - 1)
            if before in done or (kind == "P" and (self.early or cycle == 0)):
                ready.append((order if self.early else 2 * cycle + (kind == "U"), (kind, cycle)))
        return min(ready)[1] if ready else None


@settings(max_examples=20)
@example(Design(DualRateCosts(1, 1, 3, 3, 1, 90), Timing(1, 4, 6), Options(gain="precomputed")))
@given(designs_in_flight().filter(lambda design: design.options.feedback == "next-step" and design.options.cpus == 1))
def test_another_simulation_by_the_tick_lands_and_misses_alike(design: Design) -> None:
    costs, timing, options = design
    small = DualRateCosts(*(1 + work % 7 if work else 0 for work in (
        costs.hr, costs.hr_restart, costs.hr_update, costs.lr_propagate, costs.lr_gain, costs.lr_update
    )))  # fmt: skip
    by_l = options.lr_propagate_by == "l"
    floor = max(loads(small, timing, Fraction(1), options))
    for period in {int(floor) + 1, int(floor) + 2, int(1.5 * floor) + 2}:
        landings: dict[int, int] = {}
        cycles = 6
        schedule = simulate(small, timing, period, cycles, options, on_landing=landings.__setitem__)
        landed, missed = ByTheTick(small, timing, by_l).run(period, schedule.horizon // schedule.period)
        assert landings == {cycle: L for cycle, L in landed.items() if cycle < cycles}
        assert (schedule.misses > 0) == missed


@settings(max_examples=20)
@given(designs_in_flight())
def test_at_the_least_speed_nothing_is_ever_missed_and_a_tick_less_is_too_slow(design: Design) -> None:
    costs, timing, options = design
    speed = least_speed(costs, timing, options).speed
    steady = run_until_steady(costs, timing, speed, options)
    assert steady.repeats
    cycles = 5 * -(-steady.steps // timing.N)
    schedule = simulate(costs, timing, speed, cycles, options)
    assert schedule.misses == 0
    assert schedule.achieved.total() == cycles
    assert max(schedule.achieved) <= timing.L
    assert achieved_l(costs, timing, speed, options) == max(steady.schedule.achieved)
    assert all(share <= 1 for share in loads(costs, timing, speed, options))
    slower = speed - Fraction(1, search_resolution(costs, options, ()))
    assert not run_until_steady(costs, timing, slower, options).repeats


@pytest.mark.parametrize("method", ["recalculate", "larsen", "clone", "dual-rate"])
def test_a_camera_that_is_later_than_its_next_frame(method: str) -> None:
    """30 Hz, 33.3 ms late, a loop of 400 Hz: N = 13, M = 14."""
    timing = Timing.at(400, 30, "33.3")
    assert (timing.N, timing.M, timing.L) == (13, 14, 26)
    costs = select(COUNTED, method)
    least = least_speed(costs, timing)
    landed = achieved_l(costs, timing, least.speed)
    assert landed is not None
    assert landed <= 26
    assert simulate(costs, timing, least.speed, 20).misses == 0


def test_every_frame_can_be_used_where_an_update_takes_longer_than_their_interval() -> None:
    """HR 1, LR 20 a frame, N = 4, M = 2: in time for the next frame it takes 10; later, the load, 6, is enough."""
    costs = DualRateCosts(hr=1, hr_restart=1, hr_update=Fraction(1, 1000), lr_propagate=2, lr_gain=0, lr_update=18)
    assert least_speed(costs, Timing(4, 2, 4), Options(lr_propagate_by="l")).speed == 10
    speed = least_speed(costs, Timing(4, 2, 8), Options(lr_propagate_by="l")).speed
    assert 6 <= speed < Fraction("6.01")


def test_a_later_landing_never_needs_more_than_an_earlier_one_here() -> None:
    costs = select(COUNTED, "dual-rate")
    speeds = [least_speed(costs, Timing(13, 14, L)).speed for L in (15, 18, 26, 39)]
    assert speeds == sorted(speeds, reverse=True)
    stairs = staircase(costs, 13, 14)
    assert [stair.L for stair in stairs] == list(range(15, 27))
    assert all(stair.achieved <= stair.L for stair in stairs)


IN_FLIGHT = [
    (DualRateCosts(63, 4, 3, 41, 0, 56), Timing(10, 4, 10)),  # Steffes 2014, Table 3
    (DualRateCosts(3, 9, 2, 8, 0, 7), Timing(4, 2, 4)),  # what lands at k + 1 needs most
    (DualRateCosts(30, 9, 1, 5, 7, 6), Timing(3, 0, 3)),
]


@pytest.mark.parametrize(("costs", "timing"), IN_FLIGHT)
@pytest.mark.parametrize("feedback", ["next-step", "same-step"])
@pytest.mark.parametrize("cpus", [1, 2])
def test_from_a_landing_on_a_later_one_asks_for_no_less(
    costs: DualRateCosts[int], timing: Timing, feedback: Feedback, cpus: Literal[1, 2]
) -> None:
    """The least speed falls with L, from before the next measurement on, until an interval after arrival."""
    options = Options(feedback=feedback, cpus=cpus, gain="precomputed" if costs.lr_gain else "at-update")
    (N, M), law = (timing.N, timing.M), METHODS["dual-rate"].law(feedback)
    first, last = law.last_alone(N, M), law.last_of_use(N, M)
    assert first is not None
    speeds = [least_speed(costs, Timing(N, M, L), options).speed for L in (*range(first, last + 1), last + 2 * N)]
    assert speeds == sorted(speeds, reverse=True)
    assert speeds[-1] == speeds[-2]


COST = st.integers(1, 9)


@settings(max_examples=30)
@given(st.data())
def test_a_later_landing_needs_no_more_than_a_search_finds_where_none_is_made(data: st.DataObject) -> None:
    """LR work that is done before the next measurement on each processor that bears the HR loop: any L > N needs what
    L = N does. Where a slower processor does again, the search may find more."""
    early, hr = data.draw(st.booleans()), data.draw(st.integers(1, 60))
    costs = DualRateCosts(hr, data.draw(COST), data.draw(COST), data.draw(COST), 7 if early else 0, data.draw(COST))
    options = Options(
        feedback=data.draw(st.sampled_from(["next-step", "same-step"])),
        gain="precomputed" if early else "at-update",
        cpus=data.draw(st.sampled_from([1, 2])),
    )
    N = data.draw(st.integers(2, 12))
    timing = Timing(N, M := data.draw(st.integers(0, N - 1)), data.draw(st.integers(N + 1, 2 * N + M + 1)))
    assert least_speed(costs, timing, options).speed <= least_speed_by_simulation(costs, timing, options, ())[0]


def test_the_default_is_the_first_measurement_that_is_taken_after_arrival() -> None:
    law = METHODS["dual-rate"].law("next-step")
    assert [law.latest(10, M) for M in (0, 9, 10, 14, 20)] == [10, 10, 20, 20, 30]
    assert list(law.legal(10, 14)) == list(range(15, 21))
    assert METHODS["dual-rate"].law("same-step").latest(10, 14) == 19
    assert METHODS["recalculate"].law("next-step").latest(10, 14) == 14


@pytest.mark.parametrize("timing", [Timing(1, 2000, 2001), Timing(10**5, 10, 3 * 10**5)])
def test_more_in_flight_than_anyone_has_is_refused(timing: Timing) -> None:
    with pytest.raises(InputError, match=f"L={timing.L} with N={timing.N} is more than is simulated"):
        least_speed(select(COUNTED, "dual-rate"), timing)


def test_a_table_without_the_entries_of_larsen_in_flight_says_which() -> None:
    costs = select(load_costs("steffes2014"), "larsen")
    assert least_speed(costs, Timing(10, 10, 10)).speed == Fraction("1.47")
    for asked in (least_speed, lambda *design: simulate(*design, 2)):
        with pytest.raises(InputError, match=r"where M is more than N, .*\[costs.larsen\] gain, correct, compensate"):
            asked(costs, Timing(13, 14, 14))


@pytest.mark.parametrize("method", ["recalculate", "larsen", "clone"])
def test_tasks_of_any_phase_beside_measurements_in_flight(method: str) -> None:
    costs, timing = select(COUNTED, method), Timing(6, 14, 14)
    tasks = [Task("control", Fraction(3), Fraction(20_000), priority=5)]
    speed = least_speed(costs, timing, tasks=tasks).speed
    assert simulate(costs, timing, speed, 50, tasks=tasks).misses == 0
    for offset in (Fraction(0), Fraction(1, 2), Fraction(2)):
        known = [Task("control", Fraction(3), Fraction(20_000), priority=5, offset=offset)]
        assert least_speed(costs, timing, tasks=known).speed <= speed


def test_of_dual_rate_they_are_refused_by_deadlines() -> None:
    tasks = [Task("control", Fraction(3), Fraction(1), priority=5)]
    costs, timing, options = select(COUNTED, "dual-rate"), Timing(6, 4, 9), Options(policy="edf")
    with pytest.raises(InputError, match=r"policy edf with L=9 and N=6: .*policy fixed, or give each task"):
        least_speed(costs, timing, options, tasks)
    fixed = [Task("control", Fraction(3), Fraction(1), priority=5, offset=Fraction(1))]
    assert least_speed(costs, timing, options, fixed).speed > 0
    assert least_speed(costs, timing, tasks=tasks).speed >= least_speed(costs, timing).speed


def test_clone_is_coupled_with_each_that_is_on_its_way() -> None:
    """N = 3, M = 7: at k = 12 those of 6 and 9 are on their way, for that of 3 landed in 10. In 13 that of 6 lands, and
    what is expected of 9 and 12 is compensated."""
    costs = CloneInFlightCosts(100, 20, 1, 30, 5, 3)
    found = works(simulate(costs, Timing(3, 7, 7), 1000, cycles=5, keep_slices=True), "hr")
    assert found[0] == {"P": 100, "ST": 20}
    assert found[3] == {"P": 100, "CA": 1, "ST": 25}
    assert found[12] == {"P": 100, "CA": 2, "ST": 30}
    assert found[13] == {"U": 36, "P": 100, "CA": 2}
    assert found[14] == {"P": 100, "CA": 2}
    assert least_speed(costs, Timing(3, 7, 7)).speed == 138


@given(N=st.integers(1, 200), data=st.data())
def test_clone_needs_less_than_larsen_and_than_the_carried_gain_with_few_in_flight(N: int, data: st.DataObject) -> None:
    """Counted at 9 states and 3 measurements: than the carried gain with up to seven others on their way."""
    M = data.draw(st.integers(N + 1, 8 * N))
    clone, larsen_, carried = (
        least_speed(select(COUNTED, method), Timing(N, M, M)).speed for method in ("clone", "larsen", "carried-gain")
    )
    assert clone < larsen_
    assert clone < carried


def test_clone_split_has_one_on_its_way_and_names_clone() -> None:
    costs = select(COUNTED, "clone-split")
    for asked in (least_speed, lambda *design: simulate(*design, 2)):
        with pytest.raises(InputError, match=r"M=14 must be <= N=13 with this method.* larsen, clone, carried-gain"):
            asked(costs, Timing(13, 14, 14))


def test_a_table_without_the_entries_of_clone_in_flight_says_which() -> None:
    costs = CloneCosts(*map(Fraction, (100, 20, 1, 30)))
    assert least_speed(costs, Timing(10, 10, 10)).speed == 150
    for asked in (least_speed, lambda *design: simulate(*design, 2)):
        with pytest.raises(InputError, match=r"where M is more than N, .*\[costs.clone\] couple, compensate"):
            asked(costs, Timing(13, 14, 14))


class Counter:
    """How often each job of a filter is run."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, *modules: Any) -> None:
        self.calls: defaultdict[str, int] = defaultdict(int)
        for module in modules:
            monkeypatch.setattr(module, "function_for", self.function_for)

    def function_for(self, _backend: str, function: Any) -> Any:
        def counted(*arguments: Any) -> Any:
            self.calls[function.__name__] += 1
            return function(*arguments)

        return counted


def test_the_filter_does_the_hr_updates_that_are_scheduled(monkeypatch: pytest.MonkeyPatch) -> None:
    """At the L at which the schedule lands, in the state and as compensation together: the product is the same."""
    N, M, cycles = 5, 7, 9
    unit = DualRateCosts(hr=4, hr_restart=4, hr_update=1, lr_propagate=3, lr_gain=0, lr_update=3)
    timing = Timing(N, M, 13)
    schedule = simulate(unit, timing, least_speed(unit, timing).speed, cycles, keep_slices=True)
    (L,) = schedule.achieved
    counter = Counter(monkeypatch, high_rate_task, low_rate_task)
    steps = (cycles - 1) * N + L
    data = problem(example_system(3, 1, 1), N, M, L, steps, seed=1)
    dual_rate_filter.run(*data._replace(measurements=data.measurements[:cycles]), backend="reference")
    done = counter.calls["hr_update"] + counter.calls["matvec"]
    hr, lr = works(schedule, "hr"), works(schedule, "lr_update")
    in_state = sum(hr[c * N + L].get("HRU", 0) for c in range(cycles) if c * N + L in hr)
    last = cycles * N - N + L not in hr  # it lands as the picture ends
    compensation = sum(lr[c * N]["LRU"] - 3 for c in range(cycles))
    assert done == in_state + last * -(-L // N) + compensation


def test_the_filter_does_the_products_that_are_scheduled(monkeypatch: pytest.MonkeyPatch) -> None:
    N, M, steps = 4, 11, 39
    counter = Counter(monkeypatch, larsen, larsen_in_flight)
    data = problem(example_system(3, 1, 1), N, M, M, steps, seed=1)
    larsen.run(*data, backend="reference")
    unit = LarsenInFlightCosts(1, 1001, 1, 10, 2, 5)
    schedule = simulate(unit, Timing(N, M, M), 10_000, 8, keep_slices=True)
    found = works(schedule, "hr")
    assert len(found) == steps + 1
    assert sum(parts["P"] - 1 for parts in found.values()) == 1000 * counter.calls["matmul"]
    assert sum(parts.get("G", 0) for parts in found.values()) == 10 * counter.calls["lr_gain"]
    corrections = 2 * counter.calls["correct"] + 5 * counter.calls["hr_update"]
    assert sum(parts.get("U", 0) for parts in found.values()) == corrections
    assert np.isfinite(counter.calls["correct"])


def test_the_filter_does_the_cloning_that_is_scheduled(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each kind of job as often as its parts say; a start is what is crossed, coupled apart, and divided."""
    N, M, steps = 4, 11, 39
    counter = Counter(monkeypatch, cloning)
    clone.run(*problem(example_system(3, 1, 1), N, M, M, steps, seed=1), backend="reference")
    starts = counter.calls["start"] + counter.calls["divide"]
    assert counter.calls["divide"] == counter.calls["cross"]
    done = starts, counter.calls["carry"], counter.calls["cloned_update"], counter.calls["couple"]
    for at, expected in enumerate((*done, counter.calls["compensate"]), start=1):
        unit = CloneInFlightCosts(1, *(1000 if piece == at else 1 for piece in range(1, 6)))
        schedule = simulate(unit, Timing(N, M, M), 10_000, 8, keep_slices=True)
        assert schedule.horizon // schedule.period == steps + 1
        assert sum(sum(parts.values()) for parts in works(schedule, "hr").values()) // 1000 == expected
