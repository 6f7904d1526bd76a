"""What came out of a scenario: how long, how late, how often."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from sched_sim.html_table import html_table
from sched_sim.scenario.distribution import below_which_unresolved, finished_or_not, wilson
from sched_sim.scenario.scenario import Sensor
from sched_sim.schedule.outcome import HINT, Schedule, with_chart


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
        """The share of those decided that missed their deadline; None if none did: see `miss_interval`."""
        return self.misses / self.decided if self.misses else None

    @property
    def miss_interval(self) -> tuple[float, float] | None:
        """The 95 % interval of the probability, see `wilson`; from 0 to what is not resolved, 3/n, if no job of n that
        were decided missed its deadline; None if none was decided."""
        if not self.misses:
            return (0.0, below_which_unresolved(self.decided)) if self.decided else None
        return wilson(self.misses, self.decided)


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
    first_miss: the earliest deadline that was missed, in HR periods from the start; busy: ticks in which a job ran, of
    each processor.

    A correction is one job, from its arrival until it lands, whether it has to catch up or lands together with others;
    that of the dual-rate filter ends before the step in whose state it is.
    """

    jobs: Mapping[str, JobFigures]
    sensors: Mapping[str, SensorFigures]
    schedule: Schedule
    first_miss: float | None
    busy: Sequence[int]

    @property
    def misses(self) -> int:
        """How many deadlines were missed, of all kinds of job."""
        return sum(figures.misses for figures in self.jobs.values())

    def _repr_mimebundle_(self, include: object = None, exclude: object = None) -> dict[str, str]:  # noqa: ARG002
        """For a notebook, as of a `Schedule`."""
        return with_chart(self.schedule, self._repr_html_())

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
        return (
            html_table(
                "Response times, in HR periods", ("job", "released", "finished", *QUANTILES, "deadlines missed"), jobs
            )
            + html_table(
                "Measurements, and the l - k at which their corrections landed",
                ("sensor", *COUNTS, *QUANTILES),
                sensors,
            )
            + ("" if self.schedule.slices else HINT)
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


def longest_wait(sensor: Sensor, achieved: Counter[int], landings: Sequence[tuple[int, int]]) -> Fraction | None:
    """Of `SensorFigures`; of those that land latest, for a measurement waits for less than a step to be taken."""
    latest = max(achieved, default=None)
    if latest is None or not sensor.between_steps:
        return None if latest is None else Fraction(latest)
    return latest + max(k - sensor.instant(k) for k, l in landings if l - k == latest)
