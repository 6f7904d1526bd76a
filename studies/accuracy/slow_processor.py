"""Which measurements to use, and how late they may land, where the processor is too slow for each before the next.

A camera at 50 Hz whose frames come M = 2 steps late, a loop at 200 Hz whose job takes 1, and 20 of work on each frame
that can begin when it has arrived. Units of work are the loop's job, speeds are in such units per HR period.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

from filters.accuracy import lossless
from sched_sim.design.pieces import DualRateCosts
from studies.accuracy.given import given

HR_HZ, FRAME_STEPS, DELAY_STEPS = 200, 4, 2
LOOP, FRAME = Fraction(1), Fraction(20)
EVERY = range(1, 9)
"""Every n-th frame is used."""


class Choice(NamedTuple):
    """speed: the least at which every n-th frame lands at L. worst: of the position, in m. several: whether the next
    frame in use is taken before this one has landed, L > n N."""

    every: int
    L: int
    speed: Fraction
    worst: float
    several: bool


def costs() -> DualRateCosts[Fraction]:
    """As the schedule has them."""
    zero = Fraction(0)
    return DualRateCosts(hr=LOOP, hr_restart=LOOP, hr_update=zero, lr_propagate=zero, lr_gain=zero, lr_update=FRAME)


def needed(every: int, L: int) -> Fraction:
    """What the loop leaves of L - M steps must do for a frame, and no more may come than is done, frames first in,
    first out: 1 + 20 / min(L - M, n N)."""
    return LOOP + FRAME / min(L - DELAY_STEPS, every * FRAME_STEPS)


def choices() -> list[Choice]:
    """For each n, every L from M + 1 to the one from which waiting longer needs no less, M + n N."""
    of = given("camera")

    def choice(n: int, L: int) -> Choice:
        N = n * FRAME_STEPS
        return Choice(n, L, needed(n, L), lossless(of.model, of.states, N, L).worst, several=N < L)

    return [choice(n, L) for n in EVERY for L in range(DELAY_STEPS + 1, DELAY_STEPS + n * FRAME_STEPS + 1)]


def best(all_choices: Sequence[Choice], speed: Fraction, *, several: bool) -> Choice | None:
    """The most accurate at this speed; several: those with several in flight too. None if nothing runs."""
    can = [choice for choice in all_choices if choice.speed <= speed and (several or not choice.several)]
    return min(can, key=lambda choice: choice.worst, default=None)


def at_speeds(all_choices: Sequence[Choice]) -> Mapping[Fraction, tuple[Choice | None, Choice]]:
    """By speed, wherever the best changes: the best with one frame in flight (None if there is none), and with
    several."""
    found: dict[Fraction, tuple[Choice | None, Choice]] = {}
    last: tuple[Choice | None, Choice | None] = None, None
    for speed in sorted({choice.speed for choice in all_choices}):
        pair = best(all_choices, speed, several=False), best(all_choices, speed, several=True)
        if pair != last and pair[1] is not None:
            found[speed] = pair[0], pair[1]
        last = pair
    return found
