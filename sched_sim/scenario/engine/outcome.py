"""The outcome of a scenario that compiled code has simulated, from the jobs that finished and the memory at the end."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from itertools import pairwise
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from sched_sim.scenario.engine import memory as at
from sched_sim.scenario.engine.measured import Ints, Measured, measured
from sched_sim.scenario.engine.run import run
from sched_sim.scenario.kinds import correct_kind, gain_kind, loss_kind
from sched_sim.scenario.outcome import JobFigures, Outcome, SensorFigures, longest_wait
from sched_sim.scenario.workload import Workload
from sched_sim.schedule.clock import OnProgress
from sched_sim.schedule.outcome import Response, Schedule

Floats: TypeAlias = npt.NDArray[np.float64]

EXACT = 1 << 53
"""Whole numbers up to here are floats too."""


class Jobs(NamedTuple):
    """Of one kind: those that finished, in that order, and those that did not."""

    step: Ints
    release: Ints
    deadline: Ints
    end: Ints
    waiting_since: Ints
    due: Ints

    def lateness(self, horizon: int) -> Ints:
        """Of those that missed their deadlines."""
        late = self.end - self.deadline
        return np.append(late[late > 0], horizon - self.due[self.due <= horizon])

    def first_missed(self, horizon: int) -> tuple[int, int] | None:
        """The earliest deadline that was missed, and of the jobs that have it the earliest release."""
        late, unfinished = self.end > self.deadline, self.due <= horizon
        deadline = np.append(self.deadline[late], self.due[unfinished])
        if not deadline.size:
            return None
        release = np.append(self.release[late], self.waiting_since[unfinished])
        return int(deadline.min()), int(release[deadline == deadline.min()].min())


def run_compiled(work: Workload, on_progress: OnProgress | None = None) -> Outcome:
    """Of a workload that is not `too_large`."""
    found = measured(work.scenario, work.scenario.seed)
    memory, log = run(work, found, on_progress)
    jobs = _jobs(work, found, memory, log)
    priorities = _priorities(work)
    missed = {kind: first for kind, own in jobs.items() if (first := own.first_missed(work.horizon))}
    ranked = [(deadline, priorities[kind], release, kind) for kind, (deadline, release) in missed.items()]
    first_miss = min(ranked, default=None)
    busy = _busy(work, memory)
    schedule = _schedule(work, memory, jobs, sum(busy), None if first_miss is None else (first_miss[-1], False))
    figures = {kind: _figures(own, work) for kind, own in jobs.items()}
    earliest = None if first_miss is None else first_miss[0] / work.period
    return Outcome(figures, _sensors(work, found, jobs), schedule, earliest, busy)


def _jobs(work: Workload, found: Measured, memory: Ints, log: Ints) -> dict[str, Jobs]:
    """By kind."""
    finished, waiting = (_split(rows, len(work.kinds)) for rows in (log, unfinished(work, found, memory)))
    return {kind: Jobs(*finished[number], *waiting[number]) for number, kind in enumerate(work.kinds)}


def _split(rows: Ints, kinds: int) -> list[list[Ints]]:
    """The columns behind the first, which is the kind, by kind; their order stays."""
    own = rows[:, 0]
    order = np.argsort(own.astype(np.uint16), kind="stable")
    ends = np.cumsum(np.bincount(own, minlength=kinds))
    columns = [column[order] for column in rows.T[1:]]
    return [[column[begin:end] for column in columns] for begin, end in pairwise([0, *ends.tolist()])]


def unfinished(work: Workload, found: Measured, memory: Ints) -> Ints:
    """Kind, release and deadline of each. Of corrections that go together, or wait, only the measurements tell."""
    jobs = memory[memory[at.FIRST_JOB] :].reshape(-1, at.JOB)
    jobs = jobs[jobs[:, at.KIND] != at.NO_KIND]
    columns = (at.KIND, at.RELEASE, at.DEADLINE)
    if work.scenario.late == "dual-rate":
        low_rate: Ints = jobs[:, columns]
        return low_rate
    jobs = jobs[jobs[:, at.THEN] == at.NOTHING]
    table = memory[memory[at.MEASUREMENTS] : memory[at.TAKEN]].reshape(-1, at.MEASUREMENT)
    there = (found.arrives >= 0) & (found.arrives < work.scenario.steps)
    waiting = there & (table[:, at.TO_STATE + at.FOLLOWING] == 0)
    sensors = work.scenario.sensors
    kinds = np.array([work.kinds.index(correct_kind(sensor)) for sensor in sensors])
    dues = np.array([work.scenario.due(sensor) for sensor in sensors])
    own = found.sensor[waiting]
    release, deadline = found.arrives[waiting], found.step[waiting] + dues[own]
    of_measurements = np.stack([kinds[own], release * work.period, deadline * work.period], axis=1)
    return np.concatenate([jobs[:, columns], of_measurements])


def _priorities(work: Workload) -> dict[str, int]:
    """Of the jobs of each kind."""
    scenario = work.scenario
    of_tasks = {f"task:{task.name}": task.priority for task in scenario.tasks}
    of_sensors = {
        kind: sensor.priority
        for sensor in scenario.sensors
        for kind in (correct_kind(sensor), gain_kind(sensor), loss_kind(sensor))
    }
    return {"predict": scenario.priority} | of_sensors | of_tasks


def _busy(work: Workload, memory: Ints) -> list[int]:
    """Ticks in which each processor ran a job."""
    cpus = memory[memory[at.CPUS] : memory[at.CPUS_END]].reshape(-1, at.CPU)
    last = np.where(cpus[:, at.RUNNING] != 0, work.horizon - cpus[:, at.SINCE], 0)
    ticks: list[int] = (cpus[:, at.TICKS_BUSY] + last).tolist()
    return ticks


def _schedule(
    work: Workload, memory: Ints, jobs: Mapping[str, Jobs], busy: int, first_miss: tuple[str, bool] | None
) -> Schedule:
    preemptions = memory[memory[at.PREEMPTED_JOBS] :][: len(work.kinds)].tolist()
    of_kinds = dict(zip(work.kinds, preemptions, strict=True))
    return Schedule(
        period=work.period,
        horizon=work.horizon,
        cpus=work.scenario.cpus,
        busy=busy,
        responses={
            kind: _response(jobs[kind], work.horizon, of_kinds[kind])
            for kind in sorted(jobs)
            if jobs[kind].end.size or jobs[kind].due.size
        },
        first_miss=first_miss,
        instants=int(memory[at.INSTANTS]),
    )


def _response(jobs: Jobs, horizon: int, preemptions: int) -> Response:
    responses, lateness = jobs.end - jobs.release, jobs.lateness(horizon)
    return Response(
        releases=jobs.end.size + jobs.due.size,
        finished=jobs.end.size,
        worst=int(responses.max(initial=0)),
        total=_sum(responses),
        misses=lateness.size,
        worst_lateness=int(lateness.max(initial=0)),
        preemptions=preemptions,
    )


def _sum(times: Ints) -> int:
    """Of so many that it may have more than 64 bits."""
    return (int((times >> 32).sum()) << 32) + int((times & 0xFFFFFFFF).sum())


def _figures(jobs: Jobs, work: Workload) -> JobFigures:
    lateness = jobs.lateness(work.horizon)
    has_time = jobs.deadline > jobs.release
    left, given = (times[has_time] for times in (jobs.deadline - jobs.end, jobs.deadline - jobs.release))
    return JobFigures(
        released=jobs.end.size + jobs.due.size,
        responses=_quotients(jobs.end - jobs.release, np.array(work.period)).tolist(),
        misses=lateness.size,
        decided=jobs.end.size + int(np.count_nonzero(jobs.due <= work.horizon)),
        least_margin=float(_quotients(left, given).min()) if left.size else None,
    )


def _quotients(times: Ints, others: Ints) -> Floats:
    """Each rounded once, as Python does."""
    if max(abs(times).max(initial=0), others.max(initial=0)) <= EXACT:
        return times / others
    pairs = zip(times.tolist(), np.broadcast_to(others, times.shape).tolist(), strict=True)
    return np.array([time / other for time, other in pairs])


def _sensors(work: Workload, found: Measured, jobs: Mapping[str, Jobs]) -> dict[str, SensorFigures]:
    scenario, figures = work.scenario, {}
    for number, sensor in enumerate(scenario.sensors):
        own, done = found.sensor == number, jobs[correct_kind(sensor)]
        arrives = found.arrives[own]
        landed = (done.end - 1) // work.period + (scenario.late == "dual-rate")
        landings = list(zip(done.step.tolist(), landed.tolist(), strict=True))
        achieved = Counter((landed - done.step).tolist())
        figures[sensor.name] = SensorFigures(
            taken=arrives.size,
            dropped=int(np.count_nonzero(arrives == at.NEVER)),
            arrived=int(np.count_nonzero((arrives >= 0) & (arrives < scenario.steps))),
            achieved=achieved,
            longest=longest_wait(sensor, achieved, landings),
            landings=landings,
        )
    return figures
