"""How the method runs on the processor: the choices the paper leaves to the designer.

A choice is declared here once. The flags of the commands, the axes of a sweep and the columns of its rows are made from
the fields of `Options`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cache
from typing import Literal, get_args, get_type_hints

from sched_sim.bounds import short
from sched_sim.design.timing import Feedback
from sched_sim.errors import InputError, option
from sched_sim.schedule.policy import Policy
from sched_sim.ticks import exact

Gain = Literal["at-update", "precomputed"]
LowRateNoise = Literal["exact", "sum", "euler"]


FILTER, PROCESSOR = "filter", "processor"
"""What a choice is of. Its help says what it does, its note, beside a picture, that it is not the default."""


@dataclass(frozen=True, slots=True)
class Options:
    """Choices for the dual-rate filter and the processor; the defaults are the paper's.

    lr_propagate_by: the deadline of LR propagate: start of step m (the paper's rule), or of step l.
    feedback: the correction is applied by the HR job of the next step (Fig. 2), or at HR priority as soon as
        the low-rate (LR) update finishes.
    gain: K computed in the LR update, or before the measurement arrives (Sec. III.D).
    low_rate_noise: Q over a low-rate interval by Eq. (18), (23) or (24).
    cpus: HR and LR jobs share one processor, or have one each (Sec. III.B).
    context_switch: work charged to a job each time it is dispatched and another job ran last, in cost units.
    policy: the processor runs the job of the most urgent priority, or the one whose deadline comes first.
    """

    lr_propagate_by: Literal["m", "l"] = field(
        default="m",
        metadata={
            "of": FILTER,
            "note": "LR propagate by ${}$",
            "help": "Deadline of LR propagate: step m (the paper's rule), or step l: needs less power for small M.",
        },
    )
    feedback: Feedback = field(
        default="next-step",
        metadata={
            "of": FILTER,
            "note": "{} feedback",
            "help": "Apply the correction in the HR job of the next step (the paper), or as soon as it is known.",
        },
    )
    gain: Gain = field(
        default="at-update",
        metadata={"of": FILTER, "note": "{} gain", "help": "Compute H, R, K in the LR update, or before it (III.D)."},
    )
    low_rate_noise: LowRateNoise = field(
        default="exact",
        metadata={"of": FILTER, "note": "low-rate noise: {}", "help": "Q over N steps by Eq. 18, 23 or 24."},
    )
    cpus: Literal[1, 2] = field(
        default=1,
        metadata={"of": PROCESSOR, "note": "{} CPUs", "help": "2: HR jobs on one processor, LR jobs on another."},
    )
    context_switch: Fraction = field(
        default=Fraction(0),
        metadata={
            "of": PROCESSOR,
            "note": "context switch {}",
            "help": "Work charged each time a job is dispatched and another ran last, in cost units.",
        },
    )
    policy: Policy = field(
        default="fixed",
        metadata={
            "of": PROCESSOR,
            "note": "{} scheduling",
            "help": "Which job runs: the most urgent by fixed priorities, or by its deadline.",
        },
    )

    def __post_init__(self) -> None:
        for name, known in choices().items():
            value = getattr(self, name)
            if known and value not in known:
                raise InputError(f"{name} is {short(repr(value))}: choose from {', '.join(map(repr, known))}")
        object.__setattr__(self, "context_switch", exact(self.context_switch, option("context_switch")))
        if self.context_switch < 0:
            raise InputError(
                f"{option('context_switch')} is {float(self.context_switch):g}: it must be 0 or more cost units"
            )


@cache
def choices() -> Mapping[str, tuple[object, ...]]:
    """What there is to choose from, by the name of the field; nothing where any number will do."""
    return {name: get_args(kind) for name, kind in get_type_hints(Options).items()}
