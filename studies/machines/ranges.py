"""What a figure is over several measurements: a range, which no further measurement makes narrower."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from typing import Generic, NamedTuple, TypeVar

from sched_sim.costs.table import CostTable

Number = TypeVar("Number", Fraction, float)


class Range(NamedTuple, Generic[Number]):
    """From the least of a figure to the greatest."""

    low: Number
    high: Number


def range_of(figure: Callable[[CostTable], Number], measurements: Iterable[CostTable]) -> Range[Number]:
    """Of what each measurement alone makes of the figure. Raises ValueError if there is none."""
    values = [figure(table) for table in measurements]
    return Range(min(values), max(values))


def machines(measurements: Sequence[CostTable]) -> dict[str, list[str]]:
    """The dates of the measurements, sorted, by the machine's name."""
    names = sorted({str(table.provenance["machine"]) for table in measurements})
    return {
        name: sorted(str(table.provenance["date"]) for table in measurements if table.provenance["machine"] == name)
        for name in names
    }
