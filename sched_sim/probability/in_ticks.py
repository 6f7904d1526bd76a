"""Costs and times as whole ticks: exact where an HR period has few, else rounded to bins, down or up."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields
from fractions import Fraction
from math import ceil, floor, gcd, lcm
from typing import Any, Literal, NamedTuple

import numpy as np

from sched_sim.bounds import short
from sched_sim.design.pieces import JobCosts
from sched_sim.errors import InputError, option
from sched_sim.probability.cost_distribution import CostDistribution
from sched_sim.probability.law import Law
from sched_sim.probability.timeline import TaskInTicks
from sched_sim.schedule.tasks import Task

MOST_TICKS = 2_048
"""Of an HR period, with which costs are exact unless bins are asked for."""
BINS, BINS_OF_A_CYCLE = 512, 102_400
"""Where none are asked for: fewer where a measurement cycle has very many HR periods, for it takes their square."""
MOST_BINS = 16_384
LONGEST_COST = 2_000
"""HR periods that one piece of work may take."""

Rounded = Literal["down", "up"]


class Grid(NamedTuple):
    """ticks: of an HR period; unit: a cost of one tick; exact: whether all costs are whole ticks."""

    ticks: int
    unit: Fraction
    exact: bool


class Given(NamedTuple):
    """What is given. of_tasks: by name."""

    pieces: Mapping[str, CostDistribution]
    tasks: Sequence[Task]
    of_tasks: Mapping[str, CostDistribution]
    speed: Fraction

    @property
    def all(self) -> tuple[CostDistribution, ...]:
        return *self.pieces.values(), *self.of_tasks.values()


def pieces_of(costs: JobCosts[Any]) -> dict[str, CostDistribution]:
    """By the name of the field. Raises InputError for one that is no CostDistribution."""
    pieces = {}
    for field in fields(costs):
        value = getattr(costs, field.name)
        if isinstance(value, str):
            continue
        if not isinstance(value, CostDistribution):
            raise InputError(
                f"{type(costs).__name__}: {field.name} is {short(repr(value))}: give a CostDistribution, such as "
                f"CostDistribution.certain({field.name})"
            )
        pieces[field.name] = value
    return pieces


def grid_of(given: Given, N: int, bins: int | None) -> Grid:
    """Raises InputError where releases are no whole bins, or there are too many."""
    times = [time for task in given.tasks for time in (task.period, task.start, task.due)]
    least = lcm(*(time.denominator for time in times))
    costs = [value for distribution in given.all for value in distribution.values]
    if bins is None:
        wanted = [given.speed, given.speed / least, *costs]
        one = Fraction(1, lcm(*(value.denominator for value in wanted)))
        unit = gcd(*(int(value / one) for value in wanted)) * one
        ticks = given.speed / unit
        if ticks <= MOST_TICKS:
            return Grid(int(ticks), unit, exact=True)
        bins = ceil(min(BINS, BINS_OF_A_CYCLE // N + 1) / least) * least
    if bins > MOST_BINS and least <= MOST_BINS:
        raise InputError(f"{option('bins')} is {bins}: at most {MOST_BINS} are followed; give fewer")
    if bins % least or bins > MOST_BINS:
        raise InputError(
            f"{option('bins')} {bins} must be a multiple of {least}, at most {MOST_BINS}: tasks are released {least} "
            f"times within an HR period; round their periods and offsets"
        )
    unit = given.speed / bins
    return Grid(bins, unit, exact=all((cost / unit).denominator == 1 for cost in costs))


def law_of(distribution: CostDistribution, grid: Grid, rounded: Rounded, what: str) -> Law:
    """Raises InputError for a cost of very many HR periods."""
    to_whole = ceil if rounded == "up" else floor
    ticks = [to_whole(value / grid.unit) for value in distribution.values]
    if ticks[-1] > LONGEST_COST * grid.ticks:
        raise InputError(
            f"{what} takes up to {float(distribution.worst):g}, which is {ticks[-1] / grid.ticks:.3g} HR periods: at "
            f"most {LONGEST_COST} are followed; give a faster processor, or mend the cost: without a unit of its own "
            f"it is in that of the cost table"
        )
    mass = np.zeros(ticks[-1] + 1)
    np.add.at(mass, ticks, distribution.probabilities)
    return Law(mass)


def laws_of(given: Given, grid: Grid, rounded: Rounded) -> dict[str, Law]:
    return {name: law_of(piece, grid, rounded, name) for name, piece in given.pieces.items()}


def tasks_in_ticks(given: Given, grid: Grid, rounded: Rounded) -> list[TaskInTicks]:
    """The tasks, their times exact."""
    return [
        TaskInTicks(
            f"task:{task.name}",
            task.priority,
            int(task.start * grid.ticks),
            int(task.period * grid.ticks),
            int(task.due * grid.ticks),
            law_of(given.of_tasks[task.name], grid, rounded, f"task {task.name!r}"),
        )
        for task in given.tasks
    ]
