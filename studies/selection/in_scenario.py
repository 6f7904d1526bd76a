"""The accuracy of the output along a simulated scenario: exact for what landed when.

The simulation says which measurement of which sensor, taken in step k, has landed in which step; that is all that its
accuracy depends on, for methods that lose nothing. What is lost never lands.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import numpy as np

from filters.accuracy.trace import Along, Spread, along, spread
from filters.accuracy.visible import visible
from filters.arrays import FloatArray
from sched_sim.bounds import short
from sched_sim.errors import SPELLING, InputError, option
from sched_sim.scenario.accuracy_asked import AccuracyAsked
from sched_sim.scenario.outcome import Outcome
from sched_sim.scenario.scenario import Scenario, Sensor
from sched_sim.schedule.clock import REPORTS, OnProgress
from studies.selection.outputs import Outputs, rows_of
from studies.selection.scenario_model import ScenarioModel, load_scenario_model
from studies.selection.scenario_start import Start, settled_start

MOST_PROPAGATIONS = 4_000_000
"""Some half a minute; as many steps are looked at as take no more."""
MOST_KEPT_BYTES = 400_000_000
FELT = 0.01
"""The start no longer matters when it makes less than this share of difference."""


@dataclass(frozen=True)
class Question:
    """What is asked of a scenario, checked before it is simulated. initial_std (n,): None: of the settled filter."""

    model: ScenarioModel
    outputs: Outputs
    initial_std: FloatArray | None


@dataclass(frozen=True)
class ScenarioAccuracy:
    """first, last: the steps over which the figures are. deviations (last + 1,): of the output, in each step.

    spread: of those. ages: by sensor, HR steps from when the newest measurement in the output was taken, in each of
    the steps from `first` on; None if none of its corrections landed. remarks: what to know of the figures.
    """

    question: Question
    hr_hz: Fraction | None
    first: int
    last: int
    spread: Spread
    deviations: FloatArray = field(repr=False)
    ages: Mapping[str, FloatArray | None] = field(repr=False)
    remarks: tuple[str, ...] = ()

    @property
    def counted(self) -> FloatArray:
        """The deviations that the figures are of."""
        return self.deviations[self.first :]

    def age(self, sensor: str) -> Spread | None:
        """In ms where a rate is known, else in steps."""
        ages = self.ages[sensor]
        return None if ages is None else spread(ages * self.age_scale)

    def between(self, first: int, last: int) -> ScenarioAccuracy:
        """The figures of fewer steps, not before its own first nor after its own last."""
        ages = {
            sensor: None if ages is None else ages[first - self.first : last + 1 - self.first]
            for sensor, ages in self.ages.items()
        }
        deviations = self.deviations[: last + 1]
        return replace(self, first=first, last=last, spread=spread(deviations, first), deviations=deviations, ages=ages)

    @property
    def age_scale(self) -> float:
        """Of a step, in `age_unit`."""
        return 1.0 if self.hr_hz is None else float(1000 / self.hr_hz)

    @property
    def age_unit(self) -> str:
        return "steps" if self.hr_hz is None else "ms"


def question_of(
    scenario: Scenario,
    folder: Path,
    *,
    model: str | None = None,
    output: str | None = None,
    unit: str | None = None,
    initial_std: Sequence[float] | None = None,
) -> Question:
    """folder: of the scenario's file, which may ask too; what is given here comes first.

    Raises InputError that names what cannot be.
    """
    asked = AccuracyAsked() if scenario.accuracy is None else scenario.accuracy
    given = {"model": model, "output": output, "unit": unit, "initial_std": initial_std}
    spelled = SPELLING.get()

    def spelling(name: str) -> str:
        in_file = given.get(name) is None and getattr(asked, name, None) is not None
        return f"[accuracy] {name}" if in_file else spelled(name)

    token = SPELLING.set(spelling)
    try:
        where = folder if model is None else Path()
        loaded = load_scenario_model(asked.model if model is None else model, scenario, where, asked.sensors)
        start = _start(asked.initial_std if initial_std is None else initial_std, loaded.of.states)
        outputs = rows_of(loaded.model, output or asked.output, asked.unit if unit is None else unit)
        if start is None:
            _check_bounded(loaded, outputs)
        return Question(loaded, outputs, start)
    finally:
        SPELLING.reset(token)


def accuracy_along(
    question: Question, scenario: Scenario, outcome: Outcome, *, on_progress: OnProgress | None = None
) -> ScenarioAccuracy:
    """Of this outcome of this scenario. on_progress: called about a hundred times.

    Raises InputError where the filter does not settle and no start is given.
    """
    landings = sorted(
        ((name, k, l) for name, figures in outcome.sensors.items() for k, l in figures.landings),
        key=lambda landing: landing[2],
    )
    last, remarks = _followed(landings, scenario.steps, question.model.of.states)
    usual = settled_start(question.model.of, question.outputs.rows, scenario.sensors)
    if question.initial_std is None:
        if usual.P0 is None:
            raise InputError(
                f"{option('initial_std')} is missing: with the sensors' rates and dropouts the covariance does not "
                f"settle, and something has to be known of the start; give the standard deviation of each of the "
                f"{question.model.of.states} states in step 0"
            )
        starts = [usual]
    else:
        given = Start(np.diag(np.square(question.initial_std)), question.model.of, question.outputs.rows)
        starts = [given] if usual.P0 is None else [given, usual]
    runs = [
        _run(start, landings, last, _told(on_progress, number * (last + 1), len(starts) * (last + 1)))
        for number, start in enumerate(starts)
    ]
    last, too_large = _finite(runs, last)
    remarks += too_large
    deviations = [run.deviations[: last + 1] for run in runs]
    first = max((_first(outcome, sensor, last) for sensor in scenario.sensors), default=0)
    if len(runs) == 2:
        first, felt = _forgotten(deviations[0], deviations[1], first)
        remarks = [*remarks, felt]
    else:
        remarks = [*remarks, _since(scenario, first, question.initial_std is None)]
    return ScenarioAccuracy(
        question,
        scenario.hr_hz,
        first,
        last,
        spread(deviations[0], first),
        deviations[0],
        {sensor.name: _ages(sensor, runs[0].ages[sensor.name][first : last + 1], first) for sensor in scenario.sensors},
        (*remarks, *_remarks(scenario, outcome, question)),
    )


def _check_bounded(model: ScenarioModel, outputs: Outputs) -> None:
    try:
        visible(model.model.linear, outputs.rows)
    except ValueError as error:
        raise InputError(
            f"{option('output')} {short(outputs.name)}: {error}; or give {option('initial_std')}, and see what becomes "
            f"of it"
        ) from None


def _start(values: Sequence[float] | None, states: int) -> FloatArray | None:
    if values is None:
        return None
    found = np.asarray(values, dtype=float)
    if found.shape != (states,) or not np.isfinite(found).all() or (found < 0).any():
        raise InputError(
            f"{option('initial_std')} {short(str([*values]))}: give {states} numbers, 0 or more, one for each state"
        )
    return found


def _followed(landings: Sequence[tuple[str, int, int]], steps: int, states: int) -> tuple[int, list[str]]:
    """The last step that is looked at, and what to say where it is not the last of all. landings: as they land."""
    longest = MOST_KEPT_BYTES // (8 * states * states)
    back: dict[int, int] = {}
    for _, k, l in landings:
        back[l] = max(back.get(l, 0), l - k)
    done, last = 0, steps - 1
    for l, more in back.items():
        if done + more + l > MOST_PROPAGATIONS or more > longest:
            last = max(l - 1, 0)
            break
        done += more
    last = min(last, MOST_PROPAGATIONS - done)
    if last == steps - 1:
        return last, []
    return last, [f"the accuracy is of the first {last + 1:,} of {steps:,} steps only, as it takes so long"]


def _told(on_progress: OnProgress | None, before: int, total: int) -> Callable[[int], None] | None:
    if on_progress is None:
        return None
    stride = max(total // REPORTS, 1)

    def on_step(step: int) -> None:
        if step % stride == 0:
            on_progress(before + step, total, "steps of the accuracy")

    return on_step


def _run(
    start: Start, landings: Sequence[tuple[str, int, int]], last: int, on_step: Callable[[int], None] | None
) -> Along:
    P0, model, rows = start
    assert P0 is not None
    with np.errstate(all="ignore"):  # see _finite
        return along(model.Phi, model.Q, model.sensors, rows, P0, last, landings, on_step=on_step)


def _finite(runs: Sequence[Along], last: int) -> tuple[int, list[str]]:
    """The last step up to which all are numbers, and what to say where it is not the last."""
    usable = np.logical_and.reduce([np.isfinite(run.deviations) for run in runs])
    if usable.all():
        return last, []
    until = max(int(np.argmin(usable)) - 1, 0)
    return until, [f"up to step {until}: then it is too large for a number"]


def _first(outcome: Outcome, sensor: Sensor, last: int) -> int:
    """The step in which one of the sensor's corrections has landed; 0 if none does."""
    landed = min((l for _, l in outcome.sensors[sensor.name].landings), default=0)
    return landed if landed <= last else 0


def _forgotten(given: FloatArray, usual: FloatArray, first: int) -> tuple[int, str]:
    """From which step on the two are the same."""
    apart = np.flatnonzero(np.abs(given - usual) > FELT * usual)
    since = max(first, int(apart[-1]) + 1 if len(apart) else 0)
    if since < len(given):
        return since, f"from step {since} on, when the start given makes less than 1 % of difference"
    return first, f"from step {first} on, and to the end the start given makes more than 1 % of difference"


def _since(scenario: Scenario, first: int, from_settled: bool) -> str:
    when = "when the first correction" + (" of each sensor" if len(scenario.sensors) > 1 else "") + " has landed"
    said = f"from step {first} on, {when}"
    return f"{said}; it starts as it settles without delay" if from_settled else f"{said}; it does not settle"


def _ages(sensor: Sensor, ages: FloatArray, first: int) -> FloatArray | None:
    """From when measurements were taken. ages: from the steps in which they were, of each step from `first` on."""
    if not np.isfinite(ages).any():
        return None
    if not sensor.between_steps:
        return ages
    steps, which = np.unique(first + np.arange(len(ages)) - ages, return_inverse=True)
    waits = np.array([float(k - sensor.instant(int(k))) for k in steps.tolist()])
    return np.asarray(ages + waits[which])


def _overtaken(outcome: Outcome) -> bool:
    """Whether one lands before another of its sensor that was taken before."""
    orders = ([l for _, l in sorted(figures.landings)] for figures in outcome.sensors.values())
    return any(later < earlier for order in orders for earlier, later in pairwise(order))


def _remarks(scenario: Scenario, outcome: Outcome, question: Question) -> Iterator[str]:
    never = [sensor.name for sensor in scenario.sensors if not outcome.sensors[sensor.name].landings]
    if never:
        yield f"no correction of {', '.join(never)} lands: what is not seen grows for as long as is simulated"
    late = outcome.jobs["predict"].misses
    if late:
        yield (
            f"{late} predict jobs finish late, and so does the output of their steps: the figures are of it once it is "
            f"there"
        )
    if scenario.late != "recalculate" and (len(scenario.sensors) > 1 or _overtaken(outcome)):
        yield (
            f"the figures are of a filter that goes back to each measurement: late = {scenario.late} is not as good "
            f"where others land while one that was taken before is on its way, the less the more that one tells"
        )
    if question.model.linearised:
        yield "the model is linearised at its start"
