"""What is known of a scenario, as plain data: who misses how often, where corrections land, what it is worth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from fractions import Fraction
from math import ceil
from typing import Any, Literal

from sched_sim.scenario.load import demand
from sched_sim.scenario.scenario import Late, Scenario
from sched_sim.scenario.workload import kinds_of_jobs
from studies.explorer.document import all_visible
from studies.explorer.query import number_text
from studies.explorer.scenario_accuracy import AccuracyView, accuracy_view
from studies.explorer.scenario_answer import answer, notes, warnings
from studies.explorer.scenario_asked import AS_IT_IS, MOST_SPAN, ScenarioAsked, most_steps, query_of_asked
from studies.explorer.scenario_found import NotAsked, ScenarioFound, find
from studies.explorer.scenario_jobs import JobView, job_views, unit_of
from studies.explorer.scenario_sensors import SensorView, sensor_views
from studies.probability.beside_sampled import Beside
from studies.selection.in_scenario import Question, ScenarioAccuracy

FEWEST_STEPS, USUAL_STEPS = 12, 40
CYCLES = 2
"""Of the slowest sensor the trace shows so many at first, as far as they are no more than USUAL_STEPS."""
AFTER_MISS, BEFORE_ARRIVAL = 2, 4


@dataclass(frozen=True, slots=True)
class Slow:
    """What may take long: found, not asked for, or not there; why: there is none; takes: what it costs, in words."""

    state: Literal["found", "not asked", "none"]
    why: str = ""
    takes: str = ""


@dataclass(frozen=True, slots=True)
class ScenarioView:
    """query: the canonical text of the link; asked: what it says, as texts; own: seed and steps of the file.

    speed: cost units per HR period; limits: of what a link may ask; shown: the kind of job whose distribution is meant.
    busy, demand: of each processor, as shares of its time. unit: of response times. exact: of probabilities; cycles: in
    the mean of so many. trace: the steps that the trace shows at first, and how many deadlines are missed in all, by
    any job, and by corrections.
    """

    query: str
    asked: Mapping[str, str | None]
    name: str
    steps: int
    seed: int
    own: Mapping[str, int]
    late: Late
    hr_hz: float | None
    period_ms: float | None
    speed: float
    cpus: int
    limits: Mapping[str, Sequence[int]]
    kinds: Sequence[str]
    shown: str
    unit: str
    answer: Mapping[str, str]
    warnings: Sequence[str]
    notes: Sequence[str]
    misses: int
    busy: Sequence[float]
    demand: Sequence[float]
    jobs: Sequence[JobView]
    sensors: Sequence[SensorView]
    exact: Slow
    cycles: int
    accuracy: AccuracyView | None
    accuracy_is: Slow | None
    trace: Mapping[str, int]

    def document(self) -> dict[str, Any]:
        """For JSON, its texts as a page shows them."""
        found: dict[str, Any] = all_visible(asdict(self))
        return found


def explore_scenario(
    scenario: Scenario, asked: ScenarioAsked = AS_IT_IS, question: Question | None = None
) -> ScenarioView:
    """question: of the accuracy at the output, see `question_of`; None if no model is stated.

    Raises InputError for what cannot be simulated.
    """
    return scenario_view(scenario, asked, find(scenario, asked, question))


def scenario_view(scenario: Scenario, asked: ScenarioAsked, found: ScenarioFound) -> ScenarioView:
    """found: of this scenario, as it was asked for."""
    meant, outcome = found.scenario, found.outcome
    kinds = kinds_of_jobs(meant)
    accuracy = accuracy_view(found.accuracy) if isinstance(found.accuracy, ScenarioAccuracy) else None
    return ScenarioView(
        query=query_of_asked(asked),
        asked={"times_slower": number_text(Fraction(asked.times_slower))},
        name=meant.name,
        steps=meant.steps,
        seed=meant.seed,
        own={"steps": scenario.steps, "seed": scenario.seed},
        late=meant.late,
        hr_hz=None if meant.hr_hz is None else float(meant.hr_hz),
        period_ms=None if meant.hr_hz is None else float(1000 / meant.hr_hz),
        speed=float(meant.speed),
        cpus=meant.cpus,
        limits={"steps": (1, most_steps(scenario)), "span": (1, min(MOST_SPAN, meant.steps))},
        kinds=kinds,
        shown=asked.shown or _worst(found) or kinds[0],
        unit=unit_of(meant)[1],
        answer={"sentence": answer(found), "state": _state(found)},
        warnings=warnings(found),
        notes=notes(found, scenario.steps - meant.steps if asked.steps is None else 0),
        misses=outcome.misses,
        busy=[ticks / outcome.schedule.horizon for ticks in outcome.busy],
        demand=demand(meant),
        jobs=job_views(found),
        sensors=sensor_views(found),
        exact=_slow(found.exact),
        cycles=found.exact.cycles if isinstance(found.exact, Beside) else 0,
        accuracy=accuracy,
        accuracy_is=None if found.accuracy is None else _slow(found.accuracy),
        trace=_trace(found, asked),
    )


def _state(found: ScenarioFound) -> str:
    if found.outcome.misses:
        return "misses"
    return "holds" if any(figures.decided for figures in found.outcome.jobs.values()) else "unknown"


def _worst(found: ScenarioFound) -> str | None:
    """The kind of job that misses most often; None if none does."""
    shares = {kind: figures.miss_probability or 0.0 for kind, figures in found.outcome.jobs.items()}
    worst = max(shares, key=shares.__getitem__)
    return worst if shares[worst] else None


def _slow(found: object) -> Slow:
    if isinstance(found, NotAsked):
        return Slow("not asked", takes=found.takes)
    if isinstance(found, str):
        return Slow("none", why=found)
    return Slow("found", why=found.why if isinstance(found, Beside) else "")


def _trace(found: ScenarioFound, asked: ScenarioAsked) -> dict[str, int]:
    scenario, outcome = found.scenario, found.outcome
    cycles = ceil(CYCLES * max(sensor.every for sensor in scenario.sensors))
    span = asked.span or min(max(cycles, FEWEST_STEPS), USUAL_STEPS)
    span = min(span, scenario.steps)
    at = _first_of_interest(found, span) if asked.at is None else asked.at
    late = sum(outcome.jobs[f"correct {sensor.name}"].misses for sensor in scenario.sensors)
    return {
        "at": max(min(at, scenario.steps - span), 0),
        "span": span,
        "steps": scenario.steps,
        "misses": outcome.misses,
        "late": late,
    }


def _first_of_interest(found: ScenarioFound, span: int) -> int:
    """The first step of a window about the first miss, or the first late measurement of a sensor."""
    if found.outcome.first_miss is not None:
        return ceil(found.outcome.first_miss) + AFTER_MISS - span
    scenario = found.scenario
    measured = [sensor.measurements(scenario.steps, scenario.seed) for sensor in scenario.sensors if sensor.delayed]
    first = min((next((step + delay for step, delay in own if delay), 0) for own in measured), default=0)
    return first - BEFORE_ARRIVAL if first + BEFORE_ARRIVAL > span else 0
