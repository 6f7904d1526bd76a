"""Random designs of every method with everything that a simulation takes, many to the second: hypothesis draws 200."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from random import Random
from typing import NamedTuple

from sched_sim.design.method import Method
from sched_sim.design.methods import method_of
from sched_sim.design.options import Options
from sched_sim.design.pieces import (
    AugmentationCosts,
    CarriedGainInFlightCosts,
    CloneInFlightCosts,
    CloneSplitCosts,
    DelayedHorizonCosts,
    DualRateCosts,
    FuseAsFreshCosts,
    JobCosts,
    LarsenInFlightCosts,
    MultirateCosts,
    Px4PredictorCosts,
    RecalculateCosts,
    RobustCosts,
    StandardCosts,
    converted,
)
from sched_sim.design.times import Instants
from sched_sim.design.timing import Timing
from sched_sim.schedule.tasks import Task

PIECES = {
    StandardCosts: 2,
    RecalculateCosts: 3,
    LarsenInFlightCosts: 6,
    CloneInFlightCosts: 6,
    CloneSplitCosts: 4,
    CarriedGainInFlightCosts: 6,
    Px4PredictorCosts: 5,
    AugmentationCosts: 5,
    FuseAsFreshCosts: 2,
    MultirateCosts: 2,
    RobustCosts: 2,
    DelayedHorizonCosts: 4,
    DualRateCosts: 6,
}


class Simulated(NamedTuple):
    """Arguments of `simulate`."""

    costs: JobCosts
    timing: Timing
    speed: Fraction
    cycles: int
    options: Options
    tasks: tuple[Task, ...]


def random_design(random: Random) -> Simulated:
    """Costs and times in whole ticks of a cost unit, many equal or none, so that much happens at one instant; in a
    tenth of the designs so many ticks that a horizon has 50 bits or more."""
    kind = random.choice([*PIECES, DualRateCosts, DualRateCosts, DualRateCosts, DelayedHorizonCosts])
    most = random.choice([2, 6, 40])
    some = random.choice([1, 0.9, 0.9, 0.3])
    works = [random.randint(1, most) if random.random() < some else 0 for _ in range(PIECES[kind])]
    if kind is DualRateCosts and random.random() < 0.5:
        works[4] = 0
    costs = kind(*works)
    same_step = kind is DualRateCosts and random.random() < 0.4
    feedback = "same-step" if same_step else "next-step"
    options = Options(
        lr_propagate_by=random.choice(["m", "l"]),
        feedback=feedback,
        gain="precomputed" if kind is DualRateCosts and works[4] else "at-update",
        cpus=random.choice([1, 1, 2]),
        context_switch=Fraction(random.choice([0, 0, 1, 3])),
        policy=random.choice(["fixed", "fixed", "edf"]),
    )
    timing = _timing(random, method_of(costs), kind, feedback)
    load = random.choice([0.4, 0.8, 0.95, 1.0, 1.1, 2.0])
    speed = Fraction(max(1, round(sum(works) / random.choice([1, 2, 3]) / load)))
    tasks = tuple(_task(random, name, options.cpus, most) for name in random.choice(["", "", "a", "ba", "cab"]))
    design = Simulated(costs, timing, speed, random.randint(1, 12), options, tasks)
    return _times(design, 2**40) if random.random() < 0.1 else design


def _times(design: Simulated, factor: int) -> Simulated:
    """With so many times as many ticks."""
    return design._replace(
        costs=converted(design.costs, lambda work: factor * work),
        speed=factor * design.speed,
        options=replace(design.options, context_switch=factor * design.options.context_switch),
        tasks=tuple(replace(task, cost=factor * task.cost) for task in design.tasks),
    )


def _timing(random: Random, method: Method, kind: type, feedback: str) -> Timing:
    N = random.choice([1, 2, 3, random.randint(1, 12)])
    law = method.law(feedback)
    if law.undelayed:
        return Timing(N, 0, random.randint(1, N))
    if law.several and random.random() < 0.5:
        M = random.randint(0, 4 * N)
        first = M + 1 if kind is DualRateCosts and feedback == "next-step" else M
        L = random.randint(first, first + 3 * N)
        if random.random() < 0.5:
            parts = random.randint(2, 5)
            return Timing(N, M, L, Instants(N + Fraction(random.randint(1, parts - 1), parts), Fraction(M)))
        return Timing(N, M, L)
    M = random.choice([0, random.randint(0, N - 1), N - 1])
    if kind is DelayedHorizonCosts or (kind is DualRateCosts and feedback == "next-step"):
        return Timing(N, M, random.randint(M + 1, N))
    if kind is DualRateCosts:
        return Timing(N, M, random.randint(M, N - 1))
    M = random.choice([M, N])
    return Timing(N, M, N)


def _task(random: Random, name: str, cpus: int, most: int) -> Task:
    period = random.choice([Fraction(1), Fraction(random.randint(1, 8), 2), Fraction(random.randint(1, 20))])
    deadline = period * random.choice([1, 1, Fraction(1, 2)])
    return Task(
        name,
        period,
        cost=Fraction(random.randint(1, most)),
        priority=random.choice([5, 10, 15, 20, 30]),
        offset=random.choice([Fraction(0), Fraction(random.randint(0, 30), 2)]),
        cpu=random.randint(1, cpus),
        jitter=random.choice([Fraction(0), deadline * Fraction(random.randint(0, 3), 4)]),
        deadline=deadline,
        preemptive=random.random() < 0.8,
    )
