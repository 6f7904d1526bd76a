"""The answer to which filter keeps an accuracy: ways to run methods, and what each needs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sched_sim.design.least_speed import LeastSpeed
from sched_sim.html_table import html_table
from sched_sim.plain_table import plain_table
from studies.selection.compare import Metric
from studies.selection.methods import by_reason
from studies.selection.model import Model
from studies.selection.outputs import Outputs
from studies.selection.parts import OnPart
from studies.selection.sampling import Sampling
from studies.selection.variants import Variant


@dataclass(frozen=True, slots=True)
class Candidate:
    """One way to run one method.

    N: steps between the measurements that it uses. first: the earliest landing that it can have, best: the figure then.
    L: the latest landing that keeps the accuracy and that the method can have, also beyond N, but none so late that it
    asks for no less (`Law.last_of_use`); allowed: the latest that keeps it, up to a step beyond these of any method,
    None where even the first does not. std: the figure at L. least: the least speed for L, in the unit of the cost
    table; landed: where corrections land at that speed, landed_std: the figure then.
    parts: what each makes of it, cheapest first; where the costs are times, what the machine does that they are of.
    reason: why it will not do; empty if it does.
    """

    variant: Variant
    N: int
    first: int
    best: float
    allowed: int | None = None
    L: int | None = None
    std: float | None = None
    least: LeastSpeed | None = None
    landed: int | None = None
    landed_std: float | None = None
    parts: tuple[OnPart, ...] = ()
    reason: str = ""

    @property
    def cheapest(self) -> OnPart | None:
        """The part that runs it, None if none does."""
        return next((on for on in self.parts if on.fits), None)


@dataclass(frozen=True, repr=False)
class Choice:
    """What keeps the accuracy `within`, a standard deviation in the unit of the outputs.

    best: of each method the way that needs least, cheapest first; keeping: all ways that do; others: of each method
    that has no such way the one that comes nearest, with its reason. no_delay: the figure of the filter without delay
    that uses every measurement. unit: of the least speeds, per HR period.
    """

    model: Model
    outputs: Outputs
    sampling: Sampling
    within: float
    metric: Metric
    no_delay: float
    unit: str
    best: tuple[Candidate, ...]
    keeping: tuple[Candidate, ...]
    others: tuple[Candidate, ...]
    left_out: tuple[str, ...] = ()
    remarks: tuple[str, ...] = ()

    def __repr__(self) -> str:
        others = by_reason((of.variant.method, of.reason) for of in self.others)
        notes = [*self.remarks, *(f"not {words}" for words in others), *self.left_out]
        return plain_table(_caption(self), HEADINGS, map(_cells, self.best), notes)

    def _repr_html_(self) -> str:
        return _html(self)


HEADINGS = (
    "method",
    "how",
    "every",
    "land by L",
    "std then",
    "least speed",
    "part",
    "of its speed",
    "lands at L",
    "std",
)


def _html(choice: Choice) -> str:
    """The best way of each method, then why the others do not."""
    rows = [_cells(candidate) for candidate in choice.best]
    rows += [(of.variant.method, of.reason, of.variant.every, *[None] * 7) for of in choice.others]
    return html_table(_caption(choice), HEADINGS, rows)


def _caption(choice: Choice) -> str:
    unit = f" {choice.outputs.unit}" if choice.outputs.unit else ""
    return (
        f"{choice.model.name}: {choice.metric} of {choice.outputs.name} within {choice.within:g}{unit}; least speed in "
        f"{choice.unit}{'s' if choice.unit in ('operation', 'second', 'standard step') else ''} per HR period"
    )


def _cells(of: Candidate) -> tuple[Any, ...]:
    on = of.cheapest
    speed = None if of.least is None else float(of.least.speed)
    start = (of.variant.method, of.variant.how, of.variant.every, of.L, of.std, speed)
    if on is None:
        nearest = next((on for on in of.parts if on.needed is not None), None)
        part = (of.reason or None, None) if nearest is None else (f"too slow: {nearest.name}", nearest.needed)
        return (*start, *part, of.landed, of.landed_std)
    return (*start, on.name, on.needed, on.landed, on.std)
