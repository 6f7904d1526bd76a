"""Whether a method fits a processor: costs in seconds against the seconds of an HR period."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from sched_sim.design.arguments import checked
from sched_sim.design.highest_rate import highest_rate
from sched_sim.design.landing import landing
from sched_sim.design.least_speed import LeastSpeed, least_speed
from sched_sim.design.load import loads
from sched_sim.design.long_pattern import of_bound
from sched_sim.design.methods import method_of
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs
from sched_sim.design.times import Times
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.schedule.tasks import Task
from sched_sim.ticks import Number, positive


@dataclass(frozen=True, slots=True)
class Fit:
    """One method on one processor at one HR rate.

    least: the least speed, in seconds of work per HR period, and what fixes it.
    needed: the share of the processor's speed at which every deadline holds; above 1 it is too slow.
    load: the share of its time that it works at its own speed, mean of the processors where there are two; with context
        switches that of the simulated time, where it is at most 1 and which ends at a miss. Of several corrections on
        their way, as if they landed as soon as measurements arrive: later ones take a few HR updates more.
    fits: whether every deadline holds at its own speed. landed: the L at which corrections land then, None if not.
    highest_hz: the highest HR rate at which it fits, with all else held in seconds, see `highest_rate`, or the rate
    that was asked about, where that is higher and fits; None if none.
    """

    least: LeastSpeed
    needed: Fraction
    load: Fraction
    fits: bool
    landed: int | None
    highest_hz: Fraction | None

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
    *,
    times: Times | None = None,
) -> Fit:
    """Whether a method meets every deadline on a processor, and how much of it is needed.

    costs: in seconds, as `part.on_part` makes them; hr_hz: rate of the HR loop. times: of the design, for the highest
    rate; by default what its steps are at hr_hz.

    Raises InputError as `least_speed` does, and for a task that takes longer than its period.
    """
    tasks = checked(timing, options, tasks)
    rate = positive(hr_hz, "hr_hz")
    check_shares(tasks, rate)
    least = least_speed(costs, timing, options, tasks, on_progress)
    busy = busy_share(costs, timing, 1 / rate, options, tasks)
    landed = landing(costs, timing, 1 / rate, options, tasks)
    period_ms = 1000 / rate
    held = times or Times(rate / timing.N, timing.M * period_ms, timing.L * period_ms)
    highest = highest_rate(costs, held, rate, options, tasks)
    if landed is not None:  # it may have more digits, and the phases of tasks are those that are given
        highest = rate if highest is None else max(highest, rate)
    return Fit(least, least.speed * rate, busy, landed is not None, landed, highest)


def check_shares(tasks: Sequence[Task], rate: Fraction, second: Fraction = Fraction(1)) -> None:
    """Raises InputError for a task that takes longer than its period. rate: of the HR loop, in Hz; second: seconds in
    the unit of the tasks' costs."""
    for task in tasks:
        if (share := second * task.cost / task.period * rate) > 1:
            raise InputError(
                f"task {task.name!r} alone needs {float(100 * share):.4g} % of the processor: its cost is "
                f"{float(1000 * second * task.cost):.4g} ms and its period {float(1000 * task.period / rate):.4g} ms; "
                f"mend them, or their units"
            )


def busy_share(costs: Costs, timing: Timing, pace: Fraction, options: Options, tasks: Sequence[Task]) -> Fraction:
    """`Fit.load`, of a processor of this speed, in cost units per HR period."""
    if not (options.context_switch or method_of(costs).work_varies):
        return sum(loads(costs, timing, pace, options, tasks), Fraction(0)) / options.cpus
    from sched_sim.design.simulate import at_worst_phase
    from sched_sim.design.steady import run_until_steady

    costs, timing = of_bound(costs, timing)
    at = at_worst_phase(costs, timing, pace, options, tasks)
    return run_until_steady(costs, timing, pace, options, at).schedule.utilization
