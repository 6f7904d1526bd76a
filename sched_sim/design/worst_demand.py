"""Whether every deadline holds with earliest deadline first, where the phases of tasks are not known.

It does if what is both released and due in a window is never more than its length (S. K. Baruah, L. E. Rosier and
R. R. Howell, Algorithms and complexity concerning the preemptive scheduling of periodic, real-time tasks on one
processor, 1990), nor with the longest job due later that cannot be preempted (K. Jeffay, D. F. Stanat and C. U. Martel,
On non-preemptive scheduling of periodic and sporadic tasks, 1991); for windows that open as in `worst_phase`.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

import numpy as np

from sched_sim.design.phased import Phased, ceiling
from sched_sim.design.whole import Ints
from sched_sim.design.worst_phase import EndlessError, Level, starts

LONGEST_WINDOW = 2**14
"""HR periods; where more may be due than can be done only in longer windows, the work is taken for too much."""


def overloaded(design: Phased) -> str | None:
    """The kind of a job that is due where more is to be done than can be; None if there is none.

    Of one processor. Raises EndlessError.
    """
    block = max((task.work for task in design.tasks if not task.preemptive), default=0)
    opened = starts(design, Level(0, True, True, design.tasks, block), 0)
    longest = _longest_window(design, block)
    for kind, first, every in _deadlines(design, opened):
        count = longest // every + 2
        start = np.repeat(opened, count)
        length = np.repeat(first, count) + np.tile(design.counted(count) * every, len(opened))
        if (_due(design, start, length) > length).any():
            return kind
    return None


def _longest_window(design: Phased, block: int) -> int:
    """In which more may be due than can be done: what is due in t ticks is at most `share` t + `more`. Raises
    EndlessError.
    """
    cycle, work = design.N * design.period, int(design.before[-1])
    correction = design.cycle.correction + design.switches * design.cycle.apart
    ahead = design.before[:-1] * design.N - design.counted(design.N) * work
    share = Fraction(work + correction, cycle)
    more = block + Fraction(int(ahead.max() - ahead.min()), design.N) + correction
    for task in design.tasks:
        share += Fraction(task.work, task.period)
        more += task.work * max(1 + Fraction(task.jitter - task.deadline, task.period), Fraction(0))
    for job in design.cycle.low:
        share += Fraction(job.work + design.switches, cycle)
        more += (job.work + design.switches) * (1 - Fraction((job.due - job.release) * design.period, cycle))
    if share > 1 or (more and (share == 1 or more > (1 - share) * LONGEST_WINDOW * design.period)):
        raise EndlessError
    return int(more / (1 - share)) if more else 0


def _deadlines(design: Phased, start: Ints) -> Iterator[tuple[str, Ints, int]]:
    """Of each kind of job: from each start to the first deadline, and from one to the next."""
    cycle = design.N * design.period
    yield "hr", -start % design.period, design.period
    for job in design.cycle.low:
        yield job.kind, (job.due * design.period - start) % cycle, cycle
    for task in design.tasks:
        if task.first is None:
            yield task.name, 0 * start + task.deadline - task.jitter, task.period
        else:
            yield task.name, (task.first + task.deadline - start) % task.period, task.period


def _due(design: Phased, start: Ints, length: Ints) -> Ints:
    """What is released and due in [start, start + length], and one job due later that cannot be preempted."""
    end, period, cycle = start + length, design.period, design.N * design.period
    first, after = design.first_step(start), np.maximum(end // period, design.first_step(start))
    if design.cycle.apart:
        due = (design.cycle.last + 1) * period
        corrections = (end - due) // cycle - (start - due) // cycle
        work = design.high(first, after) + corrections * (design.cycle.correction + design.switches)
    else:
        work = design.high_and_corrections(first, after)
    for job in design.cycle.low:
        count = (end - job.due * period) // cycle - ceiling(start - job.release * period, cycle) + 1
        work = work + np.maximum(count, 0) * (job.work + design.switches)
    block = 0 * start
    for task in design.tasks:
        work = work + task.due(start, length) * task.work
        if not task.preemptive:
            block = np.maximum(block, np.where(length < task.deadline, 0 * start + task.work, 0))
    return work + np.where(work > 0, block, 0)
