"""Why a scenario's deadlines are missed, in words: one line for each cause."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from sched_sim.scenario.kinds import correct_kind
from sched_sim.scenario.load import catching_up, loads
from sched_sim.scenario.outcome import Outcome
from sched_sim.scenario.scenario import Scenario, Sensor
from sched_sim.shares import percent

SATURATED = 0.99
"""The share of its time from which a processor counts as always busy."""

ROUNDING = 1e-9
"""Relative; of sums of means."""


def causes(scenario: Scenario, outcome: Outcome, busy: Sequence[float]) -> list[str]:
    """busy: the share of each processor's simulated time. Nothing if no deadline is missed and the corrections land."""
    return [*_overload(scenario, outcome, busy), *_catching_up(scenario, outcome)]


def _overload(scenario: Scenario, outcome: Outcome, busy: Sequence[float]) -> Iterator[str]:
    if not outcome.misses:
        return
    parts = loads(scenario)
    for cpu, share in enumerate(busy):
        which = f"processor {cpu + 1}" if scenario.cpus > 1 else "the processor"
        here = [load for load in parts if load.cpu == cpu]
        demand = sum(load.share for load in here)
        if demand > 1 + ROUNDING:
            shares = ", ".join(f"{load.name} {load.share:.0%}" for load in here)
            piles_up = sum(load.share for load in here if not load.gives_way) > 1 + ROUNDING
            follows = "work piles up" if piles_up else "corrections wait for one another and go back together"
            yield f"demand is {_percent(demand)} of {which}, so that {follows}: {shares}"
        elif share > SATURATED:
            besides = " and ".join(_besides(scenario, cpu))
            comes = f", and besides comes {besides}" if besides else ""
            yield f"{which} is busy {percent(share)} of the time: demand is {demand:.1%}{comes}"


def _besides(scenario: Scenario, cpu: int) -> Iterator[str]:
    """What a processor does that is not in its demand."""
    late = [sensor.name for sensor in scenario.sensors if cpu == scenario.cpus - 1 and scenario.preempted(sensor)]
    if late and scenario.late != "dual-rate":
        yield f"what corrections of {', '.join(late)} do again because they take longer than their step"
    if scenario.context_switch:
        yield "what context switches take"


def _percent(share: float) -> str:
    """Of a share above 1, which never reads as 100%."""
    if share < 1.001:
        return "a little more than 100%"
    return f"{share:.1%}" if share < 1000 else f"{share:.2g} times the time"


def _catching_up(scenario: Scenario, outcome: Outcome) -> Iterator[str]:
    away = [sensor for sensor in scenario.sensors if _stay_away(outcome, sensor)]
    figures = catching_up(scenario) if away else {}
    for sensor in away:
        if sensor.name in figures and figures[sensor.name].never:
            needed, left = (
                _work(scenario, work) for work in (figures[sensor.name].needed, max(figures[sensor.name].left, 0.0))
            )
            yield (
                f"corrections of {sensor.name} never catch up: a step that passes meanwhile takes {needed} to do "
                f"again, and more urgent jobs leave {left} in each"
            )


def _stay_away(outcome: Outcome, sensor: Sensor) -> bool:
    """Whether corrections are overdue at the end of the simulated time, or most have not landed by then."""
    jobs, figures = outcome.jobs[correct_kind(sensor)], outcome.sensors[sensor.name]
    return jobs.decided > len(jobs.responses) or 2 * figures.not_landed > figures.arrived


def _work(scenario: Scenario, work: float) -> str:
    return f"{work:.3g} cost units" if scenario.hr_hz is None else f"{1000 * work:.3g} ms"
