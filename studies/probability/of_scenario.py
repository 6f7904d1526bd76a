"""Which scenarios are a design of one filter, so that the exact probability is had beside the sampled one.

One sensor, measured every so many whole steps from step 0 on, one measurement on its way at most; one processor, no
context switches, fixed offsets of tasks. Then:

    recalculate, carried-gain   with the sensor more urgent than the predictor: a correction holds up the predict job of
                                its step, and both are the HR job of the serial method. The correction waits for nothing
                                but what is more urgent: it lands as one of HR jobs that do nothing else.
    recalculate                 with the sensor less urgent: recalculate that HR jobs preempt. With a random delay or
                                losses the predict jobs alone, which are HR jobs without a measurement.
    dual-rate                   without loss, where all land before the next measurement: the dual-rate design with
                                precomputed gain, LR propagate due in step l.

Larsen's method multiplies transitions from step k + 1 on in a scenario, from k + 2 on in a design.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import NamedTuple

from sched_sim.design.drawn import NO_TABLE, kinds_by_piece
from sched_sim.design.options import Options
from sched_sim.design.timing import Timing
from sched_sim.probability.cost_distribution import CostDistribution
from sched_sim.probability.cost_file import PARTS
from sched_sim.probability.stated import StatedCost
from sched_sim.scenario.kinds import correct_kind
from sched_sim.scenario.scenario import Scenario, Sensor
from sched_sim.schedule.jobs import HR
from sched_sim.schedule.tasks import Task
from studies.probability.question import Question

MOST_CYCLES = 1000


class AsDesigns(NamedTuple):
    """predict: the design whose HR jobs miss as the predict jobs do; correct: that whose corrections land as they do,
    None where there is none, and why."""

    predict: Question
    correct: Question | None
    why: str = ""


def as_designs(scenario: Scenario) -> AsDesigns | str:
    """Or why there are none, in words."""
    if why := _no_design(scenario):
        return why
    (sensor,) = scenario.sensors
    if scenario.late == "dual-rate":
        both = _question(scenario, sensor, "dual-rate", Options(gain="precomputed", lr_propagate_by="l"))
        return AsDesigns(both, both)
    urgent = sensor.priority < scenario.priority
    method = "carried-gain" if scenario.late == "carried-gain" and sensor.delayed else "recalculate"
    if not urgent and method == "recalculate" and len(sensor.delays) == 1 and not sensor.dropout:
        both = replace(_question(scenario, sensor, method, Options()), preempted=True)
        return AsDesigns(both, both)
    if not urgent and method == "recalculate":
        alone = _question(scenario, sensor, "standard", Options(), without=("update",))
        alone = replace(alone, timing=Timing(1, 0, 0), delays=None, dropout=0.0, cycles=_cycles(scenario, 1))
        why = f"{correct_kind(sensor)} is preempted, and its delay is random or measurements are lost"
        return AsDesigns(alone, None, why)
    if not urgent:
        return "what predict jobs carry depends on when a correction that they preempt lands"
    if method == "carried-gain" and not _lands_at_once(scenario, sensor):
        return "what predict jobs carry depends on when a correction lands that takes longer than an HR period"
    both = _question(scenario, sensor, method, Options())
    at_once = ("update",) if method == "carried-gain" else ()  # done at k, by the predict job
    correct = _question(scenario, sensor, method, Options(), without=("propagate", "carry", *at_once), rival=sensor)
    return AsDesigns(both, correct)


def _no_design(scenario: Scenario) -> str:
    if len(scenario.sensors) > 1:
        return f"there are {len(scenario.sensors)} sensors, and a design has one"
    (sensor,) = scenario.sensors
    if scenario.cpus > 1 or scenario.context_switch:
        return "a scenario is a design only on one processor and without context switches"
    if scenario.late == "larsen" and sensor.delayed:
        return "Larsen's method multiplies transitions one step longer in a scenario than in a design"
    if sensor.between_steps or sensor.offset or any(Fraction(delay).denominator > 1 for delay in sensor.delays):
        return "measurements are not taken every so many whole steps from step 0 on, or arrive between steps"
    if sensor.longest_delay > sensor.every or (len(sensor.delays) > 1 and sensor.longest_delay == sensor.every):
        return "a measurement is taken before another has arrived"
    if scenario.late == "dual-rate" and sensor.dropout:
        return "the dual-rate filter of a scenario does more after a loss than a design says"
    if sensor.priority == scenario.priority:
        return f"priority {sensor.priority} of sensor and predictor: which goes first depends on the order of release"
    for task in scenario.tasks:
        if task.offset == "any" or task.jitter or not task.preemptive:
            return f"task {task.name!r} has no fixed offset, or jitter, or is not preemptive"
        if task.priority in (sensor.priority, scenario.priority):
            return f"task {task.name!r} has the priority of the sensor or the predictor"
    return ""


def _question(
    scenario: Scenario,
    sensor: Sensor,
    method: str,
    options: Options,
    *,
    without: Sequence[str] = (),
    rival: Sensor | None = None,
) -> Question:
    """without: pieces that are left out. rival: of whose corrections it is, which only more urgent tasks delay."""
    parts = {kind: part if part in scenario.costs else f"{part}.{sensor.name}" for kind, part in PARTS[method].items()}
    costs = {kind: _cost(scenario, scenario.costs[part]) for kind, part in parts.items() if part in scenario.costs}
    pieces = kinds_by_piece(method, tuple(PARTS[method]), options, NO_TABLE)
    delays = None if len(sensor.delays) == 1 else CostDistribution.of_samples(sensor.delays)
    N = int(sensor.every)
    return Question(
        method=method,
        costs=costs,
        constant=(),
        pieces={piece: None if piece in without else kind for piece, kind in pieces.items()},
        timing=Timing(N, sensor.least_delay, sensor.land_by),
        speed=scenario.speed,
        options=options,
        tasks=_tasks(scenario, scenario.priority if rival is None else rival.priority),
        delays=delays,
        dropout=sensor.dropout,
        cycles=_cycles(scenario, N),
    )


def _cycles(scenario: Scenario, N: int) -> int:
    return min(max(scenario.steps // N, 1), MOST_CYCLES)


def _lands_at_once(scenario: Scenario, sensor: Sensor) -> bool:
    """Whether a correction of the carried gain is always done when the predict job of its step begins."""
    urgent = any(task.priority < sensor.priority for task in scenario.tasks)
    return not urgent and max(scenario.costs[f"land.{sensor.name}"]) <= scenario.speed


def _cost(scenario: Scenario, values: Sequence[Fraction]) -> StatedCost:
    """Several values from a file are samples; in the scenario itself they are equally likely."""
    if len(values) > 1 and scenario.files:
        return StatedCost(values)
    return StatedCost(values, [Fraction(1, len(values))] * len(values))


def _tasks(scenario: Scenario, priority: int) -> list[Task]:
    """Those that are more urgent, and those between the predictor and a less urgent sensor, with such priorities in a
    design."""
    (sensor,) = scenario.sensors
    found = [replace(task, priority=HR - 1) for task in scenario.tasks if task.priority < priority]
    between = [task for task in scenario.tasks if priority < task.priority < sensor.priority]
    return found + [replace(task, priority=HR + 1) for task in between]
