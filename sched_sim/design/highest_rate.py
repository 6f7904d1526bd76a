"""The highest rate of the HR loop at which a design still meets every deadline, with all else held in seconds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction

from sched_sim.bounds import MOST_STEPS
from sched_sim.design.least_speed import achieved_l, has_closed_form, least_speed
from sched_sim.design.methods import method_of
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs
from sched_sim.design.times import Times
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.schedule.tasks import Task, phases_matter

DIGITS = 4
"""To so many the rate is found."""


def landing(costs: Costs, timing: Timing, pace: Fraction, options: Options, tasks: Sequence[Task]) -> int | None:
    """The L at which corrections land where every deadline holds, at the latest; None if one does not.

    pace: the speed, in cost units per HR period.
    """
    if phases_matter(tasks):
        from sched_sim.design.any_phase import worst_landing

        return worst_landing(costs, timing, pace, options, tasks)
    if not has_closed_form(options, tasks, costs, timing):
        from sched_sim.design.steady import run_until_steady

        steady = run_until_steady(costs, timing, pace, options, tasks)
        return max(steady.schedule.achieved, default=None) if steady.repeats else None
    if least_speed(costs, timing, options).speed > pace:
        return None
    landed = achieved_l(costs, timing, pace, options)
    return landed if landed is not None and landed <= timing.L else None


def highest_rate(
    costs: Costs, times: Times, hr_hz: Fraction, options: Options = Options(), tasks: Sequence[Task] = ()
) -> Fraction | None:
    """The highest rate, in Hz, to four digits, at which every deadline holds; None if there is none.

    The rate of measurements, the delay, the time by which corrections land and the periods of the tasks stay what they
    are in seconds. costs: in seconds. hr_hz: the rate of which the tasks are in HR periods; at others the phases of
    tasks with a given offset may be any. Between two rates that are looked at, rounding to steps may let one more fit.
    """
    law = method_of(costs).law(options.feedback)

    def fits(rate: Fraction) -> bool:
        try:
            N, M, L = times.steps(rate)
            assert N is not None
            M = M or 0
            if N > MOST_STEPS or (M > N and not law.several):
                return False
            latest = law.latest(N, M)
            timing = Timing(N, M, latest if L is None else L if law.several else min(L, latest))
            method_of(costs).check_design(costs, timing, options.feedback)
            return landing(costs, timing, 1 / rate, options, _at(tasks, rate, hr_hz)) is not None
        except InputError:
            return False

    below, above = _bracket(fits, hr_hz, times.measurement_hz or Fraction(0))
    if below is None:
        return None
    grid = _grid(above)
    low, high = below // grid, -(-above // grid)
    while high - low > 1:
        middle = (low + high) // 2
        if fits(middle * grid):
            low = middle
        else:
            high = middle
    return max(low * grid if fits(low * grid) else below, below)


def _bracket(fits: Callable[[Fraction], bool], start: Fraction, least: Fraction) -> tuple[Fraction | None, Fraction]:
    """A rate that fits, and one twice as high that does not."""
    rate = start
    if fits(rate):
        while fits(2 * rate):
            rate *= 2
        return rate, 2 * rate
    while rate >= least:
        rate /= 2
        if fits(rate):
            return rate, 2 * rate
    return None, start


def _grid(rate: Fraction) -> Fraction:
    """What the last of the digits of a rate counts."""
    return Fraction(10) ** (len(str(int(rate))) - DIGITS) if rate >= 1 else Fraction(1, 10**DIGITS)


def _at(tasks: Sequence[Task], rate: Fraction, hr_hz: Fraction) -> list[Task]:
    """The same tasks in the HR periods of another rate."""
    if rate == hr_hz:
        return list(tasks)
    scale = rate / hr_hz
    return [
        replace(
            task,
            period=scale * task.period,
            jitter=scale * task.jitter,
            deadline=scale * task.due,
            offset="any",
        )
        for task in tasks
    ]
