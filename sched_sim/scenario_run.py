"""Runs a scenario on the simulated processor, and says what came out of it: how long, how late, how often."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from sched_sim.composed import ComposedFilter, Measurement, correct_kind
from sched_sim.distribution import wilson
from sched_sim.jobs import Job
from sched_sim.methods import step_at
from sched_sim.scenario import Scenario, needed_parts
from sched_sim.schedule import Schedule, Slice
from sched_sim.simulate import OnSlice, Processor
from sched_sim.tasks import TaskSource
from sched_sim.ticks import ticks_per_unit, to_ticks

OnProgress = Callable[[int, int, str], None]
"""Called with (steps done, steps in all, what they are)."""

REPORTS = 100
"""How often progress is told."""


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
    """jobs: by kind, "predict", "correct NAME", "task:NAME"; a correction that has to catch up is one job, from its
    arrival until it lands. sensors: by name. schedule: of the processor, whose own figures count each catching-up as
    a job."""

    jobs: Mapping[str, JobFigures]
    sensors: Mapping[str, SensorFigures]
    schedule: Schedule

    @property
    def misses(self) -> int:
        return sum(figures.misses for figures in self.jobs.values())


def run_scenario(
    scenario: Scenario, *, on_slice: OnSlice | None = None, on_progress: OnProgress | None = None
) -> Outcome:
    """Simulate it: the same outcome every time, from its seed.

    on_slice: called as slices end; on_progress: called about a hundred times.
    """
    parts = needed_parts(scenario.sensors, scenario.late)
    speed, tasks = scenario.speed, scenario.tasks
    resolution = ticks_per_unit(
        [
            speed,
            scenario.context_switch,
            *(cost for part in parts for cost in scenario.costs[part]),
            *(value for task in tasks for value in (task.cost, speed * task.period, speed * task.offset)),
        ]
    )
    period = to_ticks(speed, resolution)
    costs = {part: [to_ticks(cost, resolution) for cost in scenario.costs[part]] for part in parts}
    landings: list[tuple[Measurement, int]] = []
    finished: defaultdict[str, list[tuple[int, bool]]] = defaultdict(list)  # (response, missed) by kind

    def ended(piece: Slice) -> None:
        if piece.finished:
            finished[piece.kind].append((piece.end - piece.release, piece.end > piece.deadline))
        if on_slice is not None:
            on_slice(piece)

    composed = ComposedFilter(scenario, costs, period, lambda measurement, now: landings.append((measurement, now)))
    of_tasks = [
        TaskSource(
            task,
            period=to_ticks(task.period * speed, resolution),
            offset=to_ticks(task.offset * speed, resolution),
            cost=to_ticks(task.cost, resolution),
        )
        for task in tasks
    ]
    clock = [] if on_progress is None else [Clock(period, scenario.steps, on_progress)]
    context_switch = to_ticks(scenario.context_switch, resolution)
    horizon = scenario.steps * period
    processor = Processor([composed, *of_tasks, *clock], period, horizon, scenario.cpus, context_switch, ended)
    processor.run()
    schedule = processor.schedule()

    jobs = {"predict": _figures("predict", finished, schedule)}
    sensors = {}
    for number, sensor in enumerate(scenario.sensors):
        own = [(measurement, now) for measurement, now in landings if measurement.sensor == number]
        pending = [measurement for measurement in composed.pending if measurement.sensor == number]
        overdue = sum(measurement.due <= horizon for measurement in pending)
        jobs[correct_kind(sensor)] = JobFigures(
            released=len(own) + len(pending),
            responses=[(now - measurement.arrival) / period for measurement, now in own],
            misses=sum(now > measurement.due for measurement, now in own) + overdue,
            decided=len(own) + overdue,
        )
        achieved = Counter(step_at(now, period) - measurement.step for measurement, now in own)
        arrived = len(own) + len(pending)
        sensors[sensor.name] = SensorFigures(composed.taken[number], composed.dropped[number], arrived, achieved)
    for task in tasks:
        jobs[f"task:{task.name}"] = _figures(f"task:{task.name}", finished, schedule)
    return Outcome(jobs, sensors, schedule)


def _figures(kind: str, finished: Mapping[str, Sequence[tuple[int, bool]]], schedule: Schedule) -> JobFigures:
    """Of jobs that the processor files as they are."""
    if kind not in schedule.responses:
        return JobFigures(0, [], 0, 0)
    ended, filed = finished.get(kind, ()), schedule.responses[kind]
    unfinished_misses = filed.misses - sum(missed for _, missed in ended)
    responses = [response / schedule.period for response, _ in ended]
    return JobFigures(filed.releases, responses, filed.misses, len(ended) + unfinished_misses)


class Clock:
    """A source of no jobs, that tells how far the simulated time is. period: in ticks."""

    def __init__(self, period: int, steps: int, on_progress: OnProgress) -> None:
        self.stride = max(steps // REPORTS, 1)
        self.period = period
        self.steps = steps
        self.on_progress = on_progress
        self.step = 0
        self.next_release = 0

    def release(self) -> tuple[Job, ...]:
        self.on_progress(self.step, self.steps, "HR steps")
        self.step += self.stride
        self.next_release = self.step * self.period
        return ()

    def at_horizon(self) -> tuple[Job, ...]:
        return ()
