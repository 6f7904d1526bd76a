"""A Gantt panel of a scenario: the steps about its first missed deadline, or its first late measurement."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import ceil
from typing import NamedTuple

from reports.charts.lanes import shortened
from reports.charts.panels import Panel, steps_shown
from sched_sim.design.cycle_marks import Mark
from sched_sim.errors import InputError
from sched_sim.scenario.kinds import correct_kind
from sched_sim.scenario.outcome import Outcome
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Scenario
from sched_sim.schedule.intervals import jobs
from sched_sim.schedule.outcome import Schedule, Slice

FEWEST_STEPS, MOST_STEPS = 12, 24
CYCLES = 2
"""The slowest sensor's, as far as they are no more steps than that."""
AFTER_MISS = 2
"""Steps shown after the deadline."""
MOST_ASKED = 2_000
"""Steps of one picture."""
LEAST_BAR_MM = 0.5
"""A predict job of a fast processor is a bar all the same."""
BEFORE_ARRIVAL, AFTER_ARRIVAL = 4, 8
"""Steps shown about a late measurement's arrival, at the least."""


class Late(NamedTuple):
    """A measurement taken in step k that arrives in step m."""

    m: int
    k: int
    kind: str


def scenario_panel(scenario: Scenario, outcome: Outcome, steps: tuple[int, int] | None = None) -> Panel:
    """The steps of a scenario about its first missed deadline, or its first late measurement.

    outcome: of this scenario; it says where to look. The steps up to there are simulated again, to the same end.
    steps: the first shown instead, and the one at whose start the panel ends; k, m and l are then of the first late
    measurement that arrives there. Raises InputError for more than a chart can show.
    """
    late = first_late(scenario, 0 if steps is None else steps[0])
    first, last = steps or window(scenario, outcome.first_miss, late)
    if last - first > MOST_ASKED:
        raise InputError(
            f"a Gantt chart of {last - first} steps is too long, at most {MOST_ASKED} can be drawn: give fewer, or "
            f"write a trace"
        )
    slices: list[Slice] = []
    again = run_scenario(replace(scenario, steps=last), on_slice=slices.append)
    start = first * again.schedule.period
    last_of = {(piece.kind, piece.step): piece for piece in slices}
    alive = {job for job, piece in last_of.items() if not piece.finished or piece.end > start}
    shown = tuple(piece for piece in slices if (piece.kind, piece.step) in alive)
    schedule = replace(again.schedule, slices=shown)
    ms = None if scenario.hr_hz is None else float(1000 / scenario.hr_hz)
    pace = f"speed {float(scenario.speed):.4g}" if ms is None else f"HR period {ms:.4g} ms"
    return Panel(
        title=scenario.name,
        schedule=schedule,
        notes=(
            pace,
            scenario.late,
            steps_shown(first, last, scenario.steps),
            *_whose(scenario, late if late and late.k <= last else None),
        ),
        marks=_marks(scenario, late, schedule) if late else (),
        first=first,
        last=last,
        misses=_misses(outcome, schedule, first),
        least_bar_mm=LEAST_BAR_MM,
    )


def window(scenario: Scenario, first_miss: float | None, late: Late | None) -> tuple[int, int]:
    """The first step shown, and the one at whose start the panel ends."""
    cycles = ceil(CYCLES * max((sensor.every for sensor in scenario.sensors), default=0))
    width = min(max(cycles, FEWEST_STEPS), MOST_STEPS, scenario.steps)
    if first_miss is not None:
        first = ceil(first_miss) + AFTER_MISS - width
    elif late is not None and late.m + AFTER_ARRIVAL > width:
        first = late.m - BEFORE_ARRIVAL
    else:
        first = 0
    first = max(min(first, scenario.steps - width), 0)
    return first, first + width


def first_late(scenario: Scenario, start: int = 0) -> Late | None:
    """The late measurement that arrives first, from the step `start` on."""
    arrivals = [
        Late(step + delay, step, correct_kind(sensor))
        for sensor in scenario.sensors
        for step, delay in sensor.measurements(scenario.steps, scenario.seed)
        if delay and start <= step + delay < scenario.steps
    ]
    return min(arrivals, default=None)


def _whose(scenario: Scenario, late: Late | None) -> Sequence[str]:
    """Of which sensor k, m and l are, where there are several."""
    if late is None or len(scenario.sensors) < 2:
        return ()
    (name,) = [sensor.name for sensor in scenario.sensors if correct_kind(sensor) == late.kind]
    return (f"$k$, $m$, $l$ of {shortened(name)}",)


def _marks(scenario: Scenario, late: Late, schedule: Schedule) -> Sequence[Mark]:
    """k, m and l of this measurement."""
    (finish,) = [job.finish for job in jobs(schedule) if (job.kind, job.step) == (late.kind, late.k)] or [None]
    labels = {late.k: "k", late.m: "m"}
    if finish is not None:
        landed = scenario.lands(finish, schedule.period)
        labels[landed] = "m = l" if landed == late.m else "l"
    return [Mark(step, text, 0, text == "k") for step, text in labels.items()]


def _misses(outcome: Outcome, schedule: Schedule, first: int) -> str:
    """Misses of the whole simulation, and of the steps shown."""
    missed = outcome.misses
    if not missed:
        return ""
    start = first * schedule.period
    here = sum(job.missed and job.deadline >= start for job in jobs(schedule))
    released = sum(figures.released for figures in outcome.jobs.values())
    verb = "misses its" if missed == 1 else "miss their"
    return f"✗ {missed} of all {released} jobs {verb} deadline, {here} of them shown"
