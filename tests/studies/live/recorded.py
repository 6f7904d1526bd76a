"""Designs and runs for tests: what live.c printed on a loaded virtual machine, and what a perfect kernel would do."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

from sched_sim.costs.table_file import load_costs
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.simulate import simulate
from studies.live.design import Design, of_dual_rate
from studies.live.jobs import Job, Ran, parsed
from studies.live.measure import Measured, measured

MS = 1_000_000
RECORDED = 8
"""Cycles of the recorded runs."""
NAMES = {"HRP": "hr_propagate", "HRU": "hr_update", "LRP": "lr_propagate", "LRU": "lr_update"}


def design(speed: str = "0.85", cycles: int = RECORDED, period_ns: int = 10 * MS, N: int = 10, M: int = 4) -> Design:
    costs = select(load_costs("steffes2014"), "dual-rate", Options())
    return Design(of_dual_rate(costs), N, M, Fraction(speed), period_ns, cycles)


def recorded(name: str) -> Ran:
    """`ordinary`, or `swapped` with LR above HR: eight cycles of the paper's costs at speed 0.85, in periods of 10 ms,
    without a disturbance."""
    return parsed((Path(__file__).with_name(f"{name}.csv")).read_text(encoding="utf-8").splitlines())


def judged(name: str) -> Measured:
    return measured(recorded(name), design(), 7)


def perfect(of: Design) -> list[Job]:
    """The jobs of a run from which nothing is taken: those that are simulated, HR's first."""
    spans: dict[tuple[str, int], list[tuple[int, int]]] = {}
    for label, step, start, end in simulated(of):
        spans.setdefault((NAMES[label], step), []).append((start, end))
    jobs = [
        Job(kind, step, runs[0][0], runs[-1][1], sum(end - start for start, end in runs))
        for (kind, step), runs in spans.items()
    ]
    return sorted(jobs, key=lambda job: (not job.high, job.start))


def simulated(of: Design) -> list[tuple[str, int, int, int]]:
    """Label, step, start and end in ns of each stretch, from step 1 on, as the run begins."""
    schedule = simulate(of.costs, of.timing, of.speed, of.cycles + 2, keep_slices=True)
    scale = Fraction(of.period_ns, schedule.period)
    return [
        (label, piece.step, round(start * scale), round(end * scale))
        for piece in schedule.slices
        for label, start, end in piece.pieces()
        if (1 <= piece.step <= of.steps if piece.kind == "hr" else piece.step < of.steps)
    ]
