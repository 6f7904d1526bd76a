"""The time that counted operations take on the desktop of the processor files, beside the time they take here."""

from __future__ import annotations

from collections.abc import Iterator

from benchmarks.timing import REPETITIONS, Result, repeated, seconds
from filters.registry import ALL_METHODS
from filters.systems.example import example_system
from sched_sim.costs.table_file import load_costs
from sched_sim.processors.part import on_part
from sched_sim.processors.part_file import load_part


def results() -> Iterator[Result]:
    on_desktop = on_part(load_costs("counted-9-3-3"), load_part("desktop"))
    jobs = ALL_METHODS["standard"].jobs(example_system(9, 3, 3), "textbook").values()
    estimated = sum(float(on_desktop.entry("standard", job.kind).minimum) for job in jobs)
    measured = sum(seconds(repeated(job.function, *job.arguments(0)), 61) / REPETITIONS for job in jobs)
    yield Result("standard filter step: estimate for a desktop over time here", estimated / measured, 1)
