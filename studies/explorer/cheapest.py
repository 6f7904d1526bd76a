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
from studies.explorer.searched import MOST_WORK_BESIDE, patience
from studies.selection.parts import OnPart, Place, by_cost


def cheapest(places: Sequence[Place], timing: Timing, options: Options, tasks: Sequence[Task]) -> list[OnPart]:
    """The first of `Parts.look` by cost, alone; where nothing is known of any place, all of them; none of no places.

    Raises InputError where it takes too long a search.
    """
    known = [
        _Known.of(part, costs, pace, *least_speed_range(costs, timing, options, tasks))
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
    """A place whose costs are known. low: that the least speed is not below; least: the share of its speed that this
    is; is_exact: whether it is the least speed; rank: the best that it may have among those that do, by cost, but for
    the load that decides between equals."""

    part: Part | None
    costs: Costs
    pace: Fraction
    low: Fraction
    least: Fraction
    is_exact: bool
    rank: tuple[int, Fraction]

    @classmethod
    def of(cls, part: Part | None, costs: Costs, pace: Fraction, low: Fraction, high: Fraction | None) -> _Known:
        """high: that the least speed is not above; None if that is not known."""
        least, is_exact = low / pace, low == high
        price, for_sale = (None, True) if part is None else (part.price, part.for_sale)
        most = Fraction(1) if high is None else min(least if is_exact else high / pace, Fraction(1))
        rank = (0, price) if price is not None and for_sale else (1 if for_sale else 2, -most)
        return cls(part, costs, pace, low, least, is_exact, rank)

    def exactly(self, timing: Timing, options: Options, tasks: Sequence[Task]) -> _Known:
        if self.is_exact:
            return self
        speed = least_speed(self.costs, timing, options, tasks, on_work=patience(MOST_WORK_BESIDE)).speed
        return _Known.of(self.part, self.costs, self.pace, speed, speed)


def _looked(place: _Known, timing: Timing, options: Options, tasks: Sequence[Task], lands: bool = True) -> OnPart:
    busy = busy_share(place.costs, timing, place.pace, options, tasks)
    landed = landing(place.costs, timing, place.pace, options, tasks, place.low) if lands else None
    return OnPart(place.part, place.least, busy, landed)
