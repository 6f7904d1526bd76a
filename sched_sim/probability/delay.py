"""When a measurement arrives: a random number of whole steps after it was taken, or never."""

from __future__ import annotations

from sched_sim.errors import InputError, option
from sched_sim.probability.cost_distribution import CostDistribution


class Delay:
    """shares: P(so many steps late), of those that arrive; lost: the probability that one never does."""

    def __init__(self, shares: list[float], lost: float) -> None:
        self.shares, self.lost = shares, lost
        self.longest = len(shares) - 1
        self.least = next(steps for steps, share in enumerate(shares) if share)

    @classmethod
    def of(cls, delays: CostDistribution, lost: float) -> Delay:
        """Raises InputError for what is no whole number of steps."""
        shares = [0.0] * (int(delays.worst) + 1)
        for value, share in zip(delays.values, delays.probabilities, strict=True):
            if value.denominator > 1:
                raise InputError(
                    f"{option('delays')} {float(value):g} must be whole HR steps: a measurement is used in the first "
                    f"step at or after its arrival; round it up"
                )
            shares[int(value)] = share
        return cls(shares, lost)

    def by(self, steps: int) -> float:
        """P(arrived when so many steps have begun after k), of those that arrive."""
        return sum(self.shares[: max(steps + 1, 0)])

    def after(self, steps: int) -> float:
        """P(it has not), of those that arrive."""
        return sum(self.shares[max(steps + 1, 0) :])

    def next(self, steps: int) -> tuple[float, float]:
        """P(it arrives now), P(later), of those that arrive and had not before."""
        return self._divided(steps, 1.0, 0.0)

    def hazard(self, steps: int) -> tuple[float, float]:
        """P(it arrives now), P(later or never), of those that had not before."""
        return self._divided(steps, 1 - self.lost, self.lost)

    def _divided(self, steps: int, arrives: float, never: float) -> tuple[float, float]:
        now, later = arrives * sum(self.shares[steps : steps + 1]), arrives * self.after(steps) + never
        return now / (now + later), later / (now + later)
