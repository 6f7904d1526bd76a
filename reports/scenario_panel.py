"""A Gantt panel of a scenario: its first steps, or those before the first missed deadline."""

from __future__ import annotations

from dataclasses import replace
from math import ceil

from reports.panels import Panel
from sched_sim.scenario import Scenario
from sched_sim.scenario_run import Outcome, run_scenario
from sched_sim.schedule import Slice

FEWEST_STEPS, MOST_STEPS = 12, 60
AFTER_MISS = 2
"""Steps shown after the deadline."""


def scenario_panel(scenario: Scenario, outcome: Outcome) -> Panel:
    """outcome: of this scenario; it says where to look. The steps up to there are simulated again, to the same end."""
    needed = max((sensor.offset + sensor.land_by + 1 + AFTER_MISS for sensor in scenario.sensors), default=FEWEST_STEPS)
    width = min(max(needed, FEWEST_STEPS), MOST_STEPS)
    last = width if outcome.first_miss is None else max(ceil(outcome.first_miss) + AFTER_MISS, width)
    last = min(last, scenario.steps)
    slices: list[Slice] = []
    again = run_scenario(replace(scenario, steps=last), on_slice=slices.append)
    first = max(last - width, 0)
    alive = {(piece.kind, piece.step) for piece in slices if piece.end > first * piece.period}
    shown = tuple(piece for piece in slices if (piece.kind, piece.step) in alive)
    ms = None if scenario.hr_hz is None else float(1000 / scenario.hr_hz)
    return Panel(
        title=scenario.name,
        schedule=replace(again.schedule, slices=shown),
        notes=(f"speed {float(scenario.speed):.4g}" if ms is None else f"HR period {ms:.4g} ms", scenario.late),
        first=first,
        last=last,
    )
