"""The first cycles, one by one; from where nothing changes any more, the last ones again and again."""

from __future__ import annotations

from collections import defaultdict
from itertools import pairwise

from sched_sim.design.taken import Taken
from sched_sim.probability.long_run import Process, changed, shape_of
from sched_sim.probability.tally import Tallies, Tally
from sched_sim.schedule.clock import REPORTS, OnProgress

SAME = 1e-13
"""A relative change of every mass that is rounding."""


def first_cycles(
    process: Process,
    cycles: int,
    taken: Taken,
    hyperperiod: int,
    begin: int,
    after: int,
    on_progress: OnProgress | None,
) -> list[Tally]:
    """hyperperiod, begin: in steps, after which all repeats, and from which on; after: cycles until the correction of
    one has landed, or is no longer followed."""
    every = hyperperiod * taken.count // taken.steps
    tallies, shape, total, followed, cycle = Tallies(), shape_of(process), 1.0, cycles, 0
    stays = 1.0
    while cycle < followed + after:
        if followed == cycles and not cycle % every:
            (last, shape), (before, total) = (shape, shape_of(process)), (total, process.total)
            if taken.step(cycle) >= begin + hyperperiod and changed(last, shape) < SAME:
                followed, stays = min(cycle, cycles), total / before if before else 1.0
        if on_progress is not None and not cycle % max(cycles // REPORTS, 1):
            on_progress(min(cycle, cycles), cycles, "cycles")
        process.advance(taken.step(cycle + 1), tallies)
        cycle += 1
    found = []
    for number in range(cycles):
        times = max((number - followed) // every + 1, 0)
        found.append(tallies[number - times * every].with_probability(stays**times))
    for earlier, tally in pairwise(found):
        tally.behind += earlier.behind
    crowded = [tally.crowded for tally in found]
    for number, tally in enumerate(found):
        tally.crowded = defaultdict(float)
        for of_cycle in crowded[max(number - crowded_for(after), 0) : number + 1]:
            for charged, share in of_cycle.items():
                tally.crowded[charged] += share
    return found


def crowded_for(after: int) -> int:
    """Cycles in which HR jobs and tasks may still be delayed by the HR updates of a correction: until it has landed,
    and from then on until LR jobs run again, or it is not followed any more."""
    return 2 * after
