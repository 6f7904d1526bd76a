"""A design as one record: all that a link to the explorer says."""

from __future__ import annotations

from dataclasses import dataclass
from typing import get_args

from sched_sim.bounds import at_least_one, check_kind, short, whole
from sched_sim.costs.methods import DELAYED_METHODS, TWO_RATE_METHODS
from sched_sim.design.options import Options
from sched_sim.design.pieces import Statistic
from sched_sim.errors import InputError, option
from sched_sim.text import did_you_mean
from sched_sim.ticks import Number, exact, positive
from studies.selection.compare import Metric, check_metric

ABOVE_ZERO = ("hr_hz", "measurement_hz", "speed", "within")
TIMES = ("delay_ms", "land_within_ms")
NAMES = ("costs", "processor", "model", "output")


@dataclass(frozen=True, slots=True)
class Design:
    """One filter on one processor, and the accuracy that is asked of it; numbers are kept exactly, as fractions.

    N, M, L: in HR steps, as in `Timing`; or hr_hz, the rate of the HR loop, with measurement_hz, delay_ms and
    land_within_ms. Where they are left out, N and M are those of a shipped model, L is the latest of the method.
    costs, processor, model: by name, those that ship or that `Given` has; costs by default counts for the model, else
    of counted-9-3-3 with a processor, else of steffes2014. speed: cost units per HR period, by default that of the
    processor, without one the least.
    output, within, metric: as in `choose_filter`. cycles: of measurements, that the schedule shows.

    Raises InputError that names the argument, its value and the remedy.
    """

    N: int | None = None
    M: int | None = None
    L: int | None = None
    hr_hz: Number | None = None
    measurement_hz: Number | None = None
    delay_ms: Number | None = None
    land_within_ms: Number | None = None
    method: str = "dual-rate"
    costs: str | None = None
    statistic: Statistic = "minimum"
    processor: str | None = None
    speed: Number | None = None
    options: Options = Options()
    model: str | None = None
    output: str | None = None
    within: Number | None = None
    metric: Metric = "worst"
    cycles: int = 1

    def __post_init__(self) -> None:
        for name in "NML":
            if (steps := getattr(self, name)) is not None:
                object.__setattr__(self, name, whole(steps, option(name)))
        for name in (*ABOVE_ZERO, *TIMES):
            if (number := getattr(self, name)) is not None:
                read = positive if name in ABOVE_ZERO else exact
                object.__setattr__(self, name, read(number, option(name)))
        for name in NAMES:
            if getattr(self, name) is not None:
                check_kind(getattr(self, name), str, option(name), "a name")
        check_kind(self.options, Options, "options", "Options(...), or leave it out")
        check_metric(self.metric)
        object.__setattr__(self, "cycles", at_least_one(self.cycles, option("cycles")))
        if self.statistic not in get_args(Statistic):
            known = ", ".join(get_args(Statistic))
            raise InputError(f"{option('statistic')} is {short(repr(self.statistic))}: choose from {known}")
        _check_method(self.method)


def _check_method(method: str) -> None:
    said, known = f"{option('method')} {short(repr(method))}", ", ".join(DELAYED_METHODS)
    if method in TWO_RATE_METHODS:
        raise InputError(
            f"{said} has no late measurement, which is what is explored: choose from {known}; what it needs is said by "
            f"`sched-sim minimum --method {method}`"
        )
    if method not in DELAYED_METHODS:
        guess = did_you_mean(method, DELAYED_METHODS) if isinstance(method, str) else ""
        raise InputError(f"{said} is unknown: {guess}choose from {known}")
