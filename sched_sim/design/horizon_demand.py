"""Least period and landing of the delayed horizon in closed form, as exact quotients.

To land after c steps, the update and c replayed steps must be done in the c - M steps from m on; all LR work of a cycle
in N. The first demand falls with c, the second grows: the least is where they cross, or one step before. So a later
deadline never needs more.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic

from sched_sim.design.pieces import DelayedHorizonCosts
from sched_sim.design.quotient import Quotient, exceeds, largest, quotient, smaller
from sched_sim.design.whole import Flags, Whole, larger, where


@dataclass(frozen=True, slots=True)
class HorizonDemand(Generic[Whole]):
    """Costs in ticks; separate: LR jobs have a processor of their own."""

    costs: DelayedHorizonCosts[int]
    N: Whole
    M: Whole
    separate: bool

    @property
    def beside(self) -> int:
        """Work of each step that LR jobs wait for."""
        return 0 if self.separate else self.costs.predict

    def _undelayed(self, work: int) -> Whole:
        """So much where M = 0."""
        return where(self.M == 0, 0 * self.N + work, 0)

    @property
    def after_high(self) -> Whole:
        """What is waited for besides where the measurement comes as it is taken: the HR job, on another processor."""
        return self._undelayed(self.costs.predict if self.separate else 0)

    @property
    def _to_land(self) -> Whole:
        """Work from m on that is not replayed; where M = 0 the last of the propagations is a part of it."""
        return self._undelayed(self.costs.propagate) + self.after_high + self.costs.update

    def landing(self, c: Whole, code: int) -> Quotient[Whole]:
        """The update and c replayed steps, from m on."""
        return quotient(self._to_land + self.costs.replay * c, c - self.M, code)

    def low_work(self, c: Whole) -> Whole:
        """All LR work of a cycle that lands after c steps: more than N steps leave piles up."""
        return self.costs.update + self.costs.replay * c + self.costs.propagate * self.N

    def cycle(self, c: Whole, code: int) -> Quotient[Whole]:
        """That work, due N steps after m."""
        return quotient(self.after_high + self.low_work(c), self.N, code)

    def crossing(self, L: Whole) -> Whole:
        """The first c from M + 1 on in which a cycle asks for no less than landing does; L if none before it."""
        low, high = self.M + 1 + 0 * L, L + 0 * self.N
        while _any(low < high):
            middle = (low + high) // 2
            higher = exceeds(self.landing(middle, 0), self.cycle(middle, 0))
            low = where(higher & (low < high), middle + 1, low)
            high = where(higher, high, middle)
        return high

    def least_period(self, L: Whole, hr: int, lr_update: int, lr_propagate: int) -> Quotient[Whole]:
        """The least HR period; its code is that of what binds: a tick below where a cycle binds one step later, that
        cycle does."""
        crossing = self.crossing(L)
        earlier = larger(crossing - 1, self.M + 1)
        here = largest(self.landing(crossing, lr_update), self.cycle(crossing, lr_propagate))
        before = largest(self.landing(earlier, lr_propagate), self.cycle(earlier, lr_propagate))
        least = smaller(here, before)
        least = least._replace(numerator=least.numerator + self.beside * least.denominator)
        return largest(quotient(self.costs.predict + 0 * self.N, 1, hr), least)

    def landed(self, period: Whole, scale: Whole | int, nowhere: int) -> Whole:
        """The step, from k, in which corrections land at an HR period of `period / scale` ticks; `nowhere` if an HR job
        is late, LR jobs pile up, or none lands by N."""
        spare = period - self.beside * scale
        slack = spare - self.costs.replay * scale
        behind = self._to_land * scale + spare * self.M
        c = larger(-(-behind // larger(slack, 1)), self.M + 1)
        keeps_up = (period >= self.costs.predict * scale) & (self.low_work(c) * scale <= spare * self.N)
        return where(keeps_up & (c * slack >= behind) & (c <= self.N), c, nowhere)


def _any(flags: bool | Flags) -> bool:
    return flags if isinstance(flags, bool) else bool(flags.any())
