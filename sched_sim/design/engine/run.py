"""Runs plans in machine code: the arrays around `event_loop`, and the schedule that comes out."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from sched_sim.compiled import compiled
from sched_sim.design.engine.codes import FIRST_TASK
from sched_sim.design.engine.event_loop import CARRY, simulate_each
from sched_sim.design.engine.plan import Plan
from sched_sim.design.engine.records import Cpu, Figures, Job, State, TaskRow
from sched_sim.schedule.outcome import Response, Schedule
from sched_sim.schedule.tasks import TaskSource

if TYPE_CHECKING:
    from sched_sim.design.engine.records import Numbers

ROOM = 64
"""Jobs unfinished at once that there is room for at first; where that was not enough, MORE times as many."""

MORE = 8


def _record(of: type) -> np.dtype[np.void]:
    return np.dtype([(name, np.int64) for name in of.__annotations__], align=True)


PLAN, STATE, CPU, JOB, TASK, FIGURES = map(_record, (Plan, State, Cpu, Job, TaskRow, Figures))

Records: TypeAlias = NDArray[np.void]

FILTER_KINDS = ("hr", "hr_update", "lr_gain", "lr_propagate", "lr_step", "lr_update")


class Outcome(NamedTuple):
    """Of each plan a row. states: STATE; figures: FIGURES of each kind of job; landed, log: as of a `Run`."""

    states: Records
    figures: Records
    landed: Numbers
    log: Numbers


def run_plans(plans: Sequence[Plan], tasks: Sequence[Sequence[TaskSource]], log: int = 0) -> Outcome:
    """tasks: of each plan, the same but for their times. log: how many jobs of the last plan to keep."""
    in_numbers, cycles = np.array(plans, PLAN), max(plan.cycles for plan in plans)
    rows = np.array([_task_rows(of_plan) for of_plan in tasks], TASK).reshape(len(plans), -1)
    outcome = Outcome(
        np.empty(len(plans), STATE),
        np.empty((len(plans), FIRST_TASK + rows.shape[1]), FIGURES),
        np.empty((len(plans), cycles), np.int64),
        np.empty((log, 4), np.int64),
    )
    left, room = np.arange(len(plans)), ROOM
    while left.size:
        outcome.states[left] = outcome.figures[left] = 0
        compiled(simulate_each)(
            in_numbers,
            outcome.states,
            np.zeros(2, CPU),
            np.zeros(room, JOB),
            np.zeros(room, np.int64),
            np.zeros(4, np.int64),
            np.zeros((5, room), np.int64),
            np.zeros((5, 2), np.int64),
            np.zeros((3, 2 * ROOM + room + rows.shape[1], 3), np.int64),
            rows.copy(),
            outcome.figures,
            outcome.landed,
            outcome.log,
            left,
        )
        left, room = left[outcome.states["full"][left] == 1], room * MORE
    return outcome


def _task_rows(tasks: Sequence[TaskSource]) -> list[tuple[int, ...]]:
    names = sorted(source.task.name for source in tasks)
    return [
        (
            FIRST_TASK + names.index(source.task.name),
            source.task.priority,
            source.task.cpu - 1,
            source.task.preemptive,
            source.period,
            source.deadline,
            source.cost,
            source.nominal,
            source.next_release,
            0,
        )
        for source in tasks
    ]


def kinds_of(tasks: Sequence[TaskSource]) -> list[str]:
    return [*FILTER_KINDS, *(f"task:{name}" for name in sorted(source.task.name for source in tasks))]


def schedule_of(plan: Plan, kinds: Sequence[str], outcome: Outcome, number: int = 0) -> Schedule:
    """That of the plan of this number."""
    state = outcome.states[number]
    responses = {}
    for kind, of_kind in zip(kinds, outcome.figures[number].tolist(), strict=True):
        releases, finished, worst, total, misses, lateness, preemptions, carries = of_kind
        if releases:
            total += carries * CARRY
            responses[kind] = Response(releases, finished, worst, total, misses, lateness, preemptions)
    first = int(state["first_kind"])
    at, cycles = (each.tolist() for each in np.unique(outcome.landed[number], return_counts=True))
    return Schedule(
        period=plan.period,
        horizon=plan.horizon,
        cpus=plan.cpus,
        busy=int(state["busy_ticks"]),
        responses=responses,
        first_miss=None if first < 0 else (kinds[first], bool(state["first_held"])),
        instants=int(state["instants"]),
        achieved=Counter({L: count for L, count in zip(at, cycles, strict=True) if L >= 0}),
    )
