"""Every outcome of the simulation, each with its probability, gives what the exact probability says."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, assume, given, seed, settings
from hypothesis import strategies as st

from sched_sim.design.options import Options
from sched_sim.design.pieces import (
    CarriedGainCosts,
    CloneInFlightCosts,
    DualRateCosts,
    JobCosts,
    LarsenCosts,
    RecalculateCosts,
    StandardCosts,
)
from sched_sim.design.times import Instants
from sched_sim.design.timing import Timing
from sched_sim.probability.cost_distribution import CostDistribution
from sched_sim.probability.exact import probabilities
from sched_sim.probability.outcome import Bounds, Probabilities
from sched_sim.schedule.tasks import Task
from tests.drawn_costs import Seen, all_runs, pieces, simulated
from tests.exhaust import share_of

T = 30
c = CostDistribution.certain
URGENT = Task("urgent", period=Fraction(3, 2), cost=Fraction(5), priority=5, offset=Fraction(1, 2))
BETWEEN = Task("between", period=Fraction(3), cost=Fraction(5), priority=15, offset=Fraction(1, 3))
EQUAL = Task("equal", period=Fraction(1, 2), cost=Fraction(4), priority=10, offset=Fraction(0))


def often(usual: int, other: int, share: float = 0.5) -> CostDistribution:
    return CostDistribution.of_weights([(Fraction(usual), 1 - share), (Fraction(other), share)])


CASES: Mapping[str, tuple[Any, ...]] = {
    "an HR job may overrun": (
        DualRateCosts(often(10, 31, 0.25), c(10), c(1), c(4), c(0), often(16, 17)),
        Timing(2, 0, 1),
        3,
    ),
    "each piece varies": (
        DualRateCosts(often(10, 31, 0.25), c(9), often(1, 3), c(4), c(0), often(16, 17)),
        Timing(3, 1, 2),
        2,
    ),
    "precomputed gain": (
        DualRateCosts(c(10), often(9, 15, 0.25), c(2), often(4, 6), c(3), often(16, 37)),
        Timing(3, 1, 2),
        3,
        Options(gain="precomputed", lr_propagate_by="l"),
    ),
    "same-step feedback": (
        DualRateCosts(often(10, 31, 0.25), c(9), c(12), c(4), c(0), often(16, 27)),
        Timing(3, 1, 1),
        2,
        Options(feedback="same-step"),
    ),
    "several on their way": (
        DualRateCosts(c(9), often(10, 20, 0.25), c(2), c(14), c(0), often(26, 37)),
        Timing(2, 3, 5),
        4,
    ),
    "at uneven intervals": (
        DualRateCosts(c(9), often(10, 20, 0.25), c(2), c(14), c(0), often(26, 37)),
        Timing(2, 3, 5, Instants(Fraction(5, 2), Fraction(5, 2))),
        4,
    ),
    "two processors": (
        DualRateCosts(c(9), often(10, 20, 0.25), often(2, 5), c(14), c(0), often(26, 37)),
        Timing(2, 1, 2),
        2,
        Options(cpus=2),
    ),
    "a more urgent task": (
        DualRateCosts(often(10, 25, 0.25), c(9), c(2), c(4), c(0), often(16, 27)),
        Timing(2, 1, 2),
        2,
        Options(),
        {URGENT: often(5, 9)},
    ),
    "a task between": (
        DualRateCosts(often(10, 25, 0.25), c(9), c(4), c(4), c(0), often(16, 27)),
        Timing(3, 1, 2),
        2,
        Options(),
        {URGENT: c(5), BETWEEN: often(5, 19)},
    ),
    "an equally urgent task": (
        DualRateCosts(often(10, 25, 0.25), c(9), c(4), c(4), c(0), often(16, 27)),
        Timing(3, 1, 2),
        2,
        Options(),
        {EQUAL: c(4)},
    ),
    "standard": (StandardCosts(often(10, 31, 0.25), often(15, 29)), Timing(3, 0, 0), 2),
    "recalculate": (RecalculateCosts(often(10, 31, 0.25), often(5, 9), often(4, 8, 0.25)), Timing(3, 2, 2), 1),
    "recalculate, several on their way": (
        RecalculateCosts(often(10, 14, 0.25), c(5), often(4, 8, 0.25)),
        Timing(2, 3, 3),
        2,
    ),
    "larsen": (LarsenCosts(often(10, 21, 0.25), often(25, 39), often(4, 18, 0.25)), Timing(4, 3, 3), 2),
    "clone, several on their way": (
        CloneInFlightCosts(often(10, 31, 0.25), often(5, 9), c(3), c(14), c(1), c(2)),
        Timing(2, 3, 3),
        3,
    ),
    "carried-gain with a task": (
        CarriedGainCosts(often(10, 31, 0.25), often(5, 9), c(3), often(14, 18, 0.25)),
        Timing(3, 2, 2),
        2,
        Options(),
        {URGENT: c(5)},
    ),
    "recalculate and tasks": (
        RecalculateCosts(often(10, 25, 0.25), c(5), c(4)),
        Timing(3, 1, 1),
        2,
        Options(),
        {URGENT: c(5), BETWEEN: often(5, 25)},
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_every_outcome_of_the_simulation(name: str) -> None:
    compare(*CASES[name])


def compare(
    costs: JobCosts[Any],
    timing: Timing,
    cycles: int,
    options: Options = Options(),
    of_tasks: Mapping[Task, CostDistribution] = {},
) -> None:
    tasks = list(of_tasks)
    task_costs = {task.name: law for task, law in of_tasks.items()}
    found = probabilities(costs, timing, T, cycles, options, tasks, task_costs=task_costs, debt=3)
    assert found.exact
    steps = timing.taken.step(cycles)
    laws = pieces(costs) | task_costs
    runs = [
        (float(share), seen)
        for share, seen in all_runs(laws, lambda draw: simulated(costs, timing, T, steps, draw, options, tasks))
    ]
    assert sum(share for share, _ in runs) == pytest.approx(1)
    landings_are_as_seen(found, runs, timing, steps)
    misses_are_as_seen(found, runs, timing, steps, tasks)
    if isinstance(costs, DualRateCosts):
        low_rate_is_as_seen(found, runs, timing, steps, options)


def is_exact(bounds: Bounds, share: float, behind: float) -> None:
    """But for what is not followed, of which the simulation is too short to see anything."""
    assert bounds.lower == pytest.approx(share, abs=1e-12)
    assert bounds.lower <= bounds.upper <= bounds.lower + behind + 1e-12


Runs = Sequence[tuple[float, Seen]]


def landings_are_as_seen(found: Probabilities, runs: Runs, timing: Timing, steps: int) -> None:
    landed: Counter[tuple[int, int]] = Counter()
    for share, seen in runs:
        for cycle, lands in seen.landed.items():
            landed[cycle, lands] += share  # type: ignore[assignment]  # a probability
    for (cycle, lands), share in landed.items():
        is_exact(found.cycles[cycle].landing[lands], share, found.cycles[cycle].behind)
    for cycle, figures in enumerate(found.cycles):
        for lands in figures.landing:
            assert (cycle, lands) in landed or timing.taken.step(cycle) + lands >= steps


def misses_are_as_seen(found: Probabilities, runs: Runs, timing: Timing, steps: int, tasks: Sequence[Task]) -> None:
    missed: defaultdict[tuple[str, int], float] = defaultdict(float)
    released: Counter[tuple[str, int]] = Counter()
    for step in range(steps):
        cycle = timing.taken.before(step + 1) - 1
        released["hr", cycle] += 1
        for share, seen in runs:
            missed["hr", cycle] += share * seen.missed("hr", step)
    for task in tasks:
        kind, number = f"task:{task.name}", 0
        while (start := task.start + number * task.period) + task.due <= steps:
            released[kind, int(start) // timing.N] += 1
            for share, seen in runs:
                missed[kind, int(start) // timing.N] += share * seen.missed(kind, number)
            number += 1
        ends = start
        for cycle in range(int(ends) // timing.N, len(found.cycles)):
            released.pop((kind, cycle), None)  # its last jobs are not seen to the end
    for (kind, cycle), jobs in released.items():
        share = missed[kind, cycle] / jobs
        is_exact(found.cycles[cycle].misses[kind], share, found.cycles[cycle].behind)


def low_rate_is_as_seen(found: Probabilities, runs: Runs, timing: Timing, steps: int, options: Options) -> None:
    by_l = options.lr_propagate_by == "l" or not timing.M
    update_due = timing.L + (options.feedback == "same-step")
    update = "hr_update" if options.feedback == "same-step" else "lr_update"
    early = "lr_gain" if options.gain == "precomputed" else "lr_propagate"
    for kind, job, due in ("lr_propagate", early, update_due if by_l else timing.M), ("lr_update", update, update_due):
        for cycle, figures in enumerate(found.cycles):
            k = timing.taken.step(cycle)
            if k + due <= steps:
                share = sum(share for share, seen in runs if seen.missed(job, k))
                is_exact(figures.misses[kind], share, figures.behind)
    response, all_ended = np.zeros(steps * T + 1), True
    for share, seen in runs:
        first = seen.ended["lr_update"].get(0)
        all_ended = all_ended and first is not None
        if first is not None:
            response[first[1] - first[0]] += share
    if all_ended:
        tail = found.cycles[0].responses["lr_update"].lower
        above = [response[number * T // found.ticks + 1 :].sum() for number in range(len(tail))]
        assert tail == pytest.approx(above, abs=1e-12)


MOST_RUNS = 1024


@st.composite
def small_designs(draw: st.DrawFn) -> tuple[Any, ...]:
    """Of which few executions vary."""
    kind = draw(st.sampled_from([DualRateCosts, DualRateCosts, RecalculateCosts, LarsenCosts, CloneInFlightCosts]))
    names = [one.name for one in fields(kind) if one.name != "lacks"]
    varies = draw(st.sets(st.sampled_from(names), max_size=2))
    values = {name: draw(st.integers(0, 30)) for name in names} | {"lr_gain": draw(st.sampled_from([0, 0, 7]))}
    laws = {name: often(values[name], values[name] + 17, 0.25) if name in varies else c(values[name]) for name in names}
    N, M = draw(st.integers(1, 3)), draw(st.integers(0, 4))
    of_tasks = {URGENT: often(3, 9) if draw(st.booleans()) else c(5)} if draw(st.booleans()) else {}
    if kind is not DualRateCosts:
        M = min(M, N) if kind is LarsenCosts else M
        return kind(**laws), Timing(N, M, M), draw(st.integers(1, 2)), Options(), of_tasks
    precomputed = laws["lr_gain"] != c(0)
    M = min(M, N) if precomputed else M
    feedback, cpus = draw(st.sampled_from([("next-step", 1), ("next-step", 1), ("next-step", 2), ("same-step", 1)]))
    options = Options(
        feedback=feedback,
        cpus=cpus,
        lr_propagate_by=draw(st.sampled_from(["m", "l"])),
        gain="precomputed" if precomputed else "at-update",
    )
    if (feedback, cpus) != ("next-step", 1):  # else it is not followed
        high = max(laws["hr"].worst, laws["hr_restart"].worst) if cpus == 2 else 0
        assume(high + 5 * laws["hr_update"].worst <= T)
    if (feedback, cpus) != ("next-step", 1):
        of_tasks = {}
    return kind(**laws), Timing(N, M, M + draw(st.integers(1, 3))), draw(st.integers(1, 3)), options, of_tasks


@pytest.mark.exhaust
@pytest.mark.parametrize("part", range(10))
def test_every_outcome_of_many_designs(part: int, record_property: Callable[[str, object], None]) -> None:
    count, seen = share_of(200), Counter[str]()

    @seed(part)
    @settings(max_examples=count, phases=[Phase.generate], suppress_health_check=[*HealthCheck])
    @given(small_designs())
    def law(design: tuple[Any, ...]) -> None:
        costs, timing, cycles, options, of_tasks = design
        drawn = simulated(
            costs, timing, T, timing.taken.step(cycles), first_of(costs, of_tasks, seen), options, of_tasks
        )
        assume(drawn is not None and 2 ** seen.total() <= MOST_RUNS)
        compare(costs, timing, cycles, options, of_tasks)

    law()
    record_property("designs", count)


def first_of(costs: Any, of_tasks: Mapping[Task, CostDistribution], seen: Counter[str]) -> Callable[[str], int]:
    """Draws the first value, and counts what might have been another."""
    laws = pieces(costs) | {task.name: law for task, law in of_tasks.items()}
    seen.clear()

    def draw(name: str) -> int:
        seen[name] += len(laws[name].values) > 1
        return int(laws[name].values[0])

    return draw
