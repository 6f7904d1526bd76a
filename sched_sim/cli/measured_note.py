"""What is said below every table that measured costs are in: that the machine was busy, and how far they reach."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from sched_sim.cli.output import say
from sched_sim.costs.table import SECONDS, CostTable

if TYPE_CHECKING:
    from sched_sim.design.options import Options
    from sched_sim.design.pieces import Statistic
    from sched_sim.design.timing import Timing
    from sched_sim.schedule.tasks import Task


def busy_note(provenance: Mapping[str, Any]) -> str:
    """A line, if the machine was busy while the costs were timed; empty otherwise."""
    busy = provenance.get("busy")
    return f"measured on a busy machine: {busy}; measure again on an idle one" if busy else ""


def say_busy(name: str, provenance: Mapping[str, Any]) -> None:
    """The same on standard error, where there is no table for people; name: of the cost table."""
    if note := busy_note(provenance):
        say(f"Note: {name} was {note}")


def range_note(table: CostTable, designs: Mapping[str, Timing], options: Options, tasks: Sequence[Task] = ()) -> str:
    """A line with the least speed of each method by the least costs and by the 95th percentile: what a run of measured
    costs leaves open, to which another machine adds. Empty where no cost has a range, and where it takes a simulation.

    designs: by the method.
    """
    from sched_sim.design.least_speed import has_closed_form, least_speed
    from sched_sim.design.methods import select

    if not _spread(table, designs):
        return ""
    costs = {method: select(table, method, options) for method in designs}
    if not all(has_closed_form(options, tasks, costs[method], timing) for method, timing in designs.items()):
        return ""
    scale, unit = (SECONDS[table.unit] * 10**6, ", us an HR period") if table.unit in SECONDS else (Fraction(1), "")

    def speed(method: str, statistic: Statistic) -> str:
        least = least_speed(select(table, method, options, statistic), designs[method], options)
        return f"{float(scale * least.speed):.3g}"

    shown = ", ".join(f"{method} {speed(method, 'minimum')} to {speed(method, 'p95')}" for method in designs)
    return f"least speed from minimum to p95 costs{unit}: {shown}; another machine may lie outside"


def _spread(table: CostTable, methods: Mapping[str, Any]) -> bool:
    return any(cost.minimum != cost.p95 for method in methods for cost in table.costs[method].values())
