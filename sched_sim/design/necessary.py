"""What every timing of a range needs at the least, whatever else the processor does: to leave out at once what cannot
fit.

Beside `analysis`, which is exact for one timing: here are only demands that hold for a whole range, with any policy,
any context switches, and any tasks beside the filter.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from sched_sim.design.options import Options
from sched_sim.design.pieces import (
    AugmentationCosts,
    CarriedGainCosts,
    CloneCosts,
    DelayedHorizonCosts,
    DualRateCosts,
    FuseAsFreshCosts,
    JobCosts,
    LarsenCosts,
    LarsenInFlightCosts,
    MultirateCosts,
    Px4PredictorCosts,
    RecalculateCosts,
    RobustCosts,
    StandardCosts,
    at_m,
    beside_others,
    each_step,
    product,
    works,
)


class Range(NamedTuple):
    """Of timings: the least and the most that N and M may be, and the most that L may be."""

    least_N: int
    most_N: int
    least_M: int
    most_M: int
    most_L: int


def demands(costs: JobCosts[int], timings: Range, options: Options) -> Iterator[tuple[int, int]]:
    """Work, in ticks, and the number of HR periods in which it is to be done; a period of 0: it cannot be.

    For each timing of the range that a method can have: it needs a speed of at least each quotient.
    """
    match costs:
        case StandardCosts(propagate, update):
            yield propagate + update, 1
        case RecalculateCosts(propagate, update, replay):
            yield propagate + update + replay * timings.least_M, 1
        case LarsenCosts(propagate, accumulate, update):
            with_product = max(accumulate + update, propagate)
            alone = with_product if timings.least_M >= 2 else min(with_product, propagate + update)
            if isinstance(costs, LarsenInFlightCosts) and timings.most_M > timings.least_N:
                yield min(alone, _of_several(costs, timings)), 1
            else:
                yield alone, 1
        case CloneCosts(propagate, at_k, carry, landing) | CarriedGainCosts(propagate, at_k, carry, landing):
            couple, compensate = beside_others(costs)
            others = max(timings.least_M - 1, 0) // (timings.most_N + 1)
            beside_k, beside_m = others * couple, others * compensate
            yield propagate + others * carry + _carried(at_k + beside_k, carry, landing + beside_m, timings), 1
        case MultirateCosts() | RobustCosts():
            each, once = works(costs)
            yield each, 1
            yield _in_window(each, each, once, timings.most_L, options)
        case Px4PredictorCosts() | AugmentationCosts() | FuseAsFreshCosts():
            yield each_step(costs, timings.least_M) + at_m(costs, timings.least_M), 1
        case DelayedHorizonCosts():
            yield from _delayed_horizon(costs, timings, options)
        case DualRateCosts():
            yield from _dual_rate(costs, timings, options)


def _of_several(costs: LarsenInFlightCosts[int], timings: Range) -> int:
    """The longer of the HR jobs of k and m, where intervals are up to a step more than N."""
    products, others = (max(timings.least_M - steps, 0) // (timings.most_N + 1) for steps in (2, 1))
    at_m = (products + 1) * product(costs) + costs.correct + others * costs.compensate
    at_k = max(others - 1, 0) * product(costs) + costs.gain
    return costs.propagate + max(at_m, at_k)


def _carried(at_k: int, carry: int, at_m: int, timings: Range) -> int:
    """Beyond a propagation: the longer of the work at k and at m, or both where these are one step in all timings."""
    if timings.most_M == 0 or timings.least_M == timings.most_M == timings.least_N == timings.most_N:
        return at_k + at_m
    return max(at_k, at_m, carry if 2 <= timings.least_M <= timings.least_N else 0)


def _delayed_horizon(costs: DelayedHorizonCosts[int], timings: Range, options: Options) -> Iterator[tuple[int, int]]:
    """One HR job; a cycle that lands as soon as it can; the update and the replay from m to l."""
    beside = 0 if options.cpus == 2 else costs.predict
    yield costs.predict, 1
    in_a_cycle = costs.update + costs.replay * (timings.least_M + 1)
    yield in_a_cycle + (costs.propagate + beside) * timings.most_N, timings.most_N
    steps = max(timings.most_L - timings.least_M, 0)
    yield costs.update + costs.replay * timings.most_L + beside * steps, steps


def _dual_rate(costs: DualRateCosts[int], timings: Range, options: Options) -> Iterator[tuple[int, int]]:
    """Its total, update and propagate windows, as long as they may be. One HR job in a cycle is another."""
    always = timings.least_N >= 2
    high = costs.hr if always else min(costs.hr, costs.hr_restart)
    saved = min(costs.hr_restart - costs.hr, 0) if always else 0
    lowest = min(costs.hr, costs.hr_restart)
    same_step = options.feedback == "same-step"
    yield (max(costs.hr, costs.hr_restart) if always else costs.hr_restart), 1
    early = costs.lr_propagate + costs.lr_gain
    landing_job = costs.hr if always and timings.least_M > same_step else lowest  # it is not that of step k + 1
    if same_step:  # within the step in which the LR update finishes, or on into the next
        yield 2 * landing_job + costs.hr_update, 2
    elif always and timings.least_M == 0:  # in step k + 1, where all is done within step k, or later
        at_once = max(costs.hr_restart + costs.hr_update, costs.hr + early + costs.lr_update)
        yield min(at_once, costs.hr + costs.hr_update), 1
    else:
        yield landing_job + costs.hr_update, 1
    end = timings.most_L + same_step
    more = costs.hr_update if same_step else 0

    def window(work: int, steps: int, first: int) -> tuple[int, int]:
        if options.cpus == 2:
            return first + work, max(steps, 0)
        return _in_window(high, lowest, work + saved, steps, options)

    yield window(early + costs.lr_update + more, end, high)
    yield window(costs.lr_update + more, end - timings.least_M, 0)
    if options.lr_propagate_by == "m" and timings.least_M >= 1:
        yield window(early, timings.most_M, high)


def _in_window(each: int, lowest: int, once: int, steps: int, options: Options) -> tuple[int, int]:
    """`once`, and `each` in each of at most so many steps; where `once` is less than nothing, the lowest of HR jobs."""
    if steps <= 0:
        return 1, 0
    if options.cpus == 2:
        return each + once, steps
    return (each * steps + once, steps) if once >= 0 else (lowest, 1)
