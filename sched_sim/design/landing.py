"""Where corrections land where every deadline holds, by whichever way of finding out there is."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from sched_sim.design.least_speed import achieved_l, alone, has_closed_form, least_speed
from sched_sim.design.long_pattern import of_bound
from sched_sim.design.methods import method_of
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs
from sched_sim.design.timing import Timing
from sched_sim.schedule.tasks import Task, phases_matter


def landing(
    costs: Costs,
    timing: Timing,
    pace: Fraction,
    options: Options,
    tasks: Sequence[Task],
    least: Fraction | None = None,
) -> int | None:
    """The L at which corrections land where every deadline holds, at the latest; None if one does not.

    pace: the speed, in cost units per HR period; least: the least speed, where it is known.
    """
    own = costs
    costs, timing = of_bound(costs, timing)
    if phases_matter(tasks):
        from sched_sim.design.any_phase import worst_landing

        return worst_landing(costs, timing, pace, options, tasks)
    if not has_closed_form(options, tasks, costs, timing):
        before = alone(costs, timing, options, tasks)
        if before is not None and (landed := landing(own, before, pace, options, tasks)) is not None:
            return landed
        from sched_sim.design.steady import run_until_steady

        steady = run_until_steady(costs, timing, pace, options, tasks)
        return max(steady.schedule.achieved, default=None) if steady.repeats else None
    if (least_speed(costs, timing, options).speed if least is None else least) > pace:
        return None
    if method_of(costs).lands_in_step_m:
        return timing.M
    landed = achieved_l(costs, timing, pace, options)
    return landed if landed is not None and landed <= timing.L else None
