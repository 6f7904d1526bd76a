"""Where a method's corrections land: as asked, as a processor lets them, or by what the method is."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

from sched_sim.costs.table import CostTable
from sched_sim.design.landing import landing
from sched_sim.design.methods import METHODS as SCHEDULED
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.pieces import Statistic
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError, option
from sched_sim.schedule.tasks import Task
from studies.selection.methods import METHODS


class Processor(NamedTuple):
    """pace: cost units of the table that it does in an HR period; shown: what it is, for messages."""

    table: CostTable
    pace: Fraction
    shown: str
    options: Options = Options()
    statistic: Statistic = "minimum"
    tasks: Sequence[Task] = ()


class Landed(NamedTuple):
    """L: None where nothing lands; remark: why not, or what was not looked at."""

    L: int | None
    remark: str = ""


def landed(method: str, N: int, M: int, L: int | None, options: Options, processor: Processor | None) -> Landed:
    """L: as asked for, None for what the processor gives, or without one the latest before the next measurement that is
    taken after the delayed one has arrived.

    Raises InputError for an L before the earliest that the method can have.
    """
    rule = METHODS[method].landing
    first = earliest(method, M, options)
    law = None if method not in SCHEDULED else SCHEDULED[method].law(options.feedback)
    if processor is not None:
        found = _scheduled(method, N, M, processor)
        if found is not None:
            return found
    if rule == "later":
        if L is None:
            assert law is not None
            L = law.latest(N, M)
        if first > L:
            raise InputError(
                f"{option('L')} {L} is before a correction of {method} can land: its measurement arrives at M={M}; "
                f"give {option('L')} {first} or more"
            )
        if law is not None and not law.several and N - law.before < L:
            return Landed(None, _beyond(L, first, N - law.before, N))
        return Landed(L, "" if processor is None else _not_costed(processor))
    return Landed(first, "" if processor is None else _not_costed(processor))


def _beyond(L: int, first: int, last: int, N: int) -> str:
    """Why a method that has one measurement on its way cannot land so late."""
    give = f"{option('L')} {f'{first} to {last}' if first < last else last}"
    return (
        f"{option('L')} {L} is after the next measurement is taken, {option('N')} {N}, and one is on its way at a "
        f"time: give {give}, or choose {option('method')} dual-rate"
    )


def earliest(method: str, M: int, options: Options) -> int:
    """The first L that the method can have."""
    rule = METHODS[method].landing
    if rule == "at once":
        return 0
    if rule == "at M":
        return M
    return M if options.feedback == "same-step" and method == "dual-rate" else M + 1


def _scheduled(method: str, N: int, M: int, processor: Processor) -> Landed | None:
    """None for a method that is not scheduled, or whose jobs have no costs."""
    if method not in SCHEDULED or method not in processor.table.costs:
        return None
    law = SCHEDULED[method].law(processor.options.feedback)
    delay = 0 if METHODS[method].landing == "at once" else M
    try:
        costs = select(processor.table, method, processor.options, processor.statistic)
        timing = Timing(N, delay, law.latest(N, delay))
        SCHEDULED[method].check(timing, processor.options.feedback)
        at = landing(costs, timing, processor.pace, processor.options, processor.tasks)
    except InputError as error:
        return Landed(None, str(error))
    if at is None:
        return Landed(None, f"misses deadlines on {processor.shown} and does not land")
    return Landed(0 if METHODS[method].landing == "at once" else at)


def _not_costed(processor: Processor) -> str:
    return f"no costs in {processor.table.name}, so whether it runs on {processor.shown} is not known"
