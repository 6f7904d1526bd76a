"""One run of a scenario, simulated as far as it was asked for, and kept in some hundred bytes a job."""

from __future__ import annotations

from array import array
from bisect import bisect_left, bisect_right
from math import inf, nan
from typing import Any

import numpy as np

from sched_sim.scenario.engine.measured import Ints, measured
from sched_sim.scenario.kinds import correct_kind
from sched_sim.scenario.scenario import Scenario
from sched_sim.scenario.simulated import Simulation
from sched_sim.scenario.workload import workload
from sched_sim.schedule.intervals import TASK
from sched_sim.schedule.outcome import Slice

AHEAD = 200
"""So many steps behind a window are simulated too, so that it is known when its last jobs finish."""
STRIDE = 1_000
"""HR steps between two looks at how far it is."""


class TracedJobs:
    """In the order of their first slices. kind: its index; times in HR periods; seen: when the first slice ended;
    start: of the first work; start and finish are NaN where they have not been."""

    def __init__(self) -> None:
        self.kind = array("H")
        self.step = array("q")
        self.release = array("d")
        self.deadline = array("d")
        self.seen = array("d")
        self.start = array("d")
        self.finish = array("d")


class TracedBars:
    """Work of one processor, each bar done without interruption, in the order of time. job, style: their indices;
    run: the number of the stretch of its job, from 0; last: whether the job then finished, or gave the processor up;
    start, end: in HR periods."""

    def __init__(self) -> None:
        self.job = array("q")
        self.run = array("q")
        self.last = array("B")
        self.style = array("H")
        self.start = array("d")
        self.end = array("d")

    def between(self, first: float, until: float) -> slice:
        """Those that are not outside."""
        return slice(bisect_right(self.end, first), bisect_left(self.start, until))


class Misses:
    """Deadlines that were missed, in HR periods, and the index of the job, in the order in which they were noticed: as
    it ran on behind it, or ended."""

    def __init__(self) -> None:
        self.deadline = array("d")
        self.job = array("q")


class Alive:
    """A job that has not finished. index: of the job; run: the number of its last stretch, which ended then, in ticks;
    -1 before the first; missed: whether that has been noticed."""

    __slots__ = ("ended", "index", "missed", "run")

    def __init__(self, index: int) -> None:
        self.index = index
        self.run = self.ended = -1
        self.missed = False


class Trace:
    """kinds, styles: of jobs, as in `Outcome`, and of bars, by index; a user's task has the style "task:NAME".

    reached: the step up to whose start it has been simulated. Of each sensor, by its kind of job: measured, the steps
    in which measurements are taken, of the whole run, and in which they arrive, less than 0 if they do not; landings,
    those in which corrections have landed, in order.
    """

    def __init__(self, scenario: Scenario) -> None:
        work = workload(scenario)
        self.scenario = scenario
        self.kinds = {kind: index for index, kind in enumerate(work.kinds)}
        self.styles: dict[str, int] = {}
        self.jobs = TracedJobs()
        self.bars = [TracedBars() for _ in range(scenario.cpus)]
        self.misses = Misses()
        self.landings = {correct_kind(sensor): array("q") for sensor in scenario.sensors}
        self.measured = _measured(scenario)
        self.reached = 0
        self._alive: dict[tuple[str, int], Alive] = {}
        self._simulation = Simulation(work, self._take)

    def advance(self, steps: int) -> None:
        """By so many steps, or to the end of the run."""
        until = min(self.reached + steps, self.scenario.steps)
        if until < self.scenario.steps:
            self._simulation.advance(until)
        elif self.reached < until:
            self._simulation.outcome()
        self.reached = until

    def knows(self, until: int) -> bool:
        """Whether all that a window up to the start of step `until` shows is there."""
        if self.reached == self.scenario.steps:
            return True
        return self.reached >= until + AHEAD and self._simulation.runs_since >= until

    def learn(self, until: int, most: int) -> bool:
        """Goes on until it knows that, or by so many steps; whether it does."""
        end = self.reached + most
        while not self.knows(until) and self.reached < end:
            self.advance(STRIDE)
        return self.knows(until)

    def search(self, after: float, kinds: set[str] | None, most: int) -> dict[str, Any] | None:
        """The first miss of a job of these kinds, or of any, whose deadline is later than `after`, in steps; goes on
        by so many steps at most, until it is known."""
        end = self.reached + most
        while (found := self._next_miss(after, kinds)) is None and self.reached < min(end, self.scenario.steps):
            self.advance(STRIDE)
        if found is None:
            return None
        job = self.misses.job[found]
        kind = list(self.kinds)[self.jobs.kind[job]]
        return {"deadline": self.misses.deadline[found], "kind": kind, "step": self.jobs.step[job]}

    def _next_miss(self, after: float, kinds: set[str] | None) -> int | None:
        """Its number among those that are known."""
        deadlines = np.frombuffer(self.misses.deadline) if self.misses.deadline else np.zeros(0)
        wanted = deadlines > after
        if kinds is not None and wanted.any():
            own = np.array(self.jobs.kind, np.int64)[np.array(self.misses.job, np.int64)]
            wanted &= np.isin(own, [self.kinds[kind] for kind in kinds])
        return int(np.where(wanted, deadlines, inf).argmin()) if wanted.any() else None

    def _take(self, piece: Slice) -> None:
        key, period = (piece.kind, piece.step), piece.period
        job = self._alive.get(key) or self._begun(key, piece)
        if piece.start < piece.end:
            self._worked(job, piece)
        if piece.missed and not job.missed:
            job.missed = True
            self.misses.deadline.append(piece.deadline / period)
            self.misses.job.append(job.index)
        if not piece.finished:
            return
        del self._alive[key]
        self.jobs.finish[job.index] = piece.end / period
        if piece.kind in self.landings:
            self.landings[piece.kind].append(self.scenario.lands(piece.end, period))

    def _begun(self, key: tuple[str, int], piece: Slice) -> Alive:
        jobs, period = self.jobs, piece.period
        job = self._alive[key] = Alive(len(jobs.kind))
        jobs.kind.append(self.kinds[piece.kind])
        jobs.step.append(piece.step)
        jobs.release.append(piece.release / period)
        jobs.deadline.append(piece.deadline / period)
        jobs.seen.append(piece.end / period)
        jobs.start.append(nan)
        jobs.finish.append(nan)
        return job

    def _worked(self, job: Alive, piece: Slice) -> None:
        """A stretch goes on where a correction that catches up does."""
        if job.run < 0:
            self.jobs.start[job.index] = piece.start / piece.period
        job.run += piece.start != job.ended
        job.ended = piece.end
        bars = self.bars[piece.cpu]
        for label, start, end in piece.pieces():
            is_switch = start < piece.start + piece.overhead
            style = piece.kind if piece.kind.startswith(TASK) and not is_switch else label
            bars.job.append(job.index)
            bars.run.append(job.run)
            bars.last.append(end == piece.end)
            bars.style.append(self.styles.setdefault(style, len(self.styles)))
            bars.start.append(start / piece.period)
            bars.end.append(end / piece.period)


def _measured(scenario: Scenario) -> dict[str, tuple[Ints, Ints]]:
    found = measured(scenario, scenario.seed)
    of_sensors = [found.sensor == number for number in range(len(scenario.sensors))]
    return {
        correct_kind(sensor): (found.step[own], found.arrives[own])
        for sensor, own in zip(scenario.sensors, of_sensors, strict=True)
    }
