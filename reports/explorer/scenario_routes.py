"""What the explorer's server answers of a scenario."""

from __future__ import annotations

from reports.explorer.answer import Answer, Question, document
from studies.explorer.scenario_runs import Runs


def scenario_questions(runs: Runs) -> dict[str, Question]:
    """By path: its view, the schedule of some steps of its run, and the next miss."""

    def view(query: str) -> Answer:
        return document(runs.view(query))

    def schedule(query: str) -> Answer:
        return document(runs.schedule(query))

    def next_miss(query: str) -> Answer:
        return document(runs.next(query))

    return {"/scenario/view": view, "/scenario/schedule": schedule, "/scenario/next": next_miss}
