"""Several measurements of the same jobs, in words and as a table: on which machines, when, and what each gives."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TypeVar

from reports.pages.machine import MARK, marked
from reports.pages.stored import Rows
from sched_sim.costs.table import measured_on_busy_machine
from studies.machines.ranges import Measurement, machines

Measured = TypeVar("Measured", bound=Measurement)
Shown = Callable[[Measured], str]
"""What one measurement makes of a figure, as it is shown."""


def counted_on(measurements: Sequence[Measurement]) -> str:
    """How many there are, and of which machines: "3 measurements on 1 machine (AMD EPYC)"."""
    of = machines(measurements)
    names = [f"{name} {len(dates)}" if len(of) > 1 else name for name, dates in of.items()]
    return f"{_number(len(measurements), 'measurement')} on {_number(len(of), 'machine')} ({', '.join(names)})"


def who_measured(measurements: Sequence[Measurement]) -> str:
    """The same for the end of a report: with the dates, what of a measurement counts, and who has not measured yet."""
    of = machines(measurements)
    days = sorted(day for dates in of.values() for day in dates)
    when = days[0] if days[0] == days[-1] else f"{days[0]} to {days[-1]}"
    alone = f" No other machine has measured yet{_no_xeon(of)}: its times may differ more." if len(of) == 1 else ""
    return (
        f"Measured figures {MARK} are ranges over {counted_on(measurements)}, {when}, each by the least times of its "
        f"rounds, which other programs disturb least; a machine is called what its processor calls itself.{alone} "
        f"In a clone, `make times` adds yours."
    )


def measurement_rows(measurements: Sequence[Measured], figures: Mapping[str, Shown[Measured]]) -> Rows:
    """A row for each measurement, by date, which says so where the machine was busy; figures: by their heading."""
    rows: Rows = [[*map(marked, ("machine", "date", *figures))]]
    for one in sorted(measurements, key=lambda one: str(one.provenance["date"])):
        about = one.provenance
        date = f"{about['date']}, busy" if measured_on_busy_machine(about) else about["date"]
        rows.append([about["machine"], date, *(figure(one) for figure in figures.values())])
    return rows


def _no_xeon(of: Mapping[str, Sequence[str]]) -> str:
    return "" if any("xeon" in name.lower() for name in of) else ", no Intel Xeon either"


def _number(count: int, noun: str) -> str:
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
