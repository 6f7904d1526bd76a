"""Why a scenario's deadlines are missed, in words: one line for each cause."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sched_sim.composed import correct_kind

if TYPE_CHECKING:
    from sched_sim.scenario import Scenario, Sensor
    from sched_sim.scenario_run import Outcome


def causes(scenario: Scenario, outcome: Outcome) -> list[str]:
    """Nothing if no deadline is missed and the corrections land."""
    return [*(_demand(scenario) if outcome.misses else ()), *_catching_up(scenario, outcome)]


def _demand(scenario: Scenario) -> Iterator[str]:
    from sched_sim.scenario_landing import ROUNDING
    from sched_sim.scenario_load import demand, loads, switching

    parts = loads(scenario)
    for cpu, (share, switches) in enumerate(zip(demand(scenario), switching(scenario), strict=True)):
        which = f"processor {cpu + 1}" if scenario.cpus > 1 else "the processor"
        besides = f", and context switches up to {switches:.1%} more" if switches else ""
        here = [load for load in parts if load.cpu == cpu]
        if share > 1 + ROUNDING:
            shares = ", ".join(f"{load.name} {load.share:.0%}" for load in here)
            piles_up = sum(load.share for load in here if not load.gives_way) > 1 + ROUNDING
            follows = "work piles up" if piles_up else "corrections wait for one another and go back together"
            yield f"demand is {share:.1%} of {which}{besides}, so that {follows}: {shares}"
        elif share + switches > 1 + ROUNDING:
            yield f"demand is {share:.1%} of {which}{besides}, so that work may pile up"


def _catching_up(scenario: Scenario, outcome: Outcome) -> list[str]:
    from sched_sim.scenario_load import catching_up

    lines = []
    for sensor in scenario.sensors:
        found = catching_up(scenario, sensor)
        if found and found.never and _stay_away(outcome, sensor):
            needed, left = (_work(scenario, work) for work in (found.needed, max(found.left, 0.0)))
            lines.append(
                f"corrections of {sensor.name} never catch up: a step that passes meanwhile takes {needed} to do "
                f"again, and more urgent jobs leave {left} in each"
            )
    return lines


def _stay_away(outcome: Outcome, sensor: Sensor) -> bool:
    """Whether corrections are overdue at the end of the simulated time, or most have not landed by then."""
    jobs, figures = outcome.jobs[correct_kind(sensor)], outcome.sensors[sensor.name]
    return jobs.decided > len(jobs.responses) or 2 * figures.not_landed > figures.arrived


def _work(scenario: Scenario, work: float) -> str:
    return f"{work:.3g} cost units" if scenario.hr_hz is None else f"{1000 * work:.3g} ms"
