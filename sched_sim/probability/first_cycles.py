"""The first cycles, one by one; from where nothing changes any more, the last ones again and again."""

from __future__ import annotations

from itertools import pairwise

from sched_sim.design.taken import Taken
from sched_sim.probability.long_run import Process, changed
from sched_sim.probability.tally import Tallies, Tally

SAME = 1e-14
"""A relative change of every mass that is rounding."""


def first_cycles(process: Process, cycles: int, taken: Taken, hyperperiod: int, begin: int, after: int) -> list[Tally]:
    """hyperperiod, begin: in steps, after which all repeats, and from which on; after: cycles until the correction of
    one has landed, or is no longer followed."""
    every = hyperperiod * taken.count // taken.steps
    tallies, state, followed, cycle = Tallies(), process.state(), cycles, 0
    while cycle < followed + after:
        if followed == cycles and not cycle % every:
            last, state = state, process.state()
            if taken.step(cycle) >= begin + hyperperiod and changed(last, state) < SAME:
                followed = min(cycle, cycles)
        process.advance(taken.step(cycle + 1), tallies)
        cycle += 1
    numbers = (n if n < followed else n - ((n - followed) // every + 1) * every for n in range(cycles))
    found = [tallies[number].scaled(1.0) for number in numbers]
    for before, tally in pairwise(found):
        tally.behind += before.behind
    return found
