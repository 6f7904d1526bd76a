"""The sentence that answers what a scenario asks, and what else is to be known of it."""

from __future__ import annotations

from collections.abc import Iterator

from sched_sim import shares
from sched_sim.scenario.causes import causes
from sched_sim.scenario.kinds import correct_kind
from sched_sim.scenario.said import INTERVAL, WITHHELD, phases_note
from sched_sim.scenario.scenario import Scenario
from studies.explorer.scenario_found import ScenarioFound
from studies.explorer.scenario_jobs import as_percent, nouns, sentence

FEW = 3
"""Kinds of job with misses that are told one by one."""


def answer(found: ScenarioFound) -> str:
    """Such as "In 100,000 steps (1,000 s) 3 of 20,000 corrections of gps landed late, 0.015 %, 95 % interval ..."."""
    scenario, jobs = found.scenario, found.outcome.jobs
    missing = sorted((kind for kind in jobs if jobs[kind].misses), key=lambda kind: -_share(found, kind))
    start = f"In {_duration(scenario)} "
    if missing:
        told = "; ".join(sentence(scenario, kind, jobs[kind]) for kind in missing[:FEW])
        return start + told + (f"; {len(missing) - FEW} more kinds of job missed theirs" if missing[FEW:] else "")
    decided = {kind: figures for kind, figures in jobs.items() if figures.decided}
    if not decided:
        return f"{start}no job finished, and none was due"
    if scenario.harness:
        return f"{start}no deadline was missed"
    fewest = min(decided, key=lambda kind: decided[kind].decided)
    interval = decided[fewest].miss_interval
    assert interval is not None
    many, _ = nouns(fewest)
    bound = as_percent(shares.at_most(interval[1]))
    return f"{start}no deadline was missed; what is rarer than in {bound} of the {many} would not have been seen"


def _share(found: ScenarioFound, kind: str) -> float:
    return found.outcome.jobs[kind].miss_probability or 0.0


def _duration(scenario: Scenario) -> str:
    steps = f"{scenario.steps:,} step{'' if scenario.steps == 1 else 's'}"
    return steps if scenario.hr_hz is None else f"{steps} ({float(scenario.steps / scenario.hr_hz):.4g} s)"


def warnings(found: ScenarioFound) -> list[str]:
    """Why deadlines are missed, and what has not landed."""
    outcome = found.outcome
    busy = [ticks / outcome.schedule.horizon for ticks in outcome.busy]
    return [*causes(found.scenario, outcome, busy), *_not_landed(found)]


def _not_landed(found: ScenarioFound) -> Iterator[str]:
    for sensor in found.scenario.sensors:
        name, figures = sensor.name, found.outcome.sensors[sensor.name]
        corrections = found.outcome.jobs[correct_kind(sensor)]
        if corrections.decided > len(corrections.responses):
            yield (
                f"{figures.not_landed:,} of {figures.arrived:,} measurements of {name} that arrived had not landed at "
                f"the end"
            )


def notes(found: ScenarioFound, left_out: int) -> list[str]:
    """left_out: so many steps of the file are not simulated, unasked."""
    scenario = found.scenario
    said = [WITHHELD if scenario.harness else INTERVAL, phases_note(scenario)]
    if left_out:
        said.insert(0, f"{scenario.steps:,} of the {scenario.steps + left_out:,} steps of the file are simulated")
    return [note for note in said if note]
