"""A scenario simulated by SimPy, job by job: the reference for what compiled code does."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence
from math import inf
from typing import NamedTuple

from sched_sim.scenario.dual_rate import DualRateFilter
from sched_sim.scenario.kinds import correct_kind
from sched_sim.scenario.outcome import JobFigures, Outcome, SensorFigures, longest_wait
from sched_sim.scenario.source import ComposedFilter
from sched_sim.scenario.workload import Workload
from sched_sim.schedule.clock import Clock, OnProgress
from sched_sim.schedule.jobs import Job, Source
from sched_sim.schedule.outcome import Response
from sched_sim.schedule.processor import OnSlice, Platform, Processor


def simulated(work: Workload, on_slice: OnSlice | None = None, on_progress: OnProgress | None = None) -> Outcome:
    return Simulation(work, on_slice, on_progress).outcome()


class Simulation:
    """One that can be stopped on its way, and goes on."""

    def __init__(self, work: Workload, on_slice: OnSlice | None = None, on_progress: OnProgress | None = None) -> None:
        self.work = work
        scenario, period = work.scenario, work.period
        source = DualRateFilter if scenario.late == "dual-rate" else ComposedFilter
        self.composed = source(scenario, work.costs, period)
        clock = [] if on_progress is None else [Clock(period, scenario.steps, on_progress)]
        sources: list[Source] = [self.composed, *work.tasks(), *clock]
        self.finishes: defaultdict[str, list[Finish]] = defaultdict(list)
        platform = Platform(scenario.cpus, work.context_switch)
        self.processor = Processor(sources, period, work.horizon, platform, on_slice, self._on_finish)

    def _on_finish(self, job: Job, now: int) -> None:
        self.finishes[job.kind].append(Finish(job.step, job.release, job.deadline, now))

    def advance(self, step: int) -> None:
        """To the start of this step before the last: what ends there has not ended yet."""
        self.processor.advance(step * self.work.period)

    @property
    def runs_since(self) -> float:
        """The earliest instant, in HR periods, since when a job runs that runs now; infinity if none does."""
        since = (cpu.since / self.work.period for cpu in self.processor.cpus if cpu.running is not None)
        return min(since, default=inf)

    def outcome(self) -> Outcome:
        """At the end, to which it goes."""
        work, finishes, processor = self.work, self.finishes, self.processor
        scenario, period = work.scenario, work.period
        processor.run()
        schedule = processor.schedule()
        sensors = {}
        for number, sensor in enumerate(scenario.sensors):
            done = finishes[correct_kind(sensor)]
            landings = [(job.step, scenario.lands(job.end, period)) for job in done]
            achieved = Counter(l - k for k, l in landings)
            arrived = achieved.total() + sum(waiting.sensor == number for waiting in self.composed.pending)
            sensors[sensor.name] = SensorFigures(
                self.composed.taken[number],
                self.composed.dropped[number],
                arrived,
                achieved,
                longest_wait(sensor, achieved, landings),
                landings,
            )
        jobs = {kind: _figures(finishes[kind], schedule.responses.get(kind), period) for kind in work.kinds}
        first_miss = processor.first_miss[0] / period if processor.first_miss else None
        return Outcome(jobs, sensors, schedule, first_miss, [cpu.busy for cpu in processor.cpus])


class Finish(NamedTuple):
    """A job's end: the step it belongs to; when it was released, was due and ended, in ticks."""

    step: int
    release: int
    deadline: int
    end: int

    @property
    def has_time(self) -> bool:
        """Whether its deadline was not yet there when it was released."""
        return self.deadline > self.release


def _figures(finishes: Sequence[Finish], response: Response | None, period: int) -> JobFigures:
    """response: None if no such job was released."""
    if response is None:
        return JobFigures(0, [], 0, 0)
    unfinished_misses = response.misses - sum(done.end > done.deadline for done in finishes)
    responses = [(done.end - done.release) / period for done in finishes]
    margins = ((done.deadline - done.end) / (done.deadline - done.release) for done in finishes if done.has_time)
    return JobFigures(
        response.releases, responses, response.misses, len(finishes) + unfinished_misses, min(margins, default=None)
    )
