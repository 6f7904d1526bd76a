"""Demand of the dual-rate filter over windows of a cycle, as exact quotients.

A window of c steps offers c HR periods of processor time; the work that must be done in it, divided by c, is the
HR period (in ticks) that it takes at least. Steps are counted from k. All of it is plain functions of whole numbers,
which run in Python, where nothing overflows, and compiled (`sched_sim.compiled`).
"""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

from sched_sim.design.binding import Binding
from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts

HR, LR_PROPAGATE, LR_UPDATE, LR_TOTAL, *_ = map(int, Binding)
"""As plain numbers, which is what can be compiled."""

Demand: TypeAlias = tuple[int, int, int]
"""Work in ticks, the HR periods in which it must be done (at least 1), and the code of a `Binding`."""


NOT_LANDED = -1
"""Instead of an achieved L where an HR job overruns its step, or nothing lands before the next measurement; of
a delayed horizon also where its LR jobs pile up."""


class Work(NamedTuple):
    """Work of the jobs of one cycle, in ticks, and the rules they run by.

    lr_early: what comes before the LR update, propagate, and the gain if it is precomputed. separate: LR jobs have a
    processor of their own. same_step: feedback is in the step in which the LR update finishes. by_m: what comes before
    it is due by m.
    """

    hr: int
    hr_restart: int
    hr_update: int
    lr_early: int
    lr_update: int
    separate: bool
    same_step: bool = False
    by_m: bool = False


def work_of(costs: DualRateCosts[int], options: Options) -> Work:
    same_step, by_m = options.feedback == "same-step", options.lr_propagate_by == "m"
    early = costs.lr_propagate + costs.lr_gain
    separate = options.cpus == 2
    return Work(costs.hr, costs.hr_restart, costs.hr_update, early, costs.lr_update, separate, same_step, by_m)


def exceeds(first: Demand, second: Demand) -> bool:
    return first[0] * second[1] > second[0] * first[1]


def larger(first: Demand, second: Demand) -> Demand:
    """The first of equals."""
    return second if exceeds(second, first) else first


def meets(period: int, demand: Demand, scale: int) -> bool:
    """Whether an HR period of `period / scale` ticks is enough."""
    return demand[1] * period >= demand[0] * scale


def hr_job(work: Work, N: int, step: int) -> int:
    """The HR job of one step, without the HR update."""
    return work.hr_restart if step == 1 or N == 1 else work.hr


def longest_hr_job(work: Work, N: int) -> int:
    """The longest HR job of the cycle, without the HR update."""
    return work.hr_restart if N == 1 or work.hr_restart > work.hr else work.hr


def hr_work(work: Work, N: int, first: int, end: int) -> int:
    """All HR jobs of steps first .. end-1 without HR updates, 0 <= first <= end <= N."""
    steps = end - first
    if N == 1:
        return steps * work.hr_restart
    return steps * work.hr + (work.hr_restart - work.hr if first <= 1 < end else 0)


def before_lr(work: Work, N: int, steps: int) -> int:
    """HR work that LR jobs have to wait for between k and the start of step k + `steps` (at least 1)."""
    return hr_job(work, N, 0) if work.separate else hr_work(work, N, 0, steps)


def update_window(work: Work, N: int, M: int, end: int, more: int) -> Demand:
    """The LR update, and `more`, between m and the start of step `end`."""
    hr = 0 if work.separate else hr_work(work, N, M, end)
    return hr + work.lr_update + more, end - M, LR_UPDATE


def total_window(work: Work, N: int, end: int, more: int) -> Demand:
    """All LR work, and `more`, between k and the start of step `end`."""
    return before_lr(work, N, end) + work.lr_early + work.lr_update + more, end, LR_TOTAL


def propagate_window(work: Work, N: int, M: int, more: int) -> Demand:
    """LR propagate (and gain), and `more`, between k and m; nothing where m = k."""
    return (before_lr(work, N, M) + work.lr_early + more, M, LR_PROPAGATE) if M else (0, 1, LR_PROPAGATE)


def first_end(work: Work, N: int, M: int, period: int, scale: int) -> int:
    """The first step by whose start all LR work is done, at an HR period of `period / scale` ticks; it may lie
    beyond N. The period must be enough for every HR job, and no HR update runs between k and then."""
    update, total = work.lr_update * scale, (work.lr_early + work.lr_update) * scale
    first = hr_job(work, N, 0) * scale
    if work.separate:
        return max(M + _steps(update, period, N), _steps(first + total, period, N))
    if M == 0 and period - first >= total:
        return 1
    slack = period - work.hr * scale
    saved = (work.hr_restart - work.hr) * scale
    by_update = M + _steps(update + (saved if M <= 1 else 0), slack, N)
    return max(by_update, _steps(total + saved, slack, N), 2)


def _steps(work: int, slack: int, N: int) -> int:
    """How many steps it takes to do `work` when each leaves `slack`: at least one; more than N if it never ends."""
    if slack > 0:
        return max(-(-work // slack), 1)
    return N + 1 if work > 0 else 1
