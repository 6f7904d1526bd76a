"""Whether a method fits a processor: costs in seconds against the seconds of an HR period."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from sched_sim.design.arguments import checked
from sched_sim.design.least_speed import LeastSpeed, achieved_l, has_closed_form, least_speed
from sched_sim.design.load import loads
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs
from sched_sim.design.timing import Timing
from sched_sim.schedule.tasks import Task, phases_matter
from sched_sim.ticks import Number, positive


@dataclass(frozen=True, slots=True)
class Fit:
    """One method on one processor at one HR rate.

    least: the least speed, in seconds of work per HR period, and what fixes it.
    needed: the share of the processor's speed at which every deadline holds; above 1 it is too slow.
    load: the share of its time that it works at its own speed, mean of the processors where there are two; with context
        switches that of the simulated time, where it is at most 1 and which ends at a miss.
    fits: whether every deadline holds at its own speed. landed: the L at which corrections land then, None if not.
    """

    least: LeastSpeed
    needed: Fraction
    load: Fraction
    fits: bool
    landed: int | None

    @property
    def slack(self) -> Fraction:
        """The share of the processor's speed that is not needed; negative: so much is lacking."""
        return 1 - self.needed


def fit(
    costs: Costs,
    timing: Timing,
    hr_hz: Number,
    options: Options = Options(),
    tasks: Sequence[Task] = (),
    on_progress: Callable[[int], None] = lambda _runs: None,
) -> Fit:
    """Whether a method meets every deadline on a processor, and how much of it is needed.

    costs: in seconds, as `part.on_part` makes them; hr_hz: rate of the HR loop.

    Raises InputError as `least_speed` does.
    """
    tasks = checked(timing, options, tasks)
    pace = 1 / positive(hr_hz, "hr_hz")
    least = least_speed(costs, timing, options, tasks, on_progress)
    busy = sum(loads(costs, timing, pace, options, tasks), Fraction(0)) / options.cpus
    if phases_matter(tasks):
        from sched_sim.design.any_phase import worst_landing

        landed = worst_landing(costs, timing, pace, options, tasks)
        fits = landed is not None
    elif not has_closed_form(options, tasks):
        from sched_sim.design.steady import run_until_steady

        steady = run_until_steady(costs, timing, pace, options, tasks)
        fits, landed = steady.repeats, max(steady.schedule.achieved, default=None)
        if options.context_switch:
            busy = steady.schedule.utilization
    else:
        landed = achieved_l(costs, timing, pace, options)
        fits = least.speed <= pace and landed is not None and landed <= timing.L
    return Fit(least, least.speed / pace, busy, fits, landed if fits else None)
