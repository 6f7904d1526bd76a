"""What is said beside the model: a motion, a time constant, methods; and what is too much to be computed."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from sched_sim.bounds import short
from sched_sim.errors import InputError, option
from sched_sim.ticks import Number, exact, positive
from studies.selection.methods import COMPARED, METHODS
from studies.selection.model import Model
from studies.selection.sampling import Sampling

TAU_S = 0.25
"""PX4's own EKF2_TAU_POS and EKF2_TAU_VEL, in seconds."""

MOST_NUMBERS = 30_000_000
"""Of the transitions over all ages, which are kept: some 250 MB."""


class Conditions(NamedTuple):
    """displacement, pull: as in `methods.Asked`; measured: so many quantities."""

    displacement: FloatArray | None = None
    pull: float | None = None
    measured: int = 1

    def lacks(self, method: str) -> str:
        """What the method needs that was not said; empty if nothing."""
        if METHODS[method].needs == "motion" and self.displacement is None:
            return (
                f"{method}: its error is how far the measured quantities move during the delay: give "
                f"{option('motion')} {_example(self.measured)}, how fast each of them moves, in its unit a second"
            )
        if METHODS[method].needs == "hr_hz" and self.pull is None:
            return (
                f"{method}: its time constant {option('tau')} is in seconds: give {option('hr_hz')} 400, or what else "
                f"the rate of the HR loop is"
            )
        return ""


def conditions_of(
    model: Model, sampling: Sampling, motion: Sequence[Number] | str | None, tau_s: Number = TAU_S
) -> Conditions:
    """motion: numbers in units of the measurements a second, or text with commas. Raises InputError for one of another
    length, without a rate to make a distance of it, and for what is no number."""
    tau = positive(tau_s, option("tau"))
    pull = None if sampling.hr_hz is None else float(1 / (sampling.hr_hz * tau))
    if motion is None:
        return Conditions(None, pull, len(model.linear.H))
    said = f"{option('motion')} {short(motion)}"
    parts = motion.split(",") if isinstance(motion, str) else list(motion)
    speeds = [float(exact(part, said)) for part in parts]
    needed = len(model.linear.H)
    if len(speeds) != needed:
        raise InputError(
            f"{said}: {len(speeds)} number{'' if len(speeds) == 1 else 's'}, and the model measures {needed}: give one "
            f"for each, in its unit a second, such as {option('motion')} {_example(needed)}"
        )
    if sampling.delay_s is None:
        raise InputError(f"{said} without {option('hr_hz')}: give the rate of the HR loop, for the delay in seconds")
    return Conditions(np.array(speeds) * sampling.delay_s, pull, needed)


def _example(measured: int) -> str:
    """A motion of so many quantities."""
    return ",".join(["15"] + ["0"] * (measured - 1))


def check_every(every: object) -> None:
    """Raises InputError unless it is whole numbers, at least 1."""
    said = f"{option('every')} is {short(repr(every))}: give whole numbers of at least 1, such as [1, 2]"
    if not isinstance(every, list | tuple | range) or not every:
        raise InputError(said)
    if any(isinstance(number, bool) or not isinstance(number, int) or number < 1 for number in every):
        raise InputError(said)


def check_names(**lists: object) -> None:
    """Raises InputError for a text where names are asked for, which would be taken letter by letter."""
    for name, value in lists.items():
        if isinstance(value, str):
            raise InputError(f"{name} is {short(repr(value))}: give a list of names, [{short(repr(value))}]")


class Chosen(NamedTuple):
    """left_out: what those lack that were not asked for."""

    methods: tuple[str, ...]
    left_out: tuple[str, ...]


def chosen_methods(asked: Sequence[str] | None, conditions: Conditions) -> Chosen:
    """Those asked for, each once; or all for which enough was said. Raises InputError for one that is unknown, or lacks
    something."""
    if not asked:
        lacking = {name: conditions.lacks(name) for name in COMPARED}
        return Chosen(
            tuple(name for name, lacks in lacking.items() if not lacks),
            tuple(f"no {lacks}" for lacks in lacking.values() if lacks),
        )
    for name in asked:
        if name not in METHODS:
            raise InputError(f"{option('method')} {short(name)!r} is unknown here: choose from {', '.join(METHODS)}")
        if lacks := conditions.lacks(name):
            raise InputError(f"{option('method')} {lacks}")
    return Chosen(tuple(dict.fromkeys(asked)), ())


def check_ages(model: Model, oldest: int) -> None:
    """Raises InputError for ages over which more would be kept than MOST_NUMBERS."""
    each = 2 * model.linear.states**2
    if oldest * each > MOST_NUMBERS:
        raise InputError(
            f"{option('N')} and {option('every')} make outputs of up to {oldest:,} steps after their measurement: at "
            f"most {MOST_NUMBERS // each:,} with {model.linear.states} states; give less, or a slower "
            f"{option('hr_hz')}"
        )


@contextmanager
def settling(sampling: Sampling) -> Iterator[None]:
    """What the accuracy says of an interval becomes an InputError that names it."""
    try:
        yield
    except ValueError as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"{option('N')} {sampling.N}: {error}") from None
