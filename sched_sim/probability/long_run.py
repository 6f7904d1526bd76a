"""The mean of a cycle after infinitely many, by renewal: over all that happens between two visits to one state.

Followed from that state on, without what has returned to it; what is left is less and less. Where it is long the same
but for its mass, the rest is a geometric series, or if nothing returns, what is left is all that there is in the long
run: one late execution may make every later cycle late. It is so too where some work is always left, for then there is
no such state. Nothing is subtracted, so that the smallest figure is as accurate as the largest.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from typing import Protocol

import numpy as np

from sched_sim.probability.outcome import Floats
from sched_sim.probability.tally import Tallies, Tally

SETTLED = 1e-8
"""A relative change of every mass from one hyperperiod to the next, at which it has settled."""
NEGLIGIBLE = 1e-13
"""Relative to a figure, what may be missing of it."""
RESOLVED = 1e-26
"""Of masses below, no change is waited for."""
WARM_UP = 8
"""Hyperperiods."""
MOST_LAWS = 300_000
"""Laws that are followed for a step, before it is said that they do not settle."""

State = Mapping[Hashable, Floats]


class Process(Protocol):
    """Something that happens step by step; see `Serial`."""

    step: int
    weight: float

    @property
    def total(self) -> float: ...

    @property
    def behind(self) -> float: ...

    def advance(self, end: int, tallies: Tallies) -> None: ...

    def clear(self) -> dict[Hashable, float]: ...

    def restart(self, key: Hashable) -> None: ...

    def take(self, key: Hashable) -> float: ...

    def state(self) -> State: ...


def long_run(process: Process, hyperperiod: int, begin: int) -> Tally | None:
    """Of one hyperperiod, in steps, in the mean; from step `begin` on all is periodic. None if it does not settle."""
    process.advance(max(process.step, begin) + WARM_UP * hyperperiod, Tallies())
    state = _most_frequent(process, hyperperiod)
    if state is not None:
        process.restart(state)
    if not process.total:
        return None
    whole, length = Tally(), 0.0
    shape: State | None = None
    followed = 0
    while followed < MOST_LAWS:
        weight = process.weight = process.total
        tallies, behind = Tallies(), process.behind
        process.advance(process.step + hyperperiod, tallies)
        fell, returned = process.behind - behind, 0.0 if state is None else process.take(state)
        tally = tallies.together()
        whole.add(tally)
        length += weight
        left = process.total
        if not left or _adds_nothing(tally, whole):
            return whole.scaled(1 / length)
        last, shape = shape, shape_of(process)
        followed += hyperperiod * len(shape)
        if last is not None and changed(last, shape) < SETTLED:
            leaves = (returned + fell) / weight
            if not leaves:
                return tally.scaled(1 / weight)
            whole.add(tally, left / weight / leaves)
            return whole.scaled(1 / (length + left / leaves))
    return None


def _most_frequent(process: Process, hyperperiod: int) -> Hashable | None:
    """A state without work left, and the process at the start of a step in which it is; None if there is none."""
    found = []
    for offset in range(hyperperiod):
        found += [(share, -offset, key) for key, share in process.clear().items() if share]
        process.advance(process.step + 1, Tallies())
    if not found:
        return None
    _, back, state = max(found, key=lambda each: each[:2])
    process.advance(process.step - back, Tallies())
    return state


def shape_of(process: Process) -> State:
    """Its laws, but for what is no longer followed."""
    total = process.total or 1.0
    return {key: mass / total for key, mass in process.state().items()}


def _adds_nothing(tally: Tally, whole: Tally) -> bool:
    """Whether every figure would be the same without it."""
    known = dict(whole.figures())
    return all(bool((more <= NEGLIGIBLE * known[name][: len(more)]).all()) for name, more in tally.figures())


def changed(last: State, state: State) -> float:
    """The largest relative change of a mass."""
    largest = 0.0
    for key in last.keys() | state.keys():
        one, other = last.get(key, np.zeros(1)), state.get(key, np.zeros(1))
        length = max(len(one), len(other))
        one, other = (np.pad(mass, (0, length - len(mass))) for mass in (one, other))
        most = np.maximum(one, other)
        worth = most > RESOLVED
        if worth.any():
            largest = max(largest, float((np.abs(one - other)[worth] / most[worth]).max()))
    return largest
