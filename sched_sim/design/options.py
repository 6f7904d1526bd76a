"""How the method runs on the processor: the choices the paper leaves to the designer."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

from sched_sim.design.timing import Feedback
from sched_sim.errors import InputError

Gain = Literal["at-update", "precomputed"]
LowRateNoise = Literal["exact", "sum", "euler"]


@dataclass(frozen=True, slots=True)
class Options:
    """Choices for the dual-rate filter and the processor; the defaults are the paper's.

    feedback: the correction is applied by the HR job of the next step (Fig. 2), or at HR priority as soon as
        the low-rate (LR) update finishes.
    lr_propagate_by: the deadline of LR propagate: start of step m (the paper's rule), or of step l.
    gain: K computed in the LR update, or before the measurement arrives (Sec. III.D).
    low_rate_noise: Q over a low-rate interval by Eq. (18), (23) or (24).
    cpus: HR and LR jobs share one processor, or have one each (Sec. III.B).
    context_switch: work charged to a job each time it is dispatched and another job ran last, in cost units.
    """

    feedback: Feedback = "next-step"
    lr_propagate_by: Literal["m", "l"] = "m"
    gain: Gain = "at-update"
    low_rate_noise: LowRateNoise = "exact"
    cpus: Literal[1, 2] = 1
    context_switch: Fraction = Fraction(0)

    def __post_init__(self) -> None:
        if self.context_switch < 0:
            raise InputError(f"context switch is {float(self.context_switch):g}: it must be 0 or more cost units")
