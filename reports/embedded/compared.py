"""Least speeds by every source, against those by counted operations."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction
from typing import NamedTuple

from filters.covariance_forms import CovarianceFormName
from reports.embedded.results import Results
from reports.embedded.words import SOURCES
from sched_sim.design.timing import Timing
from studies.embedded.sources import DESIGNS, FORMS, METHODS, counted, relative_speed


class Compared(NamedTuple):
    """The least speed of a design over that of the standard filter, by counted operations and by a source.

    least, most: by the least costs, and by their 95th percentiles; speed: by medians.
    """

    form: CovarianceFormName
    timing: Timing
    method: str
    source: str
    counted: Fraction
    speed: Fraction
    least: Fraction
    most: Fraction

    @property
    def deviation(self) -> Fraction:
        """By the source over counted, less one."""
        return self.speed / self.counted - 1


def compared(results: Results) -> list[Compared]:
    """All designs by all sources that there are."""
    found = []
    for form in FORMS:
        operations = counted(form)
        for name in SOURCES:
            if (name, form) not in results.costs:
                continue
            table = results.costs[name, form]
            for timing in DESIGNS:
                for method in METHODS[1:]:
                    speed, *ends = (relative_speed(table, method, timing, of) for of in ("median", "minimum", "p95"))
                    of_counts = relative_speed(operations, method, timing)
                    found.append(
                        Compared(form, timing, method, name, of_counts, speed, min(speed, *ends), max(speed, *ends))
                    )
    return found


def largest(found: Iterable[Compared]) -> Compared:
    """That deviates most from what is counted."""
    return max(found, key=lambda one: abs(one.deviation))
