"""Dual-rate designs that may land after the next measurement is taken: whether it is known without a search that one
which lands before it needs as little."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from math import ceil

from sched_sim.design import analysis
from sched_sim.design.demand import NOT_LANDED
from sched_sim.design.methods import method_of
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs, DualRateCosts, converted, works
from sched_sim.design.timing import Timing
from sched_sim.ticks import ticks_per_unit, to_ticks

LOOK = 8
"""Cycles in which a miss would be seen."""


def gains_nothing(
    costs: Costs, timing: Timing, before: Timing, enough: Fraction, floor: Fraction, options: Options
) -> bool:
    """Whether the design needs no less than `enough`, the least speed of that which lands before the next measurement;
    if False, that is not known. floor: less will never do."""
    if not isinstance(costs, DualRateCosts):
        return False
    return _always_alone(costs, before, floor, options) or _only_at_restart(costs, timing, enough, floor, options)


def _always_alone(costs: DualRateCosts[Fraction], before: Timing, floor: Fraction, options: Options) -> bool:
    """Whether on every processor that is not slower than `floor` LR jobs are done before the step in which the next
    measurement is taken: then a later L changes nothing, and what misses a deadline is an HR job, with any L."""
    last = method_of(costs).law(options.feedback).last_alone(before.N, before.M)
    landed = _landing(replace(costs, hr_update=Fraction(0)), before, floor, options)
    return last is not None and NOT_LANDED < landed < last


def _only_at_restart(
    costs: DualRateCosts[Fraction], timing: Timing, enough: Fraction, floor: Fraction, options: Options
) -> bool:
    """Of designs that need so much because an ordinary HR job and the HR update must fit into a step: on a slower
    processor every correction has to land in step N + 1, whose HR job is less. So the first must not be there by N, and
    of such processors the fastest will do if any does."""
    N, M = timing.N, timing.M
    ordinary = costs.hr + costs.hr_update
    if N < 2 or M < 1 or timing.L > 2 * N or timing.instants or options.feedback != "next-step" or enough != ordinary:
        return False
    from sched_sim.design.search import search_resolution
    from sched_sim.design.steady import run_until_steady

    by_next = _least(replace(costs, hr_update=Fraction(0)), Timing(N, M, N), options)
    resolution = search_resolution(costs, options, ())
    fastest = Fraction(ceil(min(by_next, enough) * resolution) - 1, resolution)
    return fastest < floor or run_until_steady(costs, timing, fastest, options, (), LOOK * N).schedule.misses > 0


def _least(costs: DualRateCosts[Fraction], timing: Timing, options: Options) -> Fraction:
    resolution = ticks_per_unit(works(costs))
    in_ticks = converted(costs, lambda work: to_ticks(work, resolution))
    least = analysis.least_period(in_ticks, timing.N, timing.M, timing.L, options)
    return Fraction(least.numerator, least.denominator * resolution)


def _landing(costs: DualRateCosts[Fraction], timing: Timing, speed: Fraction, options: Options) -> int:
    resolution = ticks_per_unit([*works(costs), speed])
    in_ticks = converted(costs, lambda work: to_ticks(work, resolution))
    return analysis.achieved_l(in_ticks, timing.N, timing.M, to_ticks(speed, resolution), options)
