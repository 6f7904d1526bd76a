"""In which steps measurements are taken: those that are p / q HR steps apart, i p / q or the first step after it."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction


@dataclass(frozen=True, slots=True)
class Taken:
    """count: measurements in so many steps, after which all repeats; the first is of step 0, as if others had been
    before."""

    steps: int
    count: int

    @classmethod
    def each(cls, every: int | Fraction) -> Taken:
        return cls(every.numerator, every.denominator)

    def before(self, step: int) -> int:
        """How many are taken in steps 0 .. step - 1: the number of one that is taken in `step`."""
        return (step - 1) * self.count // self.steps + 1

    def since(self, step: int) -> int:
        """Steps since the last one was taken; 0 if one is in this step."""
        return step * self.count % self.steps // self.count

    def step(self, number: int) -> int:
        """In which the measurement of this number is taken."""
        return -(-number * self.steps // self.count)
