"""Runs a scenario on the simulated processor, and says what came out of it: how long, how late, how often."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from sched_sim.scenario.distribution import wilson
from sched_sim.scenario.scenario import Scenario, needed_parts
from sched_sim.scenario.source import ComposedFilter, Measurement, correct_kind
from sched_sim.schedule.clock import Clock, OnProgress
from sched_sim.schedule.jobs import Source, step_at
from sched_sim.schedule.length import check_simulation
from sched_sim.schedule.outcome import Response, Schedule, Slice
from sched_sim.schedule.processor import OnSlice, Platform, Processor
from sched_sim.schedule.tasks import TaskSource, work_and_times
from sched_sim.ticks import ticks_per_unit, to_ticks


@dataclass(frozen=True)
class JobFigures:
    """Of all jobs of one kind.

    released: those whose release came; responses: of those that finished, in HR periods, in order of finishing;
    misses: finished after the deadline, or unfinished although it had passed;
    decided: finished, or unfinished although the deadline had passed: of the others it is not known.
    """

    released: int
    responses: Sequence[float]
    misses: int
    decided: int

    @property
    def miss_probability(self) -> float | None:
        """None if no job was decided."""
        return self.misses / self.decided if self.decided else None

    @property
    def miss_interval(self) -> tuple[float, float] | None:
        """The 95 % interval of the probability, see `wilson`."""
        return wilson(self.misses, self.decided) if self.decided else None


@dataclass(frozen=True)
class SensorFigures:
    """Of one sensor's measurements.

    taken: in the simulated time; dropped: those of them that never arrive; arrived: by its end;
    achieved: how many corrections landed at each l - k.
    """

    taken: int
    dropped: int
    arrived: int
    achieved: Counter[int]

    @property
    def not_landed(self) -> int:
        """Arrived, and not in the state at the end of the simulated time."""
        return self.arrived - self.achieved.total()

    @property
    def on_the_way(self) -> int:
        """Neither dropped nor arrived by the end of the simulated time."""
        return self.taken - self.dropped - self.arrived


@dataclass(frozen=True)
class Outcome:
    """jobs: by kind, "predict", "correct NAME", "task:NAME"; sensors: by name; schedule: of the processor;
    first_miss: the earliest deadline that was missed, in HR periods from the start.

    A correction is one job, from its arrival until it lands, whether it has to catch up or lands together with others.
    """

    jobs: Mapping[str, JobFigures]
    sensors: Mapping[str, SensorFigures]
    schedule: Schedule
    first_miss: float | None

    @property
    def misses(self) -> int:
        return sum(figures.misses for figures in self.jobs.values())


def run_scenario(
    scenario: Scenario, *, on_slice: OnSlice | None = None, on_progress: OnProgress | None = None
) -> Outcome:
    """Simulate it: the same outcome every time, from its seed.

    on_slice: called as slices end, `finished` only where a correction has landed; those that go together have the
    slices of the first. on_progress: called about a hundred times.
    """
    check_simulation(scenario.steps, scenario.tasks, f"scenario {scenario.name!r}: steps")
    parts = needed_parts(scenario.sensors, scenario.late)
    speed, tasks = scenario.speed, scenario.tasks
    resolution = ticks_per_unit(
        [
            speed,
            scenario.context_switch,
            *(cost for part in parts for cost in scenario.costs[part]),
            *(value for task in tasks for value in work_and_times(task, speed)),
        ]
    )
    period = to_ticks(speed, resolution)
    costs = {part: [to_ticks(cost, resolution) for cost in scenario.costs[part]] for part in parts}
    record = Record(scenario, on_slice)
    composed = ComposedFilter(scenario, costs, period, record.landed)
    of_tasks = [TaskSource(task, speed, resolution) for task in tasks]
    clock = [] if on_progress is None else [Clock(period, scenario.steps, on_progress)]
    platform = Platform(scenario.cpus, to_ticks(scenario.context_switch, resolution))
    horizon = scenario.steps * period
    sources: list[Source] = [composed, *of_tasks, *clock]
    processor = Processor(sources, period, horizon, platform, record.ended)
    processor.run()
    schedule = processor.schedule()
    record.settle()

    pending = defaultdict(list)
    for measurement in composed.pending:
        pending[measurement.sensor].append(measurement)
    filed = dict(schedule.responses)
    for number, sensor in enumerate(scenario.sensors):
        kind = correct_kind(sensor)
        if record.finished[kind] or pending[number]:
            preemptions = filed[kind].preemptions if kind in filed else 0
            filed[kind] = _response(record.finished[kind], pending[number], preemptions, horizon)
    schedule = replace(schedule, responses=filed)
    sensors = {}
    for number, sensor in enumerate(scenario.sensors):
        achieved = Counter(step_at(job.end, period) - job.step for job in record.finished[correct_kind(sensor)])
        arrived = achieved.total() + len(pending[number])
        sensors[sensor.name] = SensorFigures(composed.taken[number], composed.dropped[number], arrived, achieved)
    kinds = ["predict", *map(correct_kind, scenario.sensors), *(f"task:{task.name}" for task in tasks)]
    jobs = {kind: _figures(record.finished[kind], filed.get(kind), period) for kind in kinds}
    missed = [job.deadline for ended in record.finished.values() for job in ended if job.end > job.deadline]
    missed += [measurement.due for measurement in composed.pending if measurement.due <= horizon]
    missed += [processor.first_miss[0]] if processor.first_miss else []
    return Outcome(jobs, sensors, schedule, min(missed) / period if missed else None)


class Record:
    """What ends as the simulated time goes on. finished: the last slice of each job, by kind."""

    def __init__(self, scenario: Scenario, on_slice: OnSlice | None) -> None:
        self.kinds = [correct_kind(sensor) for sensor in scenario.sensors]
        self.on_slice = on_slice
        self.finished: defaultdict[str, list[Slice]] = defaultdict(list)
        self.held: Slice | None = None  # of a correction that lands, or catches up, at this very instant
        self.landing: list[Measurement] = []  # at this very instant, with that slice

    def landed(self, measurement: Measurement, _now: int) -> None:
        self.landing.append(measurement)

    def ended(self, piece: Slice) -> None:
        self.settle()
        if piece.finished and piece.kind in self.kinds:
            self.held = piece
            return
        if piece.finished:
            self.finished[piece.kind].append(piece)
        self._tell(piece)

    def settle(self) -> None:
        """By now it is known whether the correction has landed."""
        if self.held is not None:
            piece = self.held._replace(finished=bool(self.landing))
            for one in self.landing:
                kind = self.kinds[one.sensor]
                job = piece._replace(kind=kind, step=one.step, release=one.arrival, deadline=one.due)
                self.finished[kind].append(job)
            self.held = None
            self.landing.clear()
            self._tell(piece)

    def _tell(self, piece: Slice) -> None:
        if self.on_slice is not None:
            self.on_slice(piece)


def _response(landed: Sequence[Slice], pending: Sequence[Measurement], preemptions: int, horizon: int) -> Response:
    """Of a sensor's corrections: the processor's own figures count each catching-up, and not those that go together."""
    overdue = [horizon - measurement.due for measurement in pending if measurement.due <= horizon]
    late = [job.end - job.deadline for job in landed if job.end > job.deadline]
    responses = [job.end - job.release for job in landed]
    return Response(
        releases=len(landed) + len(pending),
        finished=len(landed),
        worst=max(responses, default=0),
        total=sum(responses),
        misses=len(late) + len(overdue),
        worst_lateness=max([*late, *overdue], default=0),
        preemptions=preemptions,
    )


def _figures(finished: Sequence[Slice], filed: Response | None, period: int) -> JobFigures:
    """filed: None if no such job was released."""
    if filed is None:
        return JobFigures(0, [], 0, 0)
    unfinished_misses = filed.misses - sum(job.end > job.deadline for job in finished)
    responses = [(job.end - job.release) / period for job in finished]
    return JobFigures(filed.releases, responses, filed.misses, len(finished) + unfinished_misses)
