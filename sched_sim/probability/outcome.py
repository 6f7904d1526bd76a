"""What the exact probability says: for each measurement cycle and in the long run, with a lower and an upper bound."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

Floats: TypeAlias = npt.NDArray[np.float64]


class Bounds(NamedTuple):
    """Between which a probability lies; equal where it is exact."""

    lower: float
    upper: float


class Tail(NamedTuple):
    """P(response > x) at x = 0, 1, 2, ... ticks, `Probabilities.ticks` of which are an HR period; beyond the last x it
    is what it is there, or less. Both arrays have the same length."""

    lower: Floats
    upper: Floats


@dataclass(frozen=True, slots=True, eq=False)
class CycleProbabilities:
    """Of the jobs and the correction of one measurement cycle: the steps from one k to the next.

    misses: by job kind ("hr"; of dual-rate "lr_propagate", also with the gain, and "lr_update"; "task:NAME" of each
        task that is more urgent than LR jobs) the probability that a job misses its deadline, the mean of those that
        are released in the cycle, or due in it; no entry where none is.
    landing: P(L = l) of the cycle's measurement, for each l that was seen, at most `behind` for others; they do not sum
        to 1 where measurements are lost, `Probabilities.lost`, or where some mass is further behind than is followed.
    late: P(the correction lands later than the design's L) of those that arrive; where the HR job of m corrects, and m
        is certain, later than in step m.
    responses: by job kind, "hr", "task:NAME", and where m is certain "lr_update": how long a job takes from its
        release; of preempted recalculate the correction, from its arrival until it has landed.
    behind: the mass that was further behind than is followed, in some cycle up to this one; in the long run, where what
        falls so far behind starts anew, the share of cycles until it has caught up, on average. It is in every upper
        bound, and in no lower one.
    """

    misses: Mapping[str, Bounds]
    landing: Mapping[int, Bounds]
    late: Bounds
    responses: Mapping[str, Tail]
    behind: float

    @property
    def hr_miss(self) -> Bounds:
        """The probability that an HR job misses its deadline, the mean of the cycle's."""
        return self.misses["hr"]


@dataclass(frozen=True, slots=True, eq=False)
class Probabilities:
    """cycles: the first n; long_run: the mean of a cycle after infinitely many, None where there is none:
    why_no_long_run says why.

    ticks: an HR period; exact: whether costs are exact in them, else they were rounded down for lower and up for upper
    bounds. lost: the probability that a measurement never arrives.
    """

    cycles: Sequence[CycleProbabilities]
    long_run: CycleProbabilities | None
    why_no_long_run: str
    ticks: int
    exact: bool
    lost: float

    @property
    def settled(self) -> CycleProbabilities:
        """In the long run, or of the last cycle where there is none."""
        return self.long_run or self.cycles[-1]
