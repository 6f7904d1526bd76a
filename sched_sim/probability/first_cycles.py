"""The first cycles, one by one; from where nothing changes any more, the last ones again and again."""

from __future__ import annotations

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
        if cycle >= after:
            tallies[cycle - after].behind = process.behind
        cycle += 1
    return [
        tallies[number] if number < followed else _repeated(tallies, number, followed, every)
        for number in range(cycles)
    ]


def _repeated(tallies: Tallies, number: int, followed: int, every: int) -> Tally:
    """As the one that many hyperperiods before, but for what has fallen behind since, at the same rate."""
    times = (number - followed) // every + 1
    same = tallies[number - times * every]
    tally = same.scaled(1.0)
    tally.behind += times * (same.behind - tallies[max(number - (times + 1) * every, 0)].behind)
    return tally
