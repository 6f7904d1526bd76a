"""What least speeds are where several measurements are on their way and their intervals are not all alike."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from sched_sim.design.pieces import Costs
    from sched_sim.design.timing import Timing
    from sched_sim.schedule.tasks import Task


def uneven_note(designs: Mapping[str, tuple[Costs, Timing]], tasks: Sequence[Task]) -> str:
    """Lines below a table; empty where all intervals count as the shorter one.

    designs: costs and timing by method.
    """
    from sched_sim.design.long_pattern import is_bound
    from sched_sim.design.uneven import comes_unevenly
    from sched_sim.schedule.tasks import phases_matter

    exact: list[str] = []
    bounds: list[str] = []
    N = 0
    for method, (costs, timing) in designs.items():
        if timing.instants is None or not (comes_unevenly(costs, timing) or method == "dual-rate"):
            continue
        N = timing.N
        (bounds if phases_matter(tasks) or is_bound(costs, timing) else exact).append(method)
    intervals = f"the intervals of {N} and {N + 1} as they come"
    said = [f"{', '.join(exact)}: least speed with {intervals}"] if exact else []
    if bounds:
        said.append(f"{', '.join(bounds)}: least speed is an upper bound, for each interval counts as {N}")
    return "\n".join(said)
