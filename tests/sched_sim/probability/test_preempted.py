"""Recalculate that HR jobs preempt, against every outcome of a scenario of one sensor."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import pytest

from sched_sim.design.pieces import RecalculateCosts
from sched_sim.design.timing import Timing
from sched_sim.probability.cost_distribution import CostDistribution
from sched_sim.probability.exact import probabilities
from sched_sim.scenario import source
from sched_sim.scenario.scenario import Scenario, Sensor
from sched_sim.schedule.jobs import step_at
from sched_sim.schedule.processor import Platform, Processor
from sched_sim.schedule.tasks import Task, TaskSource
from tests.drawn_costs import Draw, Seen, all_runs

T = 30
TASK = Task("t", period=Fraction(3, 2), cost=Fraction(5), priority=5, offset=Fraction(1, 2))
certain = CostDistribution.certain


def often(usual: int, other: int, share: float = 0.5) -> CostDistribution:
    return CostDistribution.of_weights([(Fraction(usual), 1 - share), (Fraction(other), share)])


@pytest.mark.parametrize(
    ("predict", "update", "timing", "cycles", "tasks"),
    [
        (certain(10), often(5, 40), Timing(3, 1, 2), 4, ()),
        (often(10, 20, 0.25), certain(9), Timing(3, 1, 2), 1, ()),
        (certain(10), often(10, 30), Timing(4, 2, 3), 4, ()),
        (certain(10), often(20, 61), Timing(2, 1, 3), 5, ()),
        (certain(8), often(5, 49), Timing(2, 0, 1), 5, (TASK,)),
    ],
    ids=["catches up", "predict varies", "at the end of a step", "waits and goes together", "with a task"],
)
def test_every_outcome_of_a_scenario(
    monkeypatch: pytest.MonkeyPatch,
    predict: CostDistribution,
    update: CostDistribution,
    timing: Timing,
    cycles: int,
    tasks: Sequence[Task],
) -> None:
    N, M, L = timing.N, timing.M, timing.L
    steps = N * cycles
    sensor = Sensor("s", every=N, delays=[M], land_by=L)
    costs = {"predict": [Fraction(1)], "correct.s": [Fraction(2)]}
    scenario = Scenario("one sensor", steps, Fraction(T), [sensor], costs)
    in_ticks = {name: [int(cost) for cost in several] for name, several in costs.items()}

    def run(draw: Draw) -> Seen:
        names = {1: "predict", 2: "update"}

        def total(samples: Sequence[int], _generator: Any, executions: int = 1) -> int:
            return sum(draw(names[samples[0]]) for _ in range(executions))

        monkeypatch.setattr(source, "total", total)
        seen = Seen()

        def ended(job: Any, now: int) -> None:
            seen.ended[job.kind][job.step] = job.release, now, job.deadline
            if job.kind == "correct s":
                seen.landed[job.step // N] = step_at(now, T) - job.step

        others = [TaskSource(task, Fraction(T), 1) for task in tasks]
        composed = source.ComposedFilter(scenario, in_ticks, T)
        Processor([composed, *others], T, steps * T, Platform(1, 0), None, ended).run()
        return seen

    landed: Counter[tuple[int, int]] = Counter()
    late: Counter[int] = Counter()
    for share, seen in all_runs({"predict": predict, "update": update}, run):
        for cycle in range(cycles):
            if cycle in seen.landed:
                landed[cycle, seen.landed[cycle]] += share  # type: ignore[assignment]  # a probability
            late[cycle] += share * (seen.landed.get(cycle, L + 1) > L)  # type: ignore[assignment]
    found = probabilities(RecalculateCosts(predict, update, predict), timing, T, cycles, tasks=tasks, preempted=True)
    assert found.exact
    assert len({lands for _, lands in landed}) > 1
    for (cycle, lands), share in landed.items():
        assert found.cycles[cycle].landing[lands].lower == pytest.approx(float(share), abs=1e-12)
    for cycle in range(cycles):
        if cycle * N + L < steps:
            assert found.cycles[cycle].late.lower == pytest.approx(float(late[cycle]), abs=1e-12)
