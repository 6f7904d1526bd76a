"""What a figure is over several measurements: a range, which no further measurement makes narrower."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from fractions import Fraction
from typing import Any, Generic, NamedTuple, Protocol, TypeVar


class Measurement(Protocol):
    """Such as a cost table that was timed: it says on which machine and when."""

    @property
    def provenance(self) -> Mapping[str, Any]: ...


Measured = TypeVar("Measured")
Number = TypeVar("Number", Fraction, float)


class Range(NamedTuple, Generic[Number]):
    """From the least of a figure to the greatest."""

    low: Number
    high: Number


def range_of(figure: Callable[[Measured], Number], measurements: Iterable[Measured]) -> Range[Number]:
    """Of what each measurement alone makes of the figure. Raises ValueError if there is none."""
    values = [figure(one) for one in measurements]
    return Range(min(values), max(values))


def machines(measurements: Sequence[Measurement]) -> dict[str, list[str]]:
    """The dates of the measurements, sorted, by the machine's name."""
    names = sorted({str(one.provenance["machine"]) for one in measurements})
    return {
        name: sorted(str(one.provenance["date"]) for one in measurements if one.provenance["machine"] == name)
        for name in names
    }
