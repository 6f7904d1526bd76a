"""A scenario's page asks again and again: what was found once is kept, for the last few that were asked for."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import NamedTuple

from sched_sim.bounds import short
from sched_sim.errors import InputError, option
from sched_sim.scenario.kinds import correct_kind
from sched_sim.scenario.outcome import Outcome
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Scenario
from sched_sim.ticks import exact as exact_number
from studies.explorer.document import all_visible
from studies.explorer.query import whole_number
from studies.explorer.scenario import scenario_view
from studies.explorer.scenario_asked import ScenarioAsked, asked_of
from studies.explorer.scenario_found import Accuracy, Exact, ScenarioFound, accuracy, exact
from studies.explorer.scenario_trace import Trace
from studies.explorer.scenario_window import Document, window
from studies.selection.in_scenario import Question

KEPT = 4
"""Runs; of traces one."""
AT_ONCE = 10_000
"""HR steps that one answer simulates for the trace, at most: a quarter of a second, and more on a busy machine."""
MOST_SHOWN = 2_000
"""HR steps of one window."""
OF = ("miss", "landing")


class Run(NamedTuple):
    """What a run depends on."""

    seed: int | None
    steps: int | None
    times_slower: object

    @classmethod
    def of(cls, asked: ScenarioAsked) -> Run:
        return cls(asked.seed, asked.steps, asked.times_slower)


class Runs:
    """The answers of a scenario's page to its queries, as documents for JSON; one at a time is to be asked for.

    scenario: as its file says; question: of the accuracy at its output, None if no model is stated. All raise
    InputError for what a query says wrongly, or what cannot be.
    """

    def __init__(self, scenario: Scenario, question: Question | None = None) -> None:
        self.scenario = scenario
        self.question = question
        self._outcome = lru_cache(KEPT)(self._run)
        self._exact = lru_cache(KEPT)(self._exactly)
        self._accuracy = lru_cache(KEPT)(self._accurately)
        self._trace = lru_cache(1)(self._begun)

    def view(self, query: str) -> Document:
        """`explore_scenario` of what the query asks."""
        asked, _ = asked_of(query)
        meant, run = asked.of(self.scenario), Run.of(asked)
        found = ScenarioFound(
            meant, self._outcome(run), self._exact(run, asked.exact), self._accuracy(run, asked.accuracy)
        )
        return scenario_view(self.scenario, asked, found).document()

    def schedule(self, query: str) -> Document:
        """The schedule of the steps from `first` to the start of `until`; None while it has not been simulated so far:
        then it is to be asked for again."""
        asked, more = asked_of(query, ("first", "until"))
        meant = asked.of(self.scenario)
        first, until = _window(more, meant.steps)
        trace = self._trace(Run.of(asked))
        shown = window(trace, first, until) if trace.learn(until, AT_ONCE) else None
        return {"schedule": shown, "simulated": trace.reached, "steps": meant.steps}

    def next(self, query: str) -> Document:
        """The first deadline after the instant `after`, in steps, that was missed, `of` any job ("miss") or of a
        correction ("landing"); None while it has not been simulated so far, or, where all has been, if there is
        none."""
        asked, more = asked_of(query, ("after", "of"))
        meant, after, of = asked.of(self.scenario), exact_number(more.get("after", "0"), "after"), more.get("of", OF[0])
        if of not in OF:
            raise InputError(f"{option('of')} is {short(repr(of))}: choose from {', '.join(OF)}")
        kinds = {correct_kind(sensor) for sensor in meant.sensors} if of == "landing" else None
        trace = self._trace(Run.of(asked))
        found = trace.search(float(after), kinds, AT_ONCE)
        return {"found": all_visible(found), "simulated": trace.reached, "steps": meant.steps}

    def _run(self, run: Run) -> Outcome:
        return run_scenario(self._of(run))

    def _exactly(self, run: Run, asked: bool) -> Exact:
        return exact(self._of(run), asked)

    def _accurately(self, run: Run, asked: bool) -> Accuracy:
        return accuracy(self._of(run), self._outcome(run), self.question, asked)

    def _begun(self, run: Run) -> Trace:
        return Trace(self._of(run))

    def _of(self, run: Run) -> Scenario:
        return ScenarioAsked(**run._asdict()).of(self.scenario)


def _window(more: Mapping[str, str], steps: int) -> tuple[int, int]:
    """From `first` to before `until`, within so many steps."""
    for key in ("first", "until"):
        if key not in more:
            raise InputError(f"{option(key)} is missing: give first and until, steps of the run")
    first, until = (whole_number(key, more[key]) for key in ("first", "until"))
    if not 0 <= first < until <= steps:
        raise InputError(
            f"{option('first')} {short(first)} and {option('until')} {short(until)}: give 0 <= first < until <= {steps}"
        )
    if until - first > MOST_SHOWN:
        raise InputError(f"{option('until')} is {until - first:,} steps after first: give at most {MOST_SHOWN:,}")
    return first, until
