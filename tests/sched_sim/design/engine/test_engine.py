"""Machine code and SimPy, which share no line of the rules, run every design to the same schedule, job by job."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from random import Random
from typing import Any

import numba
import pytest

from sched_sim.design.engine.run import kinds_of, run_plans, schedule_of
from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts, RecalculateCosts, StandardCosts
from sched_sim.design.simulate import at_worst_phase, in_ticks, simulate, simulated_steps
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.schedule import engine
from sched_sim.schedule.processor import Processor
from sched_sim.schedule.tasks import Task
from tests.exhaust import share_of
from tests.random_designs import PIECES, Simulated, random_design

FIGURE_3 = DualRateCosts(hr=63, hr_restart=4, hr_update=3, lr_propagate=41, lr_gain=0, lr_update=56)
TIMING = Timing(10, 4, 8)


def by_both(design: Simulated) -> Iterator[tuple[Any, ...]]:
    """By SimPy, then in machine code: the schedule, what landed when, and of each job that finished, in the order in
    which they did, kind, step, release and finish."""
    costs, timing, speed, cycles, options, tasks = design
    tasks = at_worst_phase(costs, timing, speed, options, tasks)
    landings: list[tuple[int, int]] = []
    schedule = simulate(*design, engine="simpy", on_landing=lambda cycle, L: landings.append((cycle, L)))
    finishes: list[tuple[str, int, int, int]] = []
    run, steps = in_ticks(costs, timing, speed, options, tasks), simulated_steps(costs, timing, cycles, options)
    Processor(
        [run.source(lambda _cycle, _L: None), *run.tasks],
        run.period,
        steps * run.period,
        run.platform,
        on_finish=lambda job, now: finishes.append((job.kind, job.step, job.release, now)),
    ).run()
    yield schedule, landings, finishes

    run = in_ticks(costs, timing, speed, options, tasks)
    plan = run.plan(steps, cycles)
    outcome, kinds = run_plans([plan], [run.tasks], log=len(finishes) + 1), kinds_of(run.tasks)
    landed = [(cycle, L) for cycle, L in enumerate(outcome.landed[0].tolist()) if L >= 0]
    finished = outcome.log[: outcome.states["logged"][0]].tolist()
    yield schedule_of(plan, kinds, outcome), landed, [(kinds[kind], *rest) for kind, *rest in finished]


def compared(seeds: range) -> tuple[int, int]:
    """How many jobs were the same, and in how many designs a deadline was missed."""
    jobs = missed = 0
    for seed in seeds:
        design = random_design(Random(seed))
        by_simpy, compiled = by_both(design)
        assert compiled == by_simpy, (seed, design)
        jobs += sum(response.releases for response in by_simpy[0].responses.values())
        missed += by_simpy[0].misses > 0
    return jobs, missed


def test_2000_random_designs_are_the_same_job_by_job() -> None:
    jobs, missed = compared(range(2000))
    assert jobs > 50_000
    assert 1000 < missed < 1900


@pytest.mark.exhaust
@pytest.mark.parametrize("part", range(40))
def test_a_million_random_designs_are_the_same_job_by_job(part: int, record_property: Any) -> None:
    designs = share_of(25_000)
    first = 10_000 + 25_000 * part
    jobs, missed = compared(range(first, first + designs))
    for name, count in (("designs", designs), ("jobs", jobs), ("designs with misses", missed)):
        record_property(name, count)


def test_random_designs_are_of_every_kind_and_have_everything() -> None:
    designs = [random_design(Random(seed)) for seed in range(2000)]
    assert {type(design.costs) for design in designs} == set(PIECES)
    options = [design.options for design in designs]
    tasks = [task for design in designs for task in design.tasks]
    flight = [design for design in designs if design.timing.M > design.timing.N]
    for several in (
        *([each for each in options if each.policy == policy] for policy in ("fixed", "edf")),
        [each for each in options if each.cpus == 2 and each.context_switch],
        [each for each in options if each.feedback == "same-step" and each.gain == "precomputed"],
        *(
            [design for design in flight if isinstance(design.costs, kind)]
            for kind in (DualRateCosts, RecalculateCosts)
        ),
        [design for design in flight if design.timing.instants],
        [task for task in tasks if task.jitter],
        [task for task in tasks if task.due < task.period],
        [task for task in tasks if not task.preemptive],
        [task for task in tasks if task.cpu == 2],
    ):
        assert len(several) >= 20


def test_work_that_piles_up_takes_as_much_room_as_it_needs() -> None:
    arguments = FIGURE_3, TIMING, Fraction(40), 2000
    by_simpy = simulate(*arguments, engine="simpy")
    assert by_simpy.responses["hr"].misses > 5000
    assert simulate(*arguments, engine="compiled") == by_simpy


def test_many_jobs_are_compiled_by_default_unless_only_simpy_can(monkeypatch: pytest.MonkeyPatch) -> None:
    ran = []
    monkeypatch.setattr(Processor, "run", lambda self: ran.append(self.horizon))
    for cycles, slices, expected in ((9, False, 1), (10, False, 0), (10, True, 1)):
        monkeypatch.setattr(engine, "MANY_JOBS", 100)
        ran.clear()
        simulate(FIGURE_3, TIMING, 78, cycles, keep_slices=slices)
        assert len(ran) == expected
    steps = []
    simulate(FIGURE_3, TIMING, 78, 10, on_progress=lambda done, of, _what: steps.append((done, of)))
    assert (ran, steps) == ([78 * 100], [(0, 100)])


@pytest.mark.parametrize(
    ("design", "asked", "said"),
    [
        ((FIGURE_3, TIMING, 78, 3), {"engine": "fast"}, "engine is 'fast': choose from auto, simpy, compiled"),
        (
            (FIGURE_3, TIMING, 78, 3),
            {"keep_slices": True},
            "engine compiled has no slices, of which traces are made: leave one of them out",
        ),
        (
            (FIGURE_3, TIMING, 78, 3),
            {"on_slice": print},
            "engine compiled has no slices, of which traces are made: leave one of them out",
        ),
        ((StandardCosts(1, Fraction(1, 10**18)), TIMING, 3, 3), {}, "do not fit into 64 bits; give engine simpy"),
        ((FIGURE_3, TIMING, Fraction(78 * 10**17 + 1, 10**17), 9), {}, "do not fit into 64 bits; give engine simpy"),
    ],
)
def test_what_machine_code_cannot_is_refused(design: Any, asked: Any, said: str) -> None:
    with pytest.raises(InputError, match=said):
        simulate(*design, **{"engine": "compiled", **asked})


def test_simpy_takes_over_where_64_bits_are_not_enough(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engine, "MANY_JOBS", 1)
    assert simulate(FIGURE_3, TIMING, Fraction(78 * 10**17 + 1, 10**17), 9).horizon > 2**63


def test_simpy_takes_over_where_numba_does_not_compile(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(numba.config, "DISABLE_JIT", 1)
    monkeypatch.setattr(engine, "MANY_JOBS", 1)
    assert simulate(FIGURE_3, TIMING, 78, 3) == simulate(FIGURE_3, TIMING, 78, 3, engine="simpy")
    with pytest.raises(InputError, match="NUMBA_DISABLE_JIT is set: unset it, or give engine simpy"):
        simulate(FIGURE_3, TIMING, 78, 3, engine="compiled")


@pytest.mark.parametrize("by", ["simpy", "compiled"])
def test_the_first_miss_of_equal_deadlines_is_of_the_most_urgent_then_the_first_released_then_by_name(by: Any) -> None:
    """All are due at the end of step 0, and nothing finishes by then."""

    def first(*tasks: Task) -> Any:
        return simulate(StandardCosts(100, 100), Timing(1, 0, 1), 10, 1, Options(), tasks, engine=by).first_miss

    def task(name: str, priority: int, release: Fraction = Fraction(0)) -> Task:
        return Task(name, 1 - release, 500, priority, release)

    assert first(task("a", 30), task("b", 5)) == ("task:b", False)
    assert first(task("a", 30), task("b", 20)) == ("hr", False)
    assert first(task("a", 5, Fraction(1, 2)), task("b", 5, Fraction(0))) == ("task:b", False)
    assert first(task("b", 5), task("a", 5)) == ("task:a", False)
