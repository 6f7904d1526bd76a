"""What is found of a scenario: its run, its exact probabilities and the accuracy of its output, as far as asked for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from sched_sim.errors import InputError
from sched_sim.scenario.outcome import Outcome
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.said import WITHHELD
from sched_sim.scenario.scenario import Scenario
from studies.explorer.scenario_asked import ScenarioAsked
from studies.probability.beside_sampled import Beside, beside_sampled, followed
from studies.selection.in_scenario import Question, ScenarioAccuracy, accuracy_along

SHORT = 200_000
"""So many propagations of the covariance, a second, are made unasked."""


@dataclass(frozen=True, slots=True)
class NotAsked:
    """It was not asked for, and takes its time: how long, in words."""

    takes: str


Exact: TypeAlias = "Beside | NotAsked | str"
Accuracy: TypeAlias = "ScenarioAccuracy | NotAsked | str | None"
"""What there is, or why there is none; no accuracy where no model is stated."""

EXACT_TAKES = "mostly some seconds, now and then a minute"
ACCURACY_TAKES = "some seconds to half a minute"


@dataclass(frozen=True, slots=True)
class ScenarioFound:
    """scenario: as it was asked for; exact, accuracy: or why there is none, in words; accuracy is None
    where no model is stated."""

    scenario: Scenario
    outcome: Outcome
    exact: Exact
    accuracy: Accuracy


def find(scenario: Scenario, asked: ScenarioAsked, question: Question | None = None) -> ScenarioFound:
    """question: of the accuracy, None if no model is stated. Raises InputError for what cannot be simulated."""
    meant = asked.of(scenario)
    outcome = run_scenario(meant)
    return ScenarioFound(meant, outcome, exact(meant, asked.exact), accuracy(meant, outcome, question, asked.accuracy))


def exact(scenario: Scenario, asked: bool) -> Exact:
    if scenario.harness:
        return WITHHELD
    if isinstance(why := followed(scenario), str):
        return why
    if not asked:
        return NotAsked(EXACT_TAKES)
    try:
        return beside_sampled(scenario)
    except InputError as error:
        return str(error)


def accuracy(scenario: Scenario, outcome: Outcome, question: Question | None, asked: bool) -> Accuracy:
    if question is None:
        return None
    if not asked and _propagations(scenario, outcome) > SHORT:
        return NotAsked(ACCURACY_TAKES)
    try:
        return accuracy_along(question, scenario, outcome)
    except InputError as error:
        return str(error)


def _propagations(scenario: Scenario, outcome: Outcome) -> int:
    """At most: every landing goes back by itself."""
    back = sum(L * count for figures in outcome.sensors.values() for L, count in figures.achieved.items())
    return scenario.steps + back
