"""Runs a scenario on the simulated processor, and says what came out of it: how long, how late, how often."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import NamedTuple

from sched_sim.errors import InputError
from sched_sim.html_table import html_table
from sched_sim.scenario.distribution import finished_or_not, wilson
from sched_sim.scenario.dual_rate import DualRateFilter, gain_kind, loss_kind
from sched_sim.scenario.scenario import Scenario, Sensor, needed_parts
from sched_sim.scenario.source import ComposedFilter, correct_kind
from sched_sim.schedule.clock import Clock, OnProgress
from sched_sim.schedule.jobs import Job, Source
from sched_sim.schedule.length import check_simulation
from sched_sim.schedule.outcome import Response, Schedule
from sched_sim.schedule.processor import OnSlice, Platform, Processor
from sched_sim.schedule.tasks import TaskSource, work_and_times
from sched_sim.ticks import ticks_per_unit, to_ticks


@dataclass(frozen=True)
class JobFigures:
    """Figures of all jobs of one kind.

    released: those whose release came; responses: of those that finished, in HR periods, in order of finishing;
    misses: finished after the deadline, or unfinished although it had passed;
    decided: finished, or unfinished although the deadline had passed: of the others it is not known;
    least_margin: of those that finished, the least share of the time from release to deadline that was left; below 0
    where one was late, None if none finished.
    """

    released: int
    responses: Sequence[float] = field(repr=False)
    misses: int
    decided: int
    least_margin: float | None = None

    @property
    def miss_probability(self) -> float | None:
        """The share of those decided that missed their deadline; None if no job was decided."""
        return self.misses / self.decided if self.decided else None

    @property
    def miss_interval(self) -> tuple[float, float] | None:
        """The 95 % interval of the probability, see `wilson`."""
        return wilson(self.misses, self.decided) if self.decided else None


@dataclass(frozen=True)
class SensorFigures:
    """Figures of one sensor's measurements.

    taken: in the simulated time; dropped: those of them that never arrive; arrived: by its end;
    achieved: how many corrections landed at each l - k; longest: from when a measurement was taken, between two steps
    or at the start of one, to the start of the step in which its correction landed, in HR steps; None if none landed;
    landings: k and l of each, in order of landing.
    """

    taken: int
    dropped: int
    arrived: int
    achieved: Counter[int]
    longest: Fraction | None = None
    landings: Sequence[tuple[int, int]] = field(default=(), repr=False)

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
    """What came out of a scenario.

    jobs: by kind, "predict", "correct NAME", "task:NAME", of the dual-rate filter also "gain NAME" and "loss NAME";
    sensors: by name; schedule: of the processor;
    first_miss: the earliest deadline that was missed, in HR periods from the start.

    A correction is one job, from its arrival until it lands, whether it has to catch up or lands together with others;
    that of the dual-rate filter ends before the step in whose state it is.
    """

    jobs: Mapping[str, JobFigures]
    sensors: Mapping[str, SensorFigures]
    schedule: Schedule
    first_miss: float | None

    @property
    def misses(self) -> int:
        """How many deadlines were missed, of all kinds of job."""
        return sum(figures.misses for figures in self.jobs.values())

    def _repr_html_(self) -> str:
        """Quantiles of the responses are of all that were released, and those of l of all that arrived."""
        jobs = [
            (kind, job.released, len(job.responses), *_quantiles(job.responses, job.released), job.misses)
            for kind, job in self.jobs.items()
        ]
        sensors = [
            (name, *_counts(sensor), *_quantiles(list(sensor.achieved.elements()), sensor.arrived))
            for name, sensor in self.sensors.items()
        ]
        return html_table(
            "Response times, in HR periods", ("job", "released", "finished", *QUANTILES, "deadlines missed"), jobs
        ) + html_table(
            "Measurements, and the l - k at which their corrections landed",
            ("sensor", *COUNTS, *QUANTILES),
            sensors,
        )


COUNTS = ("taken", "dropped", "on the way", "arrived", "landed")
QUANTILES = ("minimum", "mean", "median", "p95", "p99", "maximum")


def _counts(figures: SensorFigures) -> tuple[int, ...]:
    return figures.taken, figures.dropped, figures.on_the_way, figures.arrived, figures.achieved.total()


def _quantiles(finished: Sequence[float], count: int) -> tuple[float | None, ...]:
    if not finished:
        return (None,) * len(QUANTILES)
    figures = finished_or_not(finished, count - len(finished))
    return tuple(figures[name] for name in QUANTILES)


def run_scenario(
    scenario: Scenario, *, on_slice: OnSlice | None = None, on_progress: OnProgress | None = None
) -> Outcome:
    """Simulate it: the same outcome every time, from its seed.

    on_slice: called as slices end; of corrections that go together the first has the work.
    on_progress: called about a hundred times.
    """
    if not isinstance(scenario, Scenario):
        raise InputError(f"scenario is a {type(scenario).__name__}: give read_scenario(...), or a Scenario")
    check_simulation(scenario.steps, scenario.tasks, f"scenario {scenario.name!r}: steps")
    parts = needed_parts(scenario.sensors, scenario.late, scenario.carries)
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
    source = DualRateFilter if scenario.late == "dual-rate" else ComposedFilter
    composed = source(scenario, costs, period)
    of_tasks = [TaskSource(task, speed, resolution) for task in tasks]
    clock = [] if on_progress is None else [Clock(period, scenario.steps, on_progress)]
    platform = Platform(scenario.cpus, to_ticks(scenario.context_switch, resolution))
    sources: list[Source] = [composed, *of_tasks, *clock]
    finishes: defaultdict[str, list[Finish]] = defaultdict(list)

    def on_finish(job: Job, now: int) -> None:
        finishes[job.kind].append(Finish(job.step, job.release, job.deadline, now))

    processor = Processor(sources, period, scenario.steps * period, platform, on_slice, on_finish)
    processor.run()
    schedule = processor.schedule()
    sensors = {}
    for number, sensor in enumerate(scenario.sensors):
        done = finishes[correct_kind(sensor)]
        landings = [(job.step, scenario.lands(job.end, period)) for job in done]
        achieved = Counter(l - k for k, l in landings)
        arrived = achieved.total() + sum(waiting.sensor == number for waiting in composed.pending)
        sensors[sensor.name] = SensorFigures(
            composed.taken[number],
            composed.dropped[number],
            arrived,
            achieved,
            _longest(sensor, landings),
            landings,
        )
    kinds = ["predict", *_kinds(scenario), *(f"task:{task.name}" for task in tasks)]
    jobs = {kind: _figures(finishes[kind], schedule.responses.get(kind), period) for kind in kinds}
    return Outcome(jobs, sensors, schedule, processor.first_miss[0] / period if processor.first_miss else None)


def _kinds(scenario: Scenario) -> list[str]:
    """Of the jobs of the sensors."""
    if scenario.late != "dual-rate":
        return [*map(correct_kind, scenario.sensors)]
    return [
        kind
        for sensor in scenario.sensors
        for kind in (gain_kind(sensor), correct_kind(sensor), *([loss_kind(sensor)] if sensor.dropout else []))
    ]


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


def _longest(sensor: Sensor, landings: Sequence[tuple[int, int]]) -> Fraction | None:
    waits = {k: k - sensor.instant(k) for k, _ in landings} if sensor.between_steps else {}
    return max((l - k + waits.get(k, Fraction(0)) for k, l in landings), default=None)


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
