"""What is said of measured costs, below every table and in every row: that the machine was busy, and how far they
reach."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from sched_sim.cli.output import say
from sched_sim.costs.table import SECONDS, CostTable, busy_note, measured_on_busy_machine

if TYPE_CHECKING:
    from sched_sim.design.options import Options
    from sched_sim.design.pieces import Statistic
    from sched_sim.design.timing import Timing
    from sched_sim.schedule.tasks import Task


def say_busy(name: str, provenance: Mapping[str, Any]) -> None:
    """The same on standard error, where there is no table for people; name: of the cost table."""
    if note := busy_note(provenance):
        say(f"Note: {name} was {note}")


def say_of_statistic(statistic: Statistic, tables: Iterable[CostTable]) -> None:
    """A line on standard error, if another figure than the least was asked for and changes nothing."""
    costs = [cost for table in tables for kinds in table.costs.values() for cost in kinds.values()]
    if statistic == "minimum" or not costs or any(getattr(cost, statistic) != cost.minimum for cost in costs):
        return
    say(f"Note: --statistic {statistic} changes nothing: each cost is one figure, counted or stated, not measured")


BUSY = "measured_on_busy_machine"
"""The key of a row that says so: true or false; null where `measure` did not time the costs."""


def busy_row(provenance: Mapping[str, Any]) -> dict[str, bool | None]:
    """The same in a row for scripts."""
    return {BUSY: measured_on_busy_machine(provenance)}


def range_note(table: CostTable, designs: Mapping[str, Timing], options: Options, tasks: Sequence[Task] = ()) -> str:
    """A line with the least speed of each method by the least costs and by the 95th percentile: what a run of measured
    costs leaves open, to which another machine adds. Empty where no cost has a range, and where it takes a simulation.

    designs: by the method.
    """
    if not any(_has_range(table, method, timing, options, tasks) for method, timing in designs.items()):
        return ""
    scale, unit = (SECONDS[table.unit] * 10**6, ", us an HR period") if table.unit in SECONDS else (Fraction(1), "")
    ends = {method: _ends(table, method, timing, options) for method, timing in designs.items()}
    shown = ", ".join(
        f"{method} {' to '.join(f'{float(scale * end):.3g}' for end in speeds)}" for method, speeds in ends.items()
    )
    return f"least speed from minimum to p95 costs{unit}: {shown}; another machine may lie outside"


def measured_row(
    table: CostTable,
    method: str,
    timing: Timing,
    options: Options,
    tasks: Sequence[Task] = (),
    scale: Fraction = Fraction(1),
) -> dict[str, Any]:
    """The same in a row for scripts, beside `min_speed`, of which the table's unit is `scale`; whether the machine was
    busy. Null where the note says nothing."""
    least, most = (
        (float(scale * speed) for speed in _ends(table, method, timing, options))
        if _has_range(table, method, timing, options, tasks)
        else (None, None)
    )
    return {"min_speed_least": least, "min_speed_most": most} | busy_row(table.provenance)


def _has_range(table: CostTable, method: str, timing: Timing, options: Options, tasks: Sequence[Task]) -> bool:
    """Whether one can be told, of the least speed."""
    from sched_sim.design.least_speed import has_closed_form
    from sched_sim.design.methods import select

    spread = any(cost.minimum != cost.p95 for cost in table.costs.get(method, {}).values())
    return spread and has_closed_form(options, tasks, select(table, method, options), timing)


def _ends(table: CostTable, method: str, timing: Timing, options: Options) -> tuple[Fraction, Fraction]:
    """The least speed by the least costs, and by their 95th percentile, in the unit of the table."""
    from sched_sim.design.least_speed import least_speed
    from sched_sim.design.methods import select

    least, most = (
        least_speed(select(table, method, options, statistic), timing, options).speed for statistic in BOTH_ENDS
    )
    return least, most


BOTH_ENDS: tuple[Statistic, Statistic] = ("minimum", "p95")
