"""How long a piece of work takes: values and their probabilities, each execution independent of all others."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import fsum, isfinite
from sys import float_info

from sched_sim.errors import InputError
from sched_sim.ticks import Number, exact

NEAR_ONE = 1e-12
"""So far from 1 a sum of probabilities may be, that were rounded when they were written."""


@dataclass(frozen=True, slots=True)
class CostDistribution:
    """values: in the cost table's unit (or, of delays, in HR steps), increasing, 0 or more; probabilities: of each,
    greater than 0. Their sum is 1; what rounding has left of it is scaled away.

    Raises InputError for anything else.
    """

    values: tuple[Fraction, ...]
    probabilities: tuple[float, ...]

    def __post_init__(self) -> None:
        values = tuple(exact(value, "value") for value in self.values)
        probabilities = tuple(map(float, self.probabilities))
        if len(values) != len(probabilities) or not values:
            raise InputError(
                f"{len(values)} values and {len(probabilities)} probabilities: give one probability for each value, "
                f"and at least one"
            )
        if values[0] < 0:
            raise InputError(f"value {float(values[0]):g} must be 0 or more")
        for before, after in pairwise(values):
            if before >= after:
                raise InputError(
                    f"values must increase: {float(after):g} comes after {float(before):g}; give each value once, in "
                    f"order"
                )
        for value, share in zip(values, probabilities, strict=True):
            if not isfinite(share) or share < float_info.min:
                raise InputError(
                    f"probability {share:g} of {float(value):g} must be greater than {float_info.min:.1g}: leave out "
                    f"values that never come"
                )
        total = fsum(probabilities)
        if abs(total - 1) > NEAR_ONE:
            raise InputError(f"probabilities sum to {total!r}: they must sum to 1; scale them, or add what is missing")
        object.__setattr__(self, "values", values)
        object.__setattr__(self, "probabilities", tuple(share / total for share in probabilities))

    @classmethod
    def certain(cls, value: Number) -> CostDistribution:
        return cls((exact(value, "value"),), (1.0,))

    @classmethod
    def of_samples(cls, samples: Sequence[Number]) -> CostDistribution:
        """Each sample with the same probability; equal ones are one value.

        What was never seen has probability 0 here: of n samples, slower executions may be as likely as 3 / n (at 95 %
        confidence) and are not in it.
        """
        return cls.of_weights((exact(sample, "sample"), 1.0) for sample in samples)

    @classmethod
    def of_weights(cls, weighted: Iterable[tuple[Fraction, float]]) -> CostDistribution:
        """In any order; weights that belong to equal values are added, and all are scaled to the sum 1."""
        weights: Counter[Fraction] = Counter()
        for value, weight in weighted:
            weights[value] += weight  # type: ignore[assignment]  # counts parts of an event
        if not weights:
            raise InputError("there are no samples: give at least one")
        total, values = fsum(weights.values()), sorted(weights)
        return cls(tuple(values), tuple(weights[value] / total for value in values))

    @property
    def worst(self) -> Fraction:
        """The largest value."""
        return self.values[-1]

    @property
    def mean(self) -> Fraction:
        """Of the probabilities as they are in floating point."""
        return sum((Fraction(p) * value for value, p in zip(self.values, self.probabilities, strict=True)), Fraction(0))
