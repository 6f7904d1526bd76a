"""What each landing asks of the processor, and where each speed lands: two views of one staircase."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction

from sched_sim.design.landing import landing
from sched_sim.design.least_speed import LeastSpeed, Stair, achieved_l, has_closed_form, least_speed, staircase
from sched_sim.design.methods import method_of
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs, DualRateCosts
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.schedule.tasks import Task
from studies.explorer.searched import MOST_WORK_BESIDE, most_beside, patience, searched
from studies.selection.front import some_landings

MOST_STAIRS = 200
"""Of one method."""

MOST_SIMULATED = 3
"""Beside that of the design, where each takes a search by simulation."""


def stairs(
    costs: Costs, timing: Timing, options: Options, tasks: Sequence[Task], own: LeastSpeed, *, beside: bool = True
) -> list[Stair]:
    """Of some legal L, all where there are no more than MOST_STAIRS, and of the timing's own, whose least speed is
    known; without a closed form of MOST_SIMULATED others, or of none where each takes long or none is wanted `beside`.
    Raises InputError as `least_speed` does."""
    law = method_of(costs).law(options.feedback)
    legal = law.legal(timing.N, timing.M)
    if law.only_first:
        return [Stair(legal[0], own.speed, own.binding, legal[0])]
    if in_closed_form(costs, timing, options, tasks):
        at = {*some_landings(legal[0], legal[-1], MOST_STAIRS), timing.L}
        found = staircase(costs, timing.N, timing.M, options, only=frozenset(at))
        return found if timing.L in legal else [*found, _stair(costs, timing, options, tasks, own)]
    beside = beside and searched(costs, timing, options, tasks) <= most_beside(tasks)
    at = {*some_landings(legal[0], legal[-1], MOST_SIMULATED)} - {timing.L} if beside else set()
    known = sorted([(timing.L, own), *_searched(costs, timing, options, tasks, at)])
    return [_stair(costs, replace(timing, L=L), options, tasks, least) for L, least in known]


def _searched(
    costs: Costs, timing: Timing, options: Options, tasks: Sequence[Task], at: Iterable[int]
) -> Iterator[tuple[int, LeastSpeed]]:
    """But for those that take too long."""
    for L in at:
        with suppress(InputError):
            yield L, least_speed(costs, replace(timing, L=L), options, tasks, on_work=patience(MOST_WORK_BESIDE))


def in_closed_form(costs: Costs, timing: Timing, options: Options, tasks: Sequence[Task]) -> bool:
    """Whether no stair takes a simulation, up to the L that is meant where none is given."""
    latest = method_of(costs).law(options.feedback).latest(timing.N, timing.M)
    return timing.instants is None and has_closed_form(options, tasks, costs, replace(timing, L=latest))


def _stair(costs: Costs, timing: Timing, options: Options, tasks: Sequence[Task], least: LeastSpeed) -> Stair:
    landed = landing(costs, timing, least.speed, options, tasks, least.speed)
    assert landed is not None
    return Stair(timing.L, least.speed, least.binding, landed)


def landings(
    costs: Costs, timing: Timing, options: Options, tasks: Sequence[Task], known: Sequence[Stair]
) -> list[tuple[Fraction, int | None]]:
    """Speeds from which on corrections land in another step than at the one before, each with that L. known: the
    stairs.

    In closed form that is, but for a delayed horizon, where they land whatever else is missed, such as LR propagate by
    step m; and None where they would land earlier, but the HR job that they are part of overruns its step: where that
    begins is known to 1 / FINENESS of a tread.
    """
    closed = isinstance(costs, DualRateCosts) and in_closed_form(costs, timing, options, tasks)
    if closed and options.lr_propagate_by == "m":
        at = frozenset(stair.L for stair in known)
        known = staircase(costs, timing.N, timing.M, replace(options, lr_propagate_by="l"), only=at)
    found: list[tuple[Fraction, int | None]] = []
    last: Stair | None = None
    for stair in sorted(known, key=lambda stair: (stair.speed, stair.achieved)):
        if last is not None and stair.achieved >= last.achieved:
            continue
        if closed and last is not None:
            found += _overrun(costs, timing, options, last.speed, stair.speed)
        found.append((stair.speed, stair.achieved))
        last = stair
    return found


FINENESS = 4096


def _overrun(
    costs: Costs, timing: Timing, options: Options, start: Fraction, end: Fraction
) -> list[tuple[Fraction, int | None]]:
    """Where, between two speeds, an HR job begins to overrun; nothing if none does."""

    def lands(part: int) -> bool:
        speed = start + (end - start) * Fraction(part, FINENESS)
        return achieved_l(costs, timing, speed, options) is not None

    if lands(FINENESS - 1):
        return []
    first = bisect_left(range(1, FINENESS - 1), True, key=lambda part: not lands(part))
    return [(start + (end - start) * Fraction(first, FINENESS), None)]
