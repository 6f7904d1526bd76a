"""Which parts run a design, or whether the machine does whose times its costs are; how much of each it takes, and where
its corrections land there."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from sched_sim.costs.table import SECONDS, CostTable
from sched_sim.design.fit import busy_share
from sched_sim.design.landing import landing
from sched_sim.design.least_speed import least_speed
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs, Statistic
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.processors.part import Part, on_part
from sched_sim.rounding import percent_up
from sched_sim.schedule.tasks import Task


@dataclass(frozen=True, slots=True)
class OnPart:
    """part: None for the machine whose times the cost table has. needed: the share of its speed at which every deadline
    holds, above 1 it is too slow; load: the share of its time that it is busy. landed: the L at which corrections land
    there, std: the figure of the output then; None if it is too slow. remark: why nothing is known of it."""

    part: Part | None
    needed: Fraction | None
    load: Fraction | None
    landed: int | None = None
    std: float | None = None
    remark: str = ""

    @property
    def name(self) -> str:
        """In words."""
        return "the machine of the costs" if self.part is None else self.part.name

    @property
    def price(self) -> Fraction | None:
        """As in `Part`."""
        return None if self.part is None else self.part.price

    @property
    def for_sale(self) -> bool:
        """As in `Part`."""
        return self.part is None or self.part.for_sale

    @property
    def fits(self) -> bool:
        return self.landed is not None

    @property
    def slack(self) -> Fraction | None:
        return None if self.needed is None else 1 - self.needed


def by_cost(on: OnPart) -> tuple[int, Fraction, Fraction]:
    """First what runs it: by price, those without one after the others, the one with the least to spare first, and then
    what is not for sale; then what is too slow, the nearest first; last what nothing is known of. Of equals the less
    busy one."""
    if on.needed is None or on.load is None:
        return 4, Fraction(0), Fraction(0)
    if not on.fits:
        return 3, on.needed, on.load
    if not on.for_sale:
        return 2, -on.needed, on.load
    return (1, -on.needed, on.load) if on.price is None else (0, on.price, on.load)


def too_slow(looked: Sequence[OnPart]) -> str:
    """Why none of these runs it, the nearest first."""
    nearest = looked[0]
    if nearest.needed is None:
        return "; ".join(dict.fromkeys(on.remark for on in looked))
    which = f"{nearest.name} is too slow: it"
    if nearest.part is not None:
        which = f"no part is fast enough: the nearest, {nearest.name},"
    return f"{which} needs {percent_up(nearest.needed)} of its speed"


class Place(NamedTuple):
    """Where a method would run: a part, or None for the machine of the costs. costs: None where there are none, and the
    remark says why; pace: what it does in an HR period, in their unit."""

    part: Part | None
    costs: Costs | None
    pace: Fraction
    remark: str = ""


class Parts:
    """The cost tables on each part, each made once."""

    def __init__(self, parts: Sequence[Part], statistic: Statistic) -> None:
        self.parts = parts
        self.statistic: Statistic = statistic
        self._tables: dict[tuple[str, str], CostTable] = {}

    def look(
        self, table: CostTable, method: str, timing: Timing, rate: Fraction, options: Options, tasks: Sequence[Task]
    ) -> list[OnPart]:
        """What each part makes of the design, without its accuracy, or the machine of a table of times; nothing without
        either."""
        return [looked_at(place, timing, options, tasks) for place in self.places(table, method, rate, options)]

    def places(self, table: CostTable, method: str, rate: Fraction, options: Options) -> list[Place]:
        """The same places, with the costs of the method on each."""
        if not self.parts and table.unit in SECONDS:
            costs = select(table, method, options, self.statistic)
            return [Place(None, costs, 1 / (rate * SECONDS[table.unit]))]
        return [self._place(part, table, method, rate, options) for part in self.parts]

    def _place(self, part: Part, table: CostTable, method: str, rate: Fraction, options: Options) -> Place:
        key = table.name, part.name
        if key not in self._tables:
            self._tables[key] = on_part(table, part)
        try:
            return Place(part, select(self._tables[key], method, options, self.statistic), 1 / rate)
        except InputError as error:
            if method not in self._tables[key].lacking:
                raise
            return Place(part, None, 1 / rate, str(error))


def looked_at(
    place: Place,
    timing: Timing,
    options: Options,
    tasks: Sequence[Task],
    on_work: Callable[[int], None] = lambda _instants: None,
) -> OnPart:
    """What one place makes of a design. on_work: as of `least_speed`. Raises InputError as that does."""
    if place.costs is None:
        return OnPart(place.part, None, None, remark=place.remark)
    least = least_speed(place.costs, timing, options, tasks, on_work=on_work).speed
    needed = least / place.pace
    busy = busy_share(place.costs, timing, place.pace, options, tasks)
    lands = landing(place.costs, timing, place.pace, options, tasks, least) if needed <= 1 else None
    return OnPart(place.part, needed, busy, lands)
