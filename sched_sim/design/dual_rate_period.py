"""The least HR period of a dual-rate design with one correction on its way at a time, and where it lands, in closed
form: plain functions of whole numbers, like those of `demand`, and loops of them over many designs."""

from __future__ import annotations

from collections.abc import MutableSequence, Sequence
from typing import TypeAlias

from sched_sim.design.demand import (
    HR,
    NOT_LANDED,
    Demand,
    Work,
    exceeds,
    first_end,
    hr_job,
    larger,
    longest_hr_job,
    meets,
    propagate_window,
    total_window,
    update_window,
)

Columns: TypeAlias = tuple[Sequence[int], ...]
"""Of many designs, each part; arrays where it is compiled."""

Found: TypeAlias = Sequence[MutableSequence[int]]


def least_period(work: Work, N: int, M: int, L: int) -> Demand:
    """At which every deadline holds, and what binds."""
    return _least_same_step(work, N, M, L) if work.same_step else _least_next_step(work, N, M, L)


def landing(work: Work, N: int, M: int, period: int, scale: int) -> int:
    """The L at which corrections land at an HR period of `period / scale` ticks, or NOT_LANDED."""
    if period < longest_hr_job(work, N) * scale:
        return NOT_LANDED
    if work.same_step:
        return _landing_same_step(work, N, M, period, scale)
    return _landing_next_step(work, N, M, period, scale)


def _least_next_step(work: Work, N: int, M: int, L: int) -> Demand:
    """The HR job of step l also runs the HR update. Which step that is depends on the speed, and there are three
    cases: l = k+N, where it delays the LR jobs of the next cycle; l = k+1, whose HR job is another; all others.
    A slower processor lands later, so the first case that is consistent with itself is the least speed.
    """
    if L == N:
        at_next_k = _landing_at(work, N, M, N, hr_job(work, N, 0), work.hr_update)
        if M >= N - 1 or first_end(work, N, M, at_next_k[0], at_next_k[1]) >= N:
            return at_next_k
    ordinary = _landing_at(work, N, M, max(min(L, N - 1), M + 1), hr_job(work, N, 2), 0)
    if M == 0 and (L == 1 or first_end(work, N, M, ordinary[0], ordinary[1]) == 1):
        return _landing_at(work, N, M, M + 1, hr_job(work, N, 1), 0)
    return ordinary


def _landing_at(work: Work, N: int, M: int, end: int, landing_job: int, delay: int) -> Demand:
    """Where the LR jobs are done by `end`, `delay` ticks after they could begin, and this HR job runs the update."""
    least = max(longest_hr_job(work, N), landing_job + work.hr_update), 1, HR
    if work.by_m:
        least = larger(least, propagate_window(work, N, M, delay))
    least = larger(least, update_window(work, N, M, end, 0 if M else delay))
    return larger(least, total_window(work, N, end, delay))


def _landing_next_step(work: Work, N: int, M: int, period: int, scale: int) -> int:
    end = first_end(work, N, M, period, scale)
    if end > N or period < (hr_job(work, N, end if end < N else 0) + work.hr_update) * scale:
        return NOT_LANDED
    if end == N:
        update = update_window(work, N, M, N, 0 if M else work.hr_update)
        if not (meets(period, update, scale) and meets(period, total_window(work, N, N, work.hr_update), scale)):
            return NOT_LANDED
    return end


def _least_same_step(work: Work, N: int, M: int, L: int) -> Demand:
    """The HR update runs as soon as the LR update finishes, in step j or, if it does not fit, into step j+1, where
    it delays the HR job. Of all j that are consistent with themselves the last gives the least speed, for a slower
    processor finishes later. Between step 2, from which on HR jobs are alike, and L, none is after one that is not:
    there the windows that end with step j ask for less and less, what it takes to finish no sooner.
    """
    loop = longest_hr_job(work, N), 1, HR
    if work.by_m:
        loop = larger(loop, propagate_window(work, N, M, 0))
    last = max(min(first_end(work, N, M, loop[0], loop[1]) - 1, L), M)
    if _is_consistent(work, N, M, last, L, loop):
        return _finished_in(work, N, M, last, L, loop)
    low, high = max(M, 2), last
    while low < high:
        middle = (low + high) // 2
        if _is_consistent(work, N, M, middle, L, loop):
            low = middle + 1
        else:
            high = middle
    step = min(low, last) - 1
    while not _is_consistent(work, N, M, step, L, loop):
        step -= 1
    return _finished_in(work, N, M, step, L, loop)


def _is_consistent(work: Work, N: int, M: int, step: int, L: int, loop: Demand) -> bool:
    """Whether at the least period where the LR update finishes in `step` it does; in step m it cannot be earlier."""
    least = _finished_in(work, N, M, step, L, loop)
    return step == M or first_end(work, N, M, least[0], least[1]) == step + 1


def _finished_in(work: Work, N: int, M: int, step: int, L: int, loop: Demand) -> Demand:
    """The least period where the LR update finishes in `step`; loop: what is needed besides."""
    feedback = _feedback_in(work, N, M, step)
    if step < L:
        after = _feedback_after(work, N, M, step)
        feedback = after if exceeds(feedback, after) else feedback
    least = larger(loop, update_window(work, N, M, step + 1, 0))
    return larger(larger(least, total_window(work, N, step + 1, 0)), feedback)


def _feedback_in(work: Work, N: int, M: int, step: int) -> Demand:
    """HR update done within `step`, in which the LR update finishes."""
    update = work.hr_update
    least = larger(update_window(work, N, M, step + 1, update), total_window(work, N, step + 1, update))
    return larger(least, (hr_job(work, N, step) + update, 1, HR)) if work.separate else least


def _feedback_after(work: Work, N: int, M: int, step: int) -> Demand:
    """HR update begun in `step`, in which the LR update finishes, and done in the next, with the next HR job."""
    following = work.hr_update
    if work.separate:
        following += hr_job(work, N, step + 1)
    least = larger(update_window(work, N, M, step + 2, following), total_window(work, N, step + 2, following))
    return larger(least, (hr_job(work, N, step) + following, 2, HR)) if work.separate else least


def _landing_same_step(work: Work, N: int, M: int, period: int, scale: int) -> int:
    step = min(first_end(work, N, M, period, scale) - 1, N)
    if step < N and meets(period, _feedback_in(work, N, M, step), scale):
        return step
    if step + 1 < N and meets(period, _feedback_after(work, N, M, step), scale):
        return step + 1
    return NOT_LANDED


def least_periods(work: Work, designs: Columns, found: Found) -> None:
    """designs: N, M and L. Into `found` the three columns of a `Demand`."""
    N, M, L = designs
    for i in range(len(N)):
        found[0][i], found[1][i], found[2][i] = least_period(work, N[i], M[i], L[i])


def landings(work: Work, designs: Columns, found: Found) -> None:
    """designs: N, M, and the period and scale. Into `found` one column."""
    N, M, period, scale = designs
    for i in range(len(N)):
        found[0][i] = landing(work, N[i], M[i], period[i], scale[i])
