"""One late GPS fix on the processor, each way: replayed as the loop goes on, replayed while it waits, or by Larsen; on
slower and on faster processors."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import count

from filters.systems.rocket_filter import GPS
from reports.charts.panels import Panel
from reports.modular.styles import WAY_NAMES
from reports.pages.pictures import Frame
from reports.pages.stored import Rows
from sched_sim.design.cycle_marks import Mark
from sched_sim.scenario.draws import fates
from sched_sim.scenario.run import run_scenario
from sched_sim.schedule.intervals import TASK, bars
from sched_sim.schedule.outcome import Response, Slice
from studies.modular.rocket_schedule import (
    DROPOUT,
    GPS_DELAYS,
    JOBS,
    PERIOD_MS,
    URGENCIES,
    WAYS,
    Costs,
    MissRow,
    Way,
    scenario,
    slowest_that_holds,
)

DELAY, BEFORE, AFTER = 15, 1, 4
"""Steps that the fix is late, and that are shown before its arrival and after."""
LOOP = "correct loop"
"""The kind of all that a step predicts and corrects on time, as one job."""


def clocks_shown(misses: Iterable[MissRow]) -> list[int]:
    """Those that were tried, in MHz: from the slowest with which one of the ways holds to the slowest with which all
    extended ones do."""
    rows = list(misses)
    cases = [(way.name, urgency) for way in WAYS if way.predictor == "extended" for urgency in URGENCIES]
    held = [clock for case in cases if (clock := slowest_that_holds(rows, *case)) is not None]
    return sorted({row.clock_mhz for row in rows if min(held) <= row.clock_mhz <= max(held)})


def fix_frames(costs: Costs, clocks_mhz: Iterable[int]) -> dict[int, Frame]:
    """`fix_panels` on a processor of each of these clocks."""
    return {clock: _frame(clock, fix_panels(costs, clock)) for clock in clocks_mhz}


def _frame(clock_mhz: int, panels: Sequence[Panel]) -> Frame:
    last = [panel.marks[-1] for panel in panels]
    landed = ["later" if mark.text == "m" else str(mark.step) for mark in last]
    return Frame(f"{clock_mhz} MHz: l − k = {', '.join(landed)}", panels)


def fix_rows(frames: Mapping[int, Frame]) -> Rows:
    """What the frames show: a row for each piece of work, with times in steps."""
    rows: Rows = [["clock, MHz", "late fix", "job", "number", "work", "from, steps", "to, steps", "ends late"]]
    for clock, frame in frames.items():
        for panel in frame.panels:
            for bar in bars(panel.schedule):
                ends = [f"{end / panel.schedule.period:.3f}" for end in (bar.start, bar.end)]
                late = "no" if bar.overdue is None else "yes"
                rows.append([clock, panel.title, bar.row.name, bar.step, bar.style.removeprefix(TASK), *ends, late])
    return rows


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
    responses[LOOP] = _response(slices, outcome.schedule.responses[JOBS["loop"]])
    lands = f"lands at $l = k+{landed[0]}$" if landed else "does not land here"
    late_ms = PERIOD_MS / outcome.schedule.period * outcome.schedule.responses[JOBS["loop"]].worst_lateness
    notes = [lands, f"loop late by {late_ms:.0f} ms" if late_ms else "loop in time"]
    schedule = replace(outcome.schedule, slices=shown, responses=responses)
    return Panel(f"{WAY_NAMES[way.name]}: {urgency}", schedule, notes, marks, first, steps)


_KINDS = (JOBS["GPS"], JOBS["control"])


def _merged(piece: Slice) -> Slice:
    """The prediction of a step and its corrections by all other sensors as one job."""
    return piece if piece.kind in _KINDS else piece._replace(kind=LOOP)


def _response(slices: Sequence[Slice], of_last: Response) -> Response:
    """of_last: of the last of them in each step, so that times from release to finish are its own."""
    last = {(piece.kind, piece.step): piece for piece in slices if piece.kind not in _KINDS}
    steps = {step for _, step in last}
    unfinished = {piece.step for piece in last.values() if not piece.finished}
    missed = {piece.step for piece in last.values() if piece.missed}
    return replace(of_last, releases=len(steps), finished=len(steps - unfinished), misses=len(missed))


def _seed() -> int:
    """The first that makes the first fix so late."""
    return next(seed for seed in count() if fates(GPS_DELAYS, DROPOUT, 1, seed, GPS) == [DELAY])
