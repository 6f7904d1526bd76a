"""Least speed and landing at any phase of the tasks: held against the simulation, the closed form, and textbooks."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from math import ceil
from random import Random

import pytest
from hypothesis import example, given, seed, settings
from hypothesis import strategies as st

from sched_sim.costs.table_file import load_costs
from sched_sim.design.any_phase import late_job, worst_landing
from sched_sim.design.least_speed import achieved_l, least_speed
from sched_sim.design.load import loads
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.phased import phased
from sched_sim.design.pieces import DualRateCosts, LarsenCosts, MultirateCosts, StandardCosts, converted
from sched_sim.design.search import search_resolution
from sched_sim.design.simulate import at_worst_phase, simulate
from sched_sim.design.timing import Timing
from sched_sim.design.worst_phase import finishes
from sched_sim.errors import InputError
from sched_sim.schedule.outcome import Response
from sched_sim.schedule.processor import Platform, Processor
from sched_sim.schedule.tasks import Task, TaskSource
from tests.designs import Design, designs, designs_in_flight
from tests.exhaust import share_of

Loaded = tuple[Design, list[Task]]

TRIALS = 10
"""Simulations of a design, each of another phase."""

SHORT = Fraction(1, 1000)


@st.composite
def with_tasks(draw: st.DrawFn, plain: bool = False, in_flight: bool = False) -> Loaded:
    """One to three tasks, of any phase at least one.

    plain: one processor, next-step feedback, fixed priorities of which no two are equal, no context switch; all tasks
    of any phase and preemptive. in_flight: of the dual-rate filter with several corrections on their way.
    """
    plain_ones = designs.filter(lambda design: design.options.cpus == 1 and design.options.feedback == "next-step")
    costs, timing, options = draw(plain_ones if plain else designs_in_flight() if in_flight else designs)
    N = timing.N
    often = st.sampled_from([Fraction(N), Fraction(1), Fraction(2), Fraction(N, 2), Fraction(3, 2), Fraction(2 * N)])
    periods = often | st.fractions(Fraction(1, 2), 15, max_denominator=4)
    priorities = st.sampled_from([5, 10, 15, 20, 30, 31])
    tasks: list[Task] = []
    ranks = (
        draw(st.permutations([5, 6, 15, 16, 30, 31])) if plain else draw(st.lists(priorities, min_size=3, max_size=3))
    )
    for name, priority in zip(draw(st.sampled_from(["a", "ab", "abc"])), ranks, strict=False):
        period = draw(periods)
        deadline = period * draw(st.sampled_from([Fraction(1), Fraction(3, 4), Fraction(1, 2)]))
        jitter = deadline * draw(st.sampled_from([Fraction(0), Fraction(0), Fraction(1, 3), Fraction(1, 8)]))
        given_too = name != "a" and not plain
        tasks.append(
            Task(
                name,
                period,
                Fraction(draw(st.integers(1, 60))),
                priority,
                draw(st.sampled_from(["any", Fraction(0), Fraction(1, 2)])) if given_too else "any",
                draw(st.integers(1, options.cpus)),
                jitter,
                deadline,
                plain or draw(st.booleans()),
            )
        )
    policy = draw(st.sampled_from(["fixed", "edf"])) if options.cpus == 1 and not (plain or in_flight) else "fixed"
    switch = Fraction(0) if plain else draw(st.sampled_from([Fraction(0), Fraction(1), Fraction(3)]))
    return Design(costs, timing, replace(options, policy=policy, context_switch=switch)), tasks


def some_phase(random: Random, tasks: Sequence[Task], N: int) -> list[Task]:
    """Together at a step, just before or after it; or each at a step, just after one, or anywhere. Late as their jitter
    allows, or when they should be."""
    together = random.random() < 0.5
    step = 4 * N + random.randrange(N) + random.choice([0, 0, -SHORT, SHORT])

    def offset(task: Task) -> Fraction:
        if together:
            return step - task.jitter + random.choice([0, 0, 0, 0, -SHORT, SHORT])
        return random.choice(
            [
                Fraction(random.randrange(32 * N), 8),
                Fraction(random.randrange(N)),
                random.randrange(N) + SHORT,
                Fraction(random.randrange(10**6), 10**5),
            ]
        )

    return [
        replace(
            task,
            offset=max(offset(task), Fraction(0)) if task.offset == "any" else task.offset,
            jitter=task.jitter * random.choice([1, 1, 0]),
        )
        for task in tasks
    ]


def cycles_of(tasks: Sequence[Task], N: int) -> int:
    """So many that all tasks have come for a while, and have been due."""
    return 8 + ceil(max(task.start + 2 * task.period for task in tasks) / N)


def holds_at_every_phase(loaded: Loaded, random: Random) -> bool:
    """Whether a correction landed as late as it may."""
    (costs, timing, options), tasks = loaded
    speed = least_speed(costs, timing, options, tasks).speed
    latest = worst_landing(costs, timing, speed, options, tasks)
    assert latest is not None
    landed = set()
    for _ in range(TRIALS):
        phases = some_phase(random, tasks, timing.N)
        schedule = simulate(costs, timing, speed, cycles_of(phases, timing.N), options, phases)
        assert schedule.misses == 0, phases
        landed |= set(schedule.achieved)
    assert max(landed) <= latest
    return latest in landed


@settings(max_examples=15)
@given(with_tasks(), st.integers(0, 2**32))
def test_at_the_least_speed_nothing_is_late_at_any_phase(loaded: Loaded, number: int) -> None:
    holds_at_every_phase(loaded, Random(number))


@pytest.mark.exhaust
@settings(max_examples=20)
@given(with_tasks(in_flight=True), st.integers(0, 2**32))
def test_nor_is_anything_with_several_corrections_on_their_way(loaded: Loaded, number: int) -> None:
    holds_at_every_phase(loaded, Random(number))


@pytest.mark.exhaust
@pytest.mark.parametrize("number", range(20))
def test_nor_on_four_thousand_designs_with_several(number: int) -> None:
    random = Random(number)
    law = given(with_tasks(in_flight=True))(lambda loaded: holds_at_every_phase(loaded, random))
    seed(number)(settings(max_examples=share_of(200))(law))()


@pytest.mark.exhaust
@pytest.mark.parametrize("number", range(50))
def test_nothing_is_on_ten_thousand_designs(number: int, record_property: Callable[[str, object], None]) -> None:
    examples, latest, random = share_of(200), Counter[bool](), Random(number)

    def law(loaded: Loaded) -> None:
        latest[holds_at_every_phase(loaded, random)] += 1

    seed(number)(settings(max_examples=examples)(given(with_tasks())(law)))()
    record_property("designs", examples)
    record_property("landed as late as said", latest[True])


def is_bound(design: Design) -> bool:
    """Whether the least speed may be more than is needed: a correction counts in each step in which it may come, and of
    Larsen's method with M = N the longer of the first step, which has no measurement yet, and the others."""
    costs, timing, _options = design
    return isinstance(costs, DualRateCosts) or (isinstance(costs, LarsenCosts) and timing.M == timing.N)


def is_tight(loaded: Loaded) -> bool | None:
    """Whether a tick below the least speed something is missed with all tasks released together at one of the steps;
    None where the work is too much."""
    (costs, timing, options), tasks = loaded
    speed, binding = least_speed(costs, timing, options, tasks)
    slower = speed - Fraction(1, search_resolution(costs, options, tasks))
    if binding == "load":
        return None
    whole = (ceil(max(task.jitter for task in tasks) / timing.N) + timing.M // timing.N) * timing.N
    for step in range(whole, whole + 2 * timing.N):  # of two cycles, for in the first an update may be missing
        together = [replace(task, offset=step - task.jitter) for task in tasks]
        if simulate(costs, timing, slower, cycles_of(together, timing.N), options, together).misses:
            return True
    return False


@settings(max_examples=12)
@given(with_tasks(plain=True).filter(lambda loaded: not is_bound(loaded[0])))
def test_a_tick_below_something_is_late_with_all_released_together_at_a_step(loaded: Loaded) -> None:
    assert is_tight(loaded) is not False


@pytest.mark.exhaust
@pytest.mark.parametrize("number", range(10))
def test_something_is_on_two_thousand_designs(number: int, record_property: Callable[[str, object], None]) -> None:
    """On all but a few of those where it is a bound."""
    examples, found = share_of(200), Counter[bool | None]()

    def law(loaded: Loaded) -> None:
        tight = is_tight(loaded)
        found[tight] += 1
        assert tight is not False or is_bound(loaded[0])

    seed(number)(settings(max_examples=examples)(given(with_tasks(plain=True))(law)))()
    record_property("designs", examples)
    record_property("of load", found[None])
    record_property("not tight", found[False])
    assert found[False] <= 0.15 * examples + 3 * (0.15 * 0.85 * examples) ** 0.5


restart_is_no_landing = Design(DualRateCosts(1, 2, 1, 1, 0, 1), Timing(2, 0, 2), Options(cpus=2))
lands_before_l = Design(DualRateCosts(1, 3, 2, 1, 0, 2), Timing(3, 0, 3), Options())


@settings(max_examples=60)
@example(restart_is_no_landing)
@example(lands_before_l)
@given(designs)
def test_without_tasks_it_is_the_closed_form(design: Design) -> None:
    """With next-step feedback; a correction that is its own job counts from the start of its step on."""
    costs, timing, options = design
    speed = least_speed(costs, timing, options).speed
    assert late_job(costs, timing, speed * Fraction(9999, 10000), options, ()) is not None
    if options.feedback == "next-step":
        assert late_job(costs, timing, speed, options, ()) is None
        assert worst_landing(costs, timing, speed, options, ()) == achieved_l(costs, timing, speed, options)


def test_corrections_count_in_no_step_but_those_in_which_they_may_come() -> None:
    """They land in step k + 2 = k, of 1 + 1; the HR job of step k + 1 is 2 alone. A task of 1
    and of the least priority, on the other processor, changes nothing."""
    costs, timing, options = restart_is_no_landing
    task = Task("log", Fraction(4), Fraction(1), 30, cpu=2)
    assert least_speed(costs, timing, options).speed == 2
    assert late_job(costs, timing, Fraction(2), options, [task]) is None
    assert worst_landing(costs, timing, Fraction(2), options, [task]) == 2


FAST, SLOW = Task("fast", Fraction(1), Fraction(6), 5), Task("slow", Fraction(3), Fraction(40), 15)


@pytest.mark.parametrize("timing", [Timing(2, 1, 4), Timing(2, 3, 5), Timing(3, 3, 5), Timing(1, 2, 4)])
@pytest.mark.parametrize("gain", [pytest.param(0, marks=pytest.mark.exhaust), 6])
@pytest.mark.parametrize("task", [FAST, SLOW])
def test_with_several_on_their_way_it_holds_at_each_phase_of_a_grid(timing: Timing, gain: int, task: Task) -> None:
    """Eighths of a step, over a time after which the schedule repeats; it lands no later than is said."""
    costs = DualRateCosts(*map(Fraction, (10, 14, 3, 8, gain, 11)))
    options = Options(gain="precomputed" if gain else "at-update")
    speed = least_speed(costs, timing, options, [task]).speed
    latest = worst_landing(costs, timing, speed, options, [task])
    assert latest is not None
    for eighth in range(8 * int(task.period)):
        at = [replace(task, offset=Fraction(eighth, 8))]
        schedule = simulate(costs, timing, speed, 24, options, at)
        assert schedule.misses == 0
        assert max(schedule.achieved) <= latest


@pytest.mark.exhaust
@pytest.mark.parametrize("task", [FAST, SLOW])
def test_a_landing_beyond_the_next_measurement_asks_for_no_more_than_one_before_it(task: Task) -> None:
    costs = DualRateCosts(*map(Fraction, (10, 14, 3, 8, 0, 41)))
    speeds = [least_speed(costs, Timing(4, 2, L), tasks=[task]).speed for L in (3, 4, 5, 7, 9)]
    assert speeds == sorted(speeds, reverse=True)
    assert speeds[-1] < speeds[1]


@pytest.mark.exhaust
def test_on_a_processor_of_their_own_lr_jobs_that_pile_up_are_too_much() -> None:
    """21 in each step, and for the correction that is missing two more."""
    costs, task = DualRateCosts(*map(Fraction, (60, 5, 2, 3, 13, 5))), Task("a", Fraction(1), Fraction(8), 15)
    options, timing = Options(gain="precomputed", cpus=2), Timing(1, 0, 2)
    speed = least_speed(costs, timing, options, [task]).speed
    assert simulate(costs, timing, speed, 60, options, [replace(task, offset=Fraction(0))]).misses == 0
    assert speed > 21


CONTROL = Task("control", Fraction(4), Fraction("0.6"), 5)
ISSUE = Timing(40, 13, 40)
LARSEN = select(load_costs("steffes2014"), "larsen", Options())


def test_a_control_law_whose_phase_is_known_may_need_less() -> None:
    """Larsen's update takes 0.66 + 0.81, in step 13 of 40: a task of 0.6 in each fourth step from 0 never meets it."""
    assert least_speed(LARSEN, ISSUE, tasks=[CONTROL]) == (Fraction("2.07"), "hr")
    assert least_speed(LARSEN, ISSUE, tasks=[replace(CONTROL, offset=Fraction(1))]) == (Fraction("2.07"), "hr")
    assert least_speed(LARSEN, ISSUE, tasks=[replace(CONTROL, offset=Fraction(0))]) == (Fraction("1.47"), "hr")


def test_a_simulation_releases_tasks_together_where_it_is_worst() -> None:
    (control,) = at_worst_phase(LARSEN, ISSUE, Fraction(2), Options(), [CONTROL])
    assert control.start == 13 % 4
    late = [
        CONTROL,
        replace(CONTROL, name="telemetry", period=Fraction(20), deadline=Fraction(20), jitter=Fraction(15)),
    ]
    control, telemetry = at_worst_phase(LARSEN, ISSUE, Fraction(3), Options(), late)
    assert (control.start, telemetry.start) == (53 % 4, 53 - 15)


def test_a_task_of_any_phase_is_simulated_from_the_first_cycle_on_beside_one_of_a_given_phase() -> None:
    given_one = Task("given", Fraction(7), Fraction("0.1"), 4, offset=Fraction(1))
    speed = least_speed(LARSEN, ISSUE, tasks=[given_one, CONTROL]).speed
    schedule = simulate(LARSEN, ISSUE, speed, 3, tasks=[given_one, CONTROL])
    assert schedule.responses["task:control"].releases == 30


def test_a_task_of_any_phase_is_simulated_from_the_start_on_as_often_as_its_load_says() -> None:
    """Released with step 13 at the latest response, and nine times in each 36 steps before."""
    schedule = simulate(LARSEN, ISSUE, Fraction("2.07"), 3, tasks=[CONTROL])
    assert schedule.responses["task:control"].releases == 30
    assert schedule.responses["hr"].worst == schedule.period
    assert schedule.utilization == loads(LARSEN, ISSUE, Fraction("2.07"), tasks=[CONTROL])[0]


@settings(max_examples=15)
@given(with_tasks(), st.fractions(Fraction(9, 10), Fraction(11, 10), max_denominator=1000))
def test_it_takes_integers_of_any_size(loaded: Loaded, share: Fraction) -> None:
    """Costs of 10^17 times as many units, at a speed that is as much higher."""
    (costs, timing, options), tasks = loaded
    many = 10**17
    scaled = converted(costs, lambda cost: Fraction(cost) * many)
    of_scaled = replace(options, context_switch=options.context_switch * many)
    scaled_tasks = [replace(task, cost=task.cost * many) for task in tasks]
    speed = max(loads(costs, timing, Fraction(1), options, tasks)) * share * Fraction(3, 2)
    for find in (late_job, worst_landing):
        small = find(costs, timing, speed, options, tasks)
        assert find(scaled, timing, speed * many, of_scaled, scaled_tasks) == small


def test_earliest_deadline_first_on_two_processors_is_refused_by_name() -> None:
    costs = MultirateCosts(Fraction(1), Fraction(1))
    task, options = Task("control", Fraction(2), Fraction(1), 5), Options(policy="edf", cpus=2)
    with pytest.raises(InputError, match=r"task 'control' may have any phase.*policy edf on two processors: give each"):
        least_speed(costs, Timing(4, 0, 2), options, [task])
    assert least_speed(costs, Timing(4, 0, 2), options, [replace(task, offset=Fraction(0))]).speed > 1


# ------------------------------------------------------------------------------------------------------- by hand

UNITS = 1000
"""Cost units in an HR period; a filter that takes next to nothing stands behind the tasks."""

NOTHING = StandardCosts(Fraction(1), Fraction(1))


def task_of(priority: int, cost: int, period: int, **more: int | bool) -> Task:
    """Of times in cost units."""
    times = {key: Fraction(value, UNITS) if key in ("jitter", "deadline") else value for key, value in more.items()}
    return Task(f"t{priority}", Fraction(period, UNITS), Fraction(cost), priority, **times)


def worst(tasks: Sequence[Task], options: Options = Options()) -> list[int]:
    """Worst response times from when each should have been released, in cost units; more than the deadline where it is
    late."""
    design = phased(NOTHING, Timing(1, 0, 1), Fraction(UNITS), options, tasks)
    ticks = Fraction(design.period, UNITS)
    by_kind = {found.kind: found for found in finishes(design)}
    late = [by_kind[f"task:{task.name}"] for task in tasks]
    return [ceil(max(found.at - found.due) / ticks + task.due * UNITS) for task, found in zip(tasks, late, strict=True)]


def alone(tasks: Sequence[Task], until: int) -> list[Response]:
    """The tasks all released at 0, with nothing beside them."""
    sources = [TaskSource(replace(task, offset=Fraction(0)), Fraction(UNITS), 1) for task in tasks]
    processor = Processor(sources, UNITS, until, Platform(1, 0, "fixed"))
    processor.run()
    responses = processor.schedule().responses
    return [responses[f"task:{task.name}"] for task in tasks]


@pytest.mark.parametrize(
    ("times", "expected"),
    [
        ([(3, 7), (3, 12), (5, 20)], [3, 6, 20]),
        ([(20, 100), (40, 150), (100, 350)], [20, 60, 240]),
    ],
    ids=["burns", "lehoczky"],
)
def test_response_times_are_those_of_the_textbooks(times: list[tuple[int, int]], expected: list[int]) -> None:
    """Rate monotonic. A. Burns and A. Wellings, Real-Time Systems and Programming Languages: 3, 6, 20. J. Lehoczky, L.
    Sha and Y. Ding, The rate monotonic scheduling algorithm, 1989: 240."""
    tasks = [task_of(priority, *time) for priority, time in enumerate(times)]
    assert worst(tasks) == expected
    assert [figures.worst for figures in alone(tasks, 20_000)] == expected


def test_the_worst_job_need_not_be_the_first_of_a_busy_period() -> None:
    """J. Lehoczky, Fixed priority scheduling of periodic task sets with arbitrary deadlines, 1990: of 26/70 and 62/100
    the jobs of the second respond after 114, 102, 116, 104, 118, 106, 94."""
    tasks = [task_of(1, 26, 70), task_of(2, 62, 100)]
    figures = alone(tasks, 700)[1]
    assert (figures.worst, figures.misses, figures.finished) == (118, 6, 7)
    assert worst(tasks)[1] > 100


def test_what_liu_and_layland_leave_out_is_late() -> None:
    """G. Buttazzo, Hard Real-Time Computing Systems: 2/5 and 4/7, late by 1 with rate monotonic priorities; not with
    earliest deadline first."""
    tasks = [task_of(1, 2, 5), task_of(2, 4, 7)]
    first = alone(tasks, 8)[1]
    assert (first.worst, first.worst_lateness) == (8, 1)
    assert worst(tasks) == [2, 8]
    timing = Timing(1, 0, 1)
    assert late_job(NOTHING, timing, Fraction(UNITS), Options(), tasks) == "task:t2"
    assert late_job(NOTHING, timing, Fraction(UNITS), Options(policy="edf"), tasks) is None


def test_a_job_that_comes_late_delays_its_own_and_those_behind_it() -> None:
    """The first of 1 every 4, late by 2, comes at 0, the next at 2: one of 2 behind it is done at 4, and with its own
    jitter of 1 that is 5 after it should have come."""
    assert worst([task_of(1, 1, 4), task_of(2, 2, 10)]) == [1, 3]
    assert worst([task_of(1, 1, 4, jitter=2), task_of(2, 2, 10)]) == [3, 4]
    assert worst([task_of(1, 1, 4, jitter=2), task_of(2, 2, 10, jitter=1)]) == [3, 5]


def test_a_job_that_is_not_preempted_delays_those_before_it_and_not_itself() -> None:
    """1 every 5 and 1 every 8, behind them 4 every 20: it begins at 2 and is done at 6; preempted at 5, at 7. The
    others wait for all of it: 4 + 1, and 4 + 1 + 1 with one that comes at 5."""
    urgent = [task_of(1, 1, 5), task_of(2, 1, 8)]
    assert worst([*urgent, task_of(3, 4, 20)]) == [1, 2, 7]
    assert worst([*urgent, task_of(3, 4, 20, preemptive=False)]) == [5, 7, 6]


def test_a_shorter_deadline_and_jitter_leave_less_time() -> None:
    """A step of 2 and a task of 3 in it: 5; in half of it 3 / (1/2); where it may come a quarter late, 3 / (1/4)."""
    half, quarter = Fraction(1, 2), Fraction(1, 4)
    for policy in ("fixed", "edf"):
        for deadline, jitter, speed in ((None, Fraction(0), 5), (half, Fraction(0), 6), (half, quarter, 12)):
            task = Task("control", Fraction(1), Fraction(3), 5, jitter=jitter, deadline=deadline)
            assert least_speed(NOTHING, Timing(1, 0, 1), Options(policy=policy), [task]).speed == speed
