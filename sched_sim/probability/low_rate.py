"""What the low-rate jobs of the dual-rate filter follow from, and which of them is next."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

from sched_sim.design.timing import Timing
from sched_sim.probability.delay import Delay
from sched_sim.probability.high_rate import Pieces

EARLY, GAIN, UPDATE, FEEDBACK = range(4)
"""LR propagate; the gain, where it is precomputed; the LR update; the HR update, where it is a job of its own."""

Charge = Literal["where it lands", "most", "least"]


class Front(NamedTuple):
    """The LR job that runs or is to run next.

    cycle: 0 for the one that is not taken yet, -1 for the newest that is, and so on; drawn: it is there, and its work
    in the law; to_apply: HR updates that the next HR job has to do; missing: of this and each later cycle taken, how
    many corrections were not in the state at its k, 0 of this one from when its LR update is drawn, which they are in:
    so what goes on alike is followed once.
    """

    cycle: int
    stage: int
    drawn: bool
    to_apply: int = 0
    missing: tuple[int, ...] = ()


@dataclass(frozen=True)
class Design:
    """What the jobs follow from. early_due, update_due: steps after k. debt: cycles that the front may be behind.

    charge: where the HR update is charged. Costs rounded up bound the landings from above, and those rounded down from
    below, if it is not where it lands: with longer costs a correction may land later, its HR update with it, and the
    next LR job finish sooner. "most": behind the LR update at once and also where it lands. Proof: let B be the work up
    to and with some later LR job, that is released and not done. If the correction lands no later than in truth, B is
    at least the true one, for all that comes is more and comes then. If it lands later, the LR update was not done at
    the start of the step in which it truly landed; then B had in it the whole HR update behind it, and the job itself,
    as far as it was released, and in truth nothing more was left. "least": nowhere, so that all that comes is less.
    """

    timing: Timing
    pieces: Pieces
    delay: Delay | None
    early_due: int
    update_due: int
    same_step: bool
    two_cpus: bool
    precomputed: bool
    charge: Charge
    debt: int

    @property
    def usual(self) -> int:
        """HR updates at once, of a correction that lands by L."""
        return max(-(-self.timing.L // self.timing.N), 1)

    @property
    def charged(self) -> tuple[int, ...]:
        """So many HR updates in each step bound what HR jobs take, but where there are more: any number up to what one
        correction may have."""
        return {"where it lands": (), "least": (0,), "most": tuple(range(self.usual, self.debt + 2))}[self.charge]
