"""Figures of a design as people read them: a need never looks smaller than it is."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from sched_sim.costs.table import units
from sched_sim.errors import option
from sched_sim.rounding import no_less, percent_up, written
from sched_sim.ticks import exact
from studies.explorer.query import number_text
from studies.explorer.resolved import Resolved


def place(asked: Resolved) -> str:
    """What the design runs on, empty where it is no machine."""
    return "" if asked.machine_pace is None or asked.design.speed is not None else machine(asked)


def machine(asked: Resolved) -> str:
    """The part, or that whose times the costs are."""
    return f"the machine of {asked.table.name}" if asked.part is None else asked.part.name


def needs(asked: Resolved, speed: Fraction) -> str:
    """A speed, in percent of the machine if there is one."""
    if asked.machine_pace is not None:
        return f"{percent_up(speed / asked.machine_pace)} of {machine(asked)}"
    if asked.table.unit == "second":
        return f"{no_less(10**6 * speed, 5)} us per HR period"
    return f"{no_less(speed, 5)} {units(asked.table.unit)} per HR period"


def lands(asked: Resolved, L: int) -> str:
    """ "L = 45 (112.5 ms)"; the time, if it is known, from when the measurement was taken, at the latest."""
    after = asked.sampling.ms(L)
    return f"L = {L}" if after is None else f"L = {L} ({after:.6g} ms)"


def figure(asked: Resolved, std: float) -> str:
    """Of the output."""
    return f"{no_less(written(std), 4)}{_unit(asked)}"


def within(asked: Resolved) -> float | None:
    """The standard deviation that is allowed; None if none is said."""
    said = asked.design.within
    return None if said is None else float(exact(said, option("within")))


def bound(asked: Resolved) -> str:
    """What is asked of the output: "position within 0.4 m"."""
    assert asked.outputs is not None
    said = number_text(exact(asked.design.within or 0, option("within")))
    rms = " rms" if asked.design.metric == "rms" else ""
    return f"{asked.outputs.name} within {said}{_unit(asked)}{rms}"


def named(method: str) -> str:
    """The standard filter is for comparison, to which nothing is late."""
    return "standard (no delay)" if method == "standard" else method


def listed(names: Sequence[str]) -> str:
    """ "a", "a and b", "a, b and c", "a, b, c and 3 more"."""
    more = [] if len(names) <= MOST_NAMED + 1 else [f"{len(names) - MOST_NAMED} more"]
    shown = [*names[:MOST_NAMED], *more] if more else [*names]
    return " and ".join([", ".join(shown[:-1]), shown[-1]] if len(shown) > 1 else shown)


MOST_NAMED = 3
"""Before the rest is only counted."""


def _unit(asked: Resolved) -> str:
    return f" {asked.outputs.unit}" if asked.outputs is not None and asked.outputs.unit else ""
