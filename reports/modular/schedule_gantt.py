"""One late GPS fix on the processor, each way: replayed as the loop goes on, replayed while it waits, or by Larsen."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import count

from filters.systems.rocket_filter import GPS
from reports.charts.panels import Panel
from reports.modular.styles import WAY_NAMES
from sched_sim.design.cycle_marks import Mark
from sched_sim.scenario.draws import fates
from sched_sim.scenario.run import run_scenario
from sched_sim.schedule.outcome import Response, Slice
from studies.modular.rocket_schedule import (
    DROPOUT,
    GPS_DELAYS,
    JOBS,
    PERIOD_MS,
    URGENCIES,
    WAYS,
    Costs,
    Way,
    scenario,
)

DELAY, BEFORE, AFTER = 15, 1, 4
"""Steps that the fix is late, and that are shown before its arrival and after."""
ON_TIME = "correct on time"


def fix_panels(costs: Costs, clock_mhz: int) -> list[Panel]:
    """The first fix of the extended filter."""
    recalculate, larsen = WAYS[1:]
    cases = [*((recalculate, urgency) for urgency in URGENCIES), (larsen, "preempted")]
    return [_panel(costs, way, urgency, clock_mhz) for way, urgency in cases]


def _panel(costs: Costs, way: Way, urgency: str, clock_mhz: int) -> Panel:
    slices: list[Slice] = []
    steps = DELAY + AFTER
    workload = scenario(costs, way, urgency, clock_mhz, steps=steps, seed=_seed())
    outcome = run_scenario(workload, on_slice=slices.append)
    marks = [Mark(DELAY, "m", 0, False, "the fix arrives")]
    landed = list(outcome.sensors[GPS].achieved)
    if landed == [DELAY]:
        marks = [Mark(DELAY, "m = l", 0, False, "the fix arrives, its correction lands")]
    elif landed:
        marks.append(Mark(landed[0], "l", 0, False, "its correction lands"))
    first = DELAY - BEFORE
    merged = [_merged(piece) for piece in slices]
    shown = tuple(piece for piece in merged if piece.end > first * piece.period)
    responses = {kind: figures for kind, figures in outcome.schedule.responses.items() if kind in _KINDS}
    responses[ON_TIME] = _response(merged, outcome.schedule.responses[JOBS["loop"]])
    lands = f"lands at $l = k+{landed[0]}$" if landed else "does not land here"
    late_ms = PERIOD_MS / outcome.schedule.period * outcome.schedule.responses[JOBS["loop"]].worst_lateness
    notes = [lands, f"loop late by {late_ms:.0f} ms" if late_ms else "loop in time"]
    schedule = replace(outcome.schedule, slices=shown, responses=responses)
    return Panel(f"{WAY_NAMES[way.name]}: {urgency}", schedule, notes, marks, first, steps)


_KINDS = ("predict", JOBS["GPS"], JOBS["control"])


def _merged(piece: Slice) -> Slice:
    """The corrections of a step by all other sensors as one job."""
    return piece if piece.kind in _KINDS else piece._replace(kind=ON_TIME)


def _response(merged: Sequence[Slice], of_last: Response) -> Response:
    """of_last: of the last of them in each step, so that times from release to finish are its own."""
    steps = {piece.step for piece in merged if piece.kind == ON_TIME}
    missed = {piece.step for piece in merged if piece.kind == ON_TIME and piece.missed}
    return replace(of_last, releases=len(steps), finished=len(steps), misses=len(missed))


def _seed() -> int:
    """The first that makes the first fix so late."""
    return next(seed for seed in count() if fates(GPS_DELAYS, DROPOUT, 1, seed, GPS) == [DELAY])
