"""The first of the places where a design may run, by cost, with no more looked at than decides it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from sched_sim.design.fit import busy_share
from sched_sim.design.landing import landing
from sched_sim.design.least_speed import least_speed, least_speed_range
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs
from sched_sim.design.timing import Timing
from sched_sim.processors.part import Part
from sched_sim.schedule.tasks import Task
from studies.selection.parts import OnPart, Place, by_cost


def cheapest(places: Sequence[Place], timing: Timing, options: Options, tasks: Sequence[Task]) -> list[OnPart]:
    """The first of `Parts.look` by cost, alone; where nothing is known of any place, all of them; none of no places."""
    known = [
        _Known(part, costs, pace, *least_speed_range(costs, timing, options, tasks))
        for part, costs, pace, _ in places
        if costs is not None
    ]
    if not known:
        return [OnPart(place.part, None, None, remark=place.remark) for place in places]
    left = [place for place in known if place.least <= 1]
    while left:
        first = min(place.rank for place in left)
        group = [place for place in left if place.rank == first]
        left = [place for place in left if place.rank != first]
        if all(place.is_exact for place in group):
            looked = [_looked(place, timing, options, tasks) for place in group]
            if does := [on for on in looked if on.fits]:
                return [min(does, key=by_cost)]
        else:
            found = [place.exactly(timing, options, tasks) for place in group]
            left += [place for place in found if place.least <= 1]
    exact = [place.exactly(timing, options, tasks) for place in known]
    share = min(place.least for place in exact)
    nearest = [_looked(place, timing, options, tasks, lands=False) for place in exact if place.least == share]
    return [min(nearest, key=by_cost)]


@dataclass(frozen=True, slots=True)
class _Known:
    """A place whose costs are known. low, high: between which the least speed is; high: None if that is not known."""

    part: Part | None
    costs: Costs
    pace: Fraction
    low: Fraction
    high: Fraction | None

    @property
    def is_exact(self) -> bool:
        return self.low == self.high

    @property
    def least(self) -> Fraction:
        """The share of its speed that is needed, at least."""
        return self.low / self.pace

    @property
    def rank(self) -> tuple[int, Fraction]:
        """The best that it may have among those that do, by cost, but for the load that decides between equals."""
        price, for_sale = (None, True) if self.part is None else (self.part.price, self.part.for_sale)
        most = Fraction(1) if self.high is None else min(self.high / self.pace, Fraction(1))
        if price is None or not for_sale:
            return (1 if for_sale else 2), -most
        return 0, price

    def exactly(self, timing: Timing, options: Options, tasks: Sequence[Task]) -> _Known:
        speed = self.low if self.is_exact else least_speed(self.costs, timing, options, tasks).speed
        return _Known(self.part, self.costs, self.pace, speed, speed)


def _looked(place: _Known, timing: Timing, options: Options, tasks: Sequence[Task], lands: bool = True) -> OnPart:
    busy = busy_share(place.costs, timing, place.pace, options, tasks)
    landed = landing(place.costs, timing, place.pace, options, tasks, place.low) if lands else None
    return OnPart(place.part, place.least, busy, landed)
