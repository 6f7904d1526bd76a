"""The jobs of a scenario: how their response times are spread, and how often they miss their deadlines."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from sched_sim import shares
from sched_sim.probability.samples import unseen_mass
from sched_sim.probability.words import chance
from sched_sim.scenario.distribution import finished_or_not
from sched_sim.scenario.kinds import correct_kind, gain_kind, loss_kind
from sched_sim.scenario.outcome import JobFigures
from sched_sim.scenario.scenario import Scenario
from sched_sim.schedule.intervals import TASK
from studies.explorer.scenario_found import ScenarioFound
from studies.probability.beside_sampled import Beside, Longer

Floats: TypeAlias = npt.NDArray[np.float64]

BINS = 40
NEAR = 1.6
"""A deadline is on the axis if that is then no longer than this factor times one without it."""
MOST_POINTS = 400
"""Of a curve."""
DEEPEST = 1e-12
"""What is exact and rarer is not shown."""
NOT_RESOLVED = "not resolved"


@dataclass(frozen=True, slots=True)
class StepCurve:
    """A step curve: y from each x to the next."""

    x: Sequence[float]
    y: Sequence[float]


@dataclass(frozen=True, slots=True)
class Histogram:
    """counts: in the bins between the edges, of which there is one more."""

    edges: Sequence[float]
    counts: Sequence[int]


@dataclass(frozen=True, slots=True)
class JobView:
    """The jobs of one kind; response times in the view's unit.

    sensor: whose they are, if any; released, finished, misses, decided: as in `JobFigures`. miss_probability,
    miss_interval: of a simulation that saw a miss; of one that saw none the interval is from 0 to what is not resolved;
    both None where no probability follows from the costs; probability, interval: the same in words.
    response: figures of all that were released, None where the unfinished decide, or none finished. deadline: from the
    release, None if it differs from job to job; near: whether it is on the axis. longer: the share that takes longer;
    unresolved: what so many do not resolve. exact: how likely they take longer, exact_miss: how likely they miss, in
    words; empty where that is not known.
    """

    kind: str
    sensor: str | None
    released: int
    finished: int
    misses: int
    decided: int
    miss_probability: float | None
    miss_interval: tuple[float, float] | None
    probability: str
    interval: str
    response: Mapping[str, float | None] | None
    deadline: float | None
    near: bool
    histogram: Histogram | None
    longer: StepCurve | None
    unresolved: float
    exact: StepCurve | None
    exact_miss: str
    sentence: str


def job_views(found: ScenarioFound) -> list[JobView]:
    return [_job(found, kind, figures) for kind, figures in found.outcome.jobs.items()]


def unit_of(scenario: Scenario) -> tuple[float, str]:
    """What an HR period is in the unit of response times."""
    return (1.0, "HR periods") if scenario.hr_hz is None else (float(1000 / scenario.hr_hz), "ms")


def _job(found: ScenarioFound, kind: str, figures: JobFigures) -> JobView:
    scenario, (scale, _) = found.scenario, unit_of(found.scenario)
    beside = found.exact if isinstance(found.exact, Beside) else None
    exact = _exact(beside.longer, scale) if beside is not None and beside.longer and kind == "predict" else None
    miss = None if beside is None else beside.misses.get(kind)
    responses = np.array(figures.responses) * scale
    deadline = _deadline(scenario, kind)
    limit = None if deadline is None else deadline * scale
    longest = max(float(responses.max(initial=0.0)), exact.x[-1] if exact else 0.0)
    near = limit is not None and limit <= NEAR * longest
    end = 1.05 * max(longest, limit if near and limit is not None else 0.0) or scale
    probability, interval = _said(scenario, figures)
    return JobView(
        kind=kind,
        sensor=_sensor(scenario, kind),
        released=figures.released,
        finished=len(figures.responses),
        misses=figures.misses,
        decided=figures.decided,
        miss_probability=None if scenario.harness else figures.miss_probability,
        miss_interval=None if scenario.harness else figures.miss_interval,
        probability=probability,
        interval=interval,
        response=_response(figures, scale),
        deadline=limit,
        near=near,
        histogram=_histogram(responses, end) if responses.size else None,
        longer=_longer(responses) if responses.size else None,
        unresolved=unseen_mass(max(responses.size, 1)),
        exact=exact,
        exact_miss="" if miss is None else chance(miss.bounds, miss.floor),
        sentence=sentence(scenario, kind, figures),
    )


def _sensor(scenario: Scenario, kind: str) -> str | None:
    for sensor in scenario.sensors:
        if kind in (correct_kind(sensor), gain_kind(sensor), loss_kind(sensor)):
            return sensor.name
    return None


def _deadline(scenario: Scenario, kind: str) -> float | None:
    """From the release, in HR periods; None if it differs from job to job."""
    if kind == "predict":
        return 1.0
    for task in scenario.tasks:
        if kind == f"{TASK}{task.name}":
            return None if task.jitter else float(task.due)
    for sensor in scenario.sensors:
        if kind == correct_kind(sensor) and sensor.least_delay == sensor.longest_delay:
            return float(scenario.due(sensor) - sensor.longest_delay)
    return None


def _response(figures: JobFigures, scale: float) -> dict[str, float | None] | None:
    if not figures.responses:
        return None
    found = finished_or_not(figures.responses, figures.released - len(figures.responses))
    return {name: None if value is None else scale * value for name, value in found.items()}


def _histogram(values: Floats, end: float) -> Histogram:
    counts, edges = np.histogram(values, bins=BINS, range=(0, end))
    return Histogram(edges.tolist(), counts.tolist())


def _longer(values: Floats) -> StepCurve:
    """The share that takes longer than x; of many all of the longest, and of the rest some."""
    steps, counts = np.unique(values, return_counts=True)
    above = 1 - np.cumsum(counts) / values.size
    above[-1] = 0.0
    kept = _kept(steps.size)
    return StepCurve([0.0, *steps[kept].tolist()], [1.0, *above[kept].tolist()])


def _kept(count: int) -> npt.NDArray[np.int64]:
    """Indices of at most MOST_POINTS, the last half of them all."""
    if count <= MOST_POINTS:
        return np.arange(count)
    half = MOST_POINTS // 2
    return np.unique(np.append(np.linspace(0, count - half, half).astype(np.int64), np.arange(count - half, count)))


def _exact(longer: Longer, scale: float) -> StepCurve:
    """As far as it is more than samples resolve, and DEEPEST. Where points are left out it is what it was before, which
    is more."""
    shown = longer.exceedance > max(longer.floor, DEEPEST)
    end = int(np.count_nonzero(shown))
    changes = np.flatnonzero(np.diff(longer.exceedance[:end], prepend=2.0))
    kept = changes[_kept(changes.size)]
    x = scale * np.append(kept, end) / longer.ticks
    return StepCurve(x.tolist(), np.append(longer.exceedance[kept], 0.0).tolist())


def _said(scenario: Scenario, figures: JobFigures) -> tuple[str, str]:
    """The probability of a miss and its interval, in words; empty where nothing tells it."""
    interval = figures.miss_interval
    if scenario.harness or interval is None:
        return "", ""
    if figures.miss_probability is None:
        return NOT_RESOLVED, f"below {shares.at_most(interval[1])}"
    return shares.probability(figures.miss_probability), shares.interval(*interval)


def sentence(scenario: Scenario, kind: str, figures: JobFigures) -> str:
    """Such as "3 of 20,000 corrections of gps landed late, 0.015 %, 95 % interval 0.0051 % to 0.045 %"."""
    many, late = nouns(kind)
    if figures.decided > len(figures.responses):
        late += " or not at all"
    if not figures.decided:
        return f"of {many} none has finished, and none was due"
    if not figures.misses:
        said = f"none of {figures.decided:,} {many} {late}"
        assert figures.miss_interval is not None
        bound = as_percent(shares.at_most(figures.miss_interval[1]))
        return said if scenario.harness else f"{said}: P(miss) is not resolved below {bound}"
    share = "all" if figures.misses == figures.decided > 1 else f"{figures.misses:,} of"
    said = f"{share} {figures.decided:,} {many} {late}"
    if scenario.harness or figures.miss_probability is None or figures.miss_interval is None:
        return said
    least, most = map(as_percent, shares.interval(*figures.miss_interval).split(" to "))
    share = as_percent(shares.probability(figures.miss_probability))
    return f"{said}, {share}, 95 % interval {least} to {most}"


def as_percent(share: str) -> str:
    return f"{float(f'{100 * float(share):.12g}'):.12g} %"


def nouns(kind: str) -> tuple[str, str]:
    """What jobs of this kind are, in the plural, and what one does that misses its deadline."""
    if kind == "predict":
        return "predict jobs", "finished late"
    if kind.startswith(TASK):
        return f"jobs of {kind.removeprefix(TASK)}", "finished late"
    work, _, sensor = kind.partition(" ")
    plural = {"correct": "corrections", "gain": "gains", "loss": "losses"}[work]
    return f"{plural} of {sensor}", "landed late" if work == "correct" else "finished late"
