"""Whether an emulated core counts instructions as they are, and the same ones again."""

from __future__ import annotations

from typing import NamedTuple

from filters.registry import ALL_METHODS
from filters.systems.example import example_system
from sched_sim.costs.table import CostTable
from studies.embedded.sources import SIZES
from studies.measurement.emulation.jobs import counted, emulate
from studies.measurement.emulation.targets import Target, precision_of
from studies.measurement.emulation.toolchain import run

LOOP = """
__attribute__((naked)) static void loop(void)
{
    __asm__ volatile("movw r0, #1000\\n 1: subs r0, #1\\n bne 1b\\n bx lr");
}

const Job jobs[] = {{loop, 0, 0}};
const int job_count = 1;
"""
INSTRUCTIONS = 1 + 2 * 1000
"""It sets its counter, then subtracts and branches a thousand times; its return belongs to the call."""


class Check(NamedTuple):
    """read: instructions of the known loop, in two runs. jobs: how many were run a second time; differing: of which the
    second run had another number, of any set of arguments."""

    target: str
    read: tuple[int, int]
    jobs: int
    differing: int


def check(target: Target, table: CostTable) -> Check:
    """table: what a first run on the target gave of the jobs.

    Raises:
        ValueError: a program cannot be compiled, or fails on the board.
    """
    first, again = (counted(run(target, {"jobs.c": LOOP}), target)[0][0][0] for _ in range(2))
    jobs = differing = 0
    for method, kinds in table.costs.items():
        of_method = ALL_METHODS[method].jobs(example_system(*SIZES), table.update_form)
        second = emulate(of_method, target, precision_of(target, None))
        jobs += len(kinds)
        differing += sum(
            cost.minimum != min(second[kind].instructions) or cost.p95 != max(second[kind].instructions)
            for kind, cost in kinds.items()
        )
    return Check(target.name, (first, again), jobs, differing)
