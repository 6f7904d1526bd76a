"""What was simulated and what ran, one below the other, over the same steps."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction

from reports.charts.panels import Panel, landing_note, steps_shown
from sched_sim.design.cycle_marks import Mark, cycle_marks
from sched_sim.design.simulate import simulate
from sched_sim.schedule.outcome import Schedule
from studies.live.measure import Measured
from studies.live.slices import responses_of, schedule_of

MOST_CYCLES = 2
"""Shown."""
MOST_STEPS = 60
"""Of those; else of one cycle."""


def beside_panels(measured: Measured, *, swapped: bool = False) -> list[Panel]:
    """The cycle that `Measured.shown_cycle` names, and the next where there is room."""
    design = measured.design
    cycle = measured.shown_cycle()
    more = cycle < design.cycles and MOST_CYCLES * design.N <= MOST_STEPS
    cycles = MOST_CYCLES if more else 1
    first, last = cycle * design.N, (cycle + cycles) * design.N
    schedule = simulate(design.costs, design.timing, design.speed, cycle + cycles + 1, keep_slices=True)
    landed = {
        number: l
        for number, l in enumerate(measured.achieved[cycle - 1 : cycle - 1 + cycles])
        if l is not None and number * design.N + l <= last - first
    }
    pace = f"speed {float(design.speed):.4g}"
    shown = steps_shown(first, last, design.steps)
    priorities = ["LR above HR"] if swapped else []
    ran = schedule_of(measured.ran.jobs, design, swapped=swapped)
    predicted = dict.fromkeys(range(cycles), measured.predicted)
    return [
        _panel("Simulated", measured, schedule, predicted, (first, last), [pace]),
        _panel("Measured", measured, ran, landed, (first, last), [*priorities, shown]),
    ]


def _panel(
    title: str,
    measured: Measured,
    schedule: Schedule,
    landed: dict[int, int],
    shown: tuple[int, int],
    notes: list[str],
) -> Panel:
    first, last = shown
    timing, period = measured.design.timing, schedule.period
    seen = _within(schedule, first * period, last * period)
    marks = list(_moved(cycle_marks(timing, (last - first) // timing.N, landed), first))
    landing = landing_note(landed.values(), timing.M)
    return Panel(title, seen, (*notes, landing), marks, first=first, last=last)


def _within(schedule: Schedule, start: int, end: int) -> Schedule:
    """Without jobs that had ended before `start`, or come after `end`."""
    slices = tuple(piece for piece in schedule.slices if piece.end > start and piece.release < end)
    kept = {(piece.kind, piece.step) for piece in slices}
    slices = tuple(piece for piece in schedule.slices if (piece.kind, piece.step) in kept)
    return replace(schedule, slices=slices, responses=responses_of(slices))


def _moved(marks: list[Mark], steps: int) -> Iterator[Mark]:
    for mark in marks:
        yield mark._replace(step=mark.step + steps)


def rate_of(measured: Measured) -> Fraction:
    """Of the HR loop, in Hz."""
    return Fraction(10**9, measured.design.period_ns)
