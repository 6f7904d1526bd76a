"""A trace of what was simulated and of what ran, as two processors."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

from sched_sim.design.simulate import simulate
from sched_sim.schedule.trace import open_trace
from studies.live.measure import Measured
from studies.live.slices import schedule_of

NAMES = ("simulated", "measured")


def write_both(measured: Measured, path: Path, *, swapped: bool = False) -> None:
    """Every slice, in ms from step 0 on. Raises InputError as `open_trace` does."""
    design = measured.design
    with open_trace(path, Fraction(10**9, design.period_ns), NAMES) as write:
        simulate(design.costs, design.timing, design.speed, design.cycles + 1, on_slice=write)
        for piece in schedule_of(measured.ran.jobs, design, swapped=swapped).slices:
            write(piece._replace(cpu=1))
