"""What each part makes of the design, as plain data."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from studies.explorer.resolved import Resolved
from studies.selection.parts import OnPart

NOT_FOR_SALE = "not for sale: it is shown for comparison, and named only where no other does"


@dataclass(frozen=True, slots=True)
class PartView:
    """needed: the share of its speed at which every deadline holds, load: the share of its time that it is busy; both
    None where nothing is known of it, and the reason says why, or that it is not for sale. landed: the L at which
    corrections land there, None if it is too slow; std: the figure of the output then. query: of the design on it."""

    name: str
    title: str
    fits: bool
    needed: Fraction | None
    load: Fraction | None
    landed: int | None
    landed_ms: float | None
    std: float | None
    price: float | None
    reason: str
    query: str


def part_view(asked: Resolved, on: OnPart) -> PartView:
    there = {} if on.part is None else {"processor": on.part.name, "speed": None}
    return PartView(
        on.name,
        asked.counts.name if on.part is None else on.part.title,
        on.fits,
        on.needed,
        on.load,
        on.landed,
        asked.sampling.ms(on.landed),
        on.std,
        None if on.price is None else float(on.price),
        on.remark or ("" if on.for_sale else NOT_FOR_SALE),
        asked.queries.but(**there),
    )
