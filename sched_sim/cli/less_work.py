"""Whether deadlines hold where executions take less than their costs: for scripts, and in words."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import fields
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from sched_sim.rounding import no_less

if TYPE_CHECKING:
    from sched_sim.design.less_work import LessWork
    from sched_sim.design.pieces import Costs
    from sched_sim.schedule.tasks import Task


def row_of(found: LessWork) -> dict[str, Any]:
    """less_work: holds, fails or unknown; of what fails the costs, by piece."""
    less = None if found.costs is None else {name: float(work) for name, work in _pieces(found.costs).items()}
    word = {True: "holds", False: "fails", None: "unknown"}[found.holds]
    return {"less_work": word, "less_work_tried": found.tried, "less_work_costs": less}


def said(found: LessWork, costs: Costs, tasks: Sequence[Task]) -> str:
    if found.holds:
        return "No work up to these costs misses a deadline"
    if found.holds is None:
        return f"Whether less work misses a deadline is not known: none of {found.tried} tried does"
    if found.costs is None or not found.tried:
        return "A deadline may be missed at these costs already"
    less = [
        f"{name} {float(work):.6g} instead of {float(_pieces(costs)[name]):.6g}"
        for name, work in _pieces(found.costs).items()
        if work != _pieces(costs)[name]
    ]
    less += [
        f"task {beside.name} {float(beside.cost):.6g} instead of {float(task.cost):.6g}"
        for task, beside in zip(tasks, found.tasks, strict=True)
        if beside.cost != task.cost
    ]
    return f"Less work misses a deadline: {', '.join(less)} in every cycle"


def least_note(method: str, enough: str | None) -> str:
    """What is to be said of a least speed at which less work may miss a deadline. enough: at which none does."""
    return f"{method}: at its least speed work that takes less may land in another step and miss a deadline; " + (
        "`sched-sim simulate --less-work` looks for such" if enough is None else f"at {enough} none does"
    )


def offsets_note(methods: Iterable[str], tasks: Sequence[Task]) -> str:
    """What is to be said of verdicts beside tasks with given offsets; empty where less work cannot change them."""
    named = [task.name for task in tasks if task.offset != "any"]
    if not named or "dual-rate" not in methods:
        return ""
    return (
        f"dual-rate: beside the offset of {', '.join(named)} a verdict is that of executions that take all of their "
        f"costs; less work may land in another step and miss a deadline: see `sched-sim simulate --less-work`"
    )


def _pieces(costs: Costs) -> dict[str, Fraction]:
    return {piece.name: getattr(costs, piece.name) for piece in fields(costs) if piece.name != "lacks"}


def speed_words(enough: Fraction | None, share: Fraction | None, unit: str) -> str | None:
    """share: of the processor's speed, where there is one; unit: of the costs."""
    if enough is None:
        return None
    if share is not None:
        return f"{no_less(100 * share, 4)} % of this processor's speed"
    return f"{no_less(10**6 * enough, 5)} us" if unit == "second" else no_less(enough, 6)
