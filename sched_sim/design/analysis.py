"""Least speed and achieved l in closed form, for whole arrays of N, M, L and speed at once.

Everything is exact: costs and HR periods are whole ticks, a least speed is a quotient of two whole numbers. Each
deadline is a demand over a window, the least speed the largest of them (Steffes 2014, Sec. III.C). Nothing is
simulated here: `sched_sim.design.simulate` is the oracle of this module, and this module of that.

Any integers will do: the arrays are computed as int64 where nothing can overflow, else as Python's integers.
"""

from __future__ import annotations

from enum import IntEnum
from operator import index

import numpy as np

from sched_sim.design.demand import (
    DualRateDemand,
    Flags,
    Ints,
    Quotient,
    choose,
    largest,
    quotient,
    smaller,
    whole_numbers,
)
from sched_sim.design.options import Options
from sched_sim.design.pieces import (
    DualRateCosts,
    JobCosts,
    LarsenCosts,
    MultirateCosts,
    RecalculateCosts,
    RobustCosts,
    SerialCosts,
    StandardCosts,
    TwoRateCosts,
    converted,
    works,
)


class Binding(IntEnum):
    """Which demand fixes the least speed.

    hr: one HR job; lr_propagate: LR propagate by its deadline; lr_update: the LR update between m and l;
    lr_total: all LR work between k and l; lr_gain: covariance and gain of a multirate method by l;
    lr_step: the robust step by l.
    """

    hr = 0
    lr_propagate = 1
    lr_update = 2
    lr_total = 3
    lr_gain = 4
    lr_step = 5


BINDING_WORDS = {
    "hr": "one HR job",
    "lr_propagate": "LR propagate",
    "lr_update": "LR update, m to l",
    "lr_total": "all LR work, k to l",
    "lr_gain": "covariance and gain",
    "lr_step": "robust step",
}
"""The bindings as a person reads them."""

NOT_LANDED = -1
"""Instead of an achieved L where an HR job overruns its step, or nothing lands before the next measurement."""


def least_period(costs: JobCosts[int], N: Ints, M: Ints, L: Ints, options: Options) -> Quotient:
    """The least HR period, in ticks, at which every deadline holds; its code is a `Binding`.

    costs in ticks; N, M, L: integer arrays of one shape, legal for the method. `context_switch` and `policy` of the
    options are not looked at: see `sched_sim.design.search`.
    Raises TypeError for what is no whole number.
    """
    costs = _counted(costs)
    shape = np.shape(N)
    N, M, L = _arrays(costs, N, M, L)
    return Quotient(*(part.reshape(shape) for part in _least_period(costs, N, M, L, options)))


def _least_period(costs: JobCosts[int], N: Ints, M: Ints, L: Ints, options: Options) -> Quotient:
    if isinstance(costs, MultirateCosts | RobustCosts):
        least = _next_step(_two_rate_demand(costs, N, options), L, by_m=False)
        low = Binding.lr_gain if isinstance(costs, MultirateCosts) else Binding.lr_step
        return least._replace(code=np.where(least.code == Binding.hr, Binding.hr, low))
    if isinstance(costs, DualRateCosts):
        demand = DualRateDemand(costs, N, M, separate=options.cpus == 2)
        by_m = options.lr_propagate_by == "m"
        return (_next_step if options.feedback == "next-step" else _same_step)(demand, L, by_m)
    return quotient(_longest_serial_job(costs, N, M), 1, Binding.hr)


def achieved_l(costs: JobCosts[int], N: Ints, M: Ints, period: Ints, options: Options) -> Ints:
    """The L at which corrections land (or gains are in use) at an HR period of `period` ticks, or NOT_LANDED.

    As `least_period`; `period` is an array of the same shape.
    """
    costs = _counted(costs)
    shape = np.shape(N)
    N, M, period = _arrays(costs, N, M, period)
    return _achieved_l(costs, N, M, period, options).reshape(shape)


def _achieved_l(costs: JobCosts[int], N: Ints, M: Ints, period: Ints, options: Options) -> Ints:
    if isinstance(costs, MultirateCosts | RobustCosts):
        demand = _two_rate_demand(costs, N, options)
        return np.where(period >= demand.longest_hr_job(), _landing_next_step(demand, period), NOT_LANDED)
    if not isinstance(costs, DualRateCosts):
        landed = 0 * M if isinstance(costs, StandardCosts) else M
        return np.where(period >= _longest_serial_job(costs, N, M), landed, NOT_LANDED)
    demand = DualRateDemand(costs, N, M, separate=options.cpus == 2)
    landing = _landing_next_step if options.feedback == "next-step" else _landing_same_step
    return np.where(period >= demand.longest_hr_job(), landing(demand, period), NOT_LANDED)


def _counted(costs: JobCosts[int]) -> JobCosts[int]:
    """With Python's integers, whatever whole numbers they were."""
    return converted(costs, index)


def _arrays(costs: JobCosts[int], N: Ints, *others: Ints) -> list[Ints]:
    """Flat, and of a type in which nothing overflows: the analysis multiplies the work of a cycle, or a period, by at
    most two numbers of steps."""
    arrays = [whole_numbers(array).ravel() for array in (N, *others)]
    steps = int(arrays[0].max(initial=0)) + 3
    largest = max(int(array.max(initial=0)) for array in arrays)
    fits = 8 * steps * max(steps * sum(works(costs)), largest) <= np.iinfo(np.int64).max
    return [array.astype(np.int64 if fits else object) for array in arrays]


def _longest_serial_job(costs: SerialCosts[int], N: Ints, M: Ints) -> Ints:
    match costs:
        case StandardCosts(propagate, update):
            return propagate + update + 0 * N
        case RecalculateCosts(propagate, update, replay):
            return propagate + update + replay * M
        case LarsenCosts(propagate, accumulate, update):
            return np.where(M >= 2, 0 * N + max(accumulate + update, propagate), 0 * N + propagate + update)


def _two_rate_demand(costs: TwoRateCosts[int], N: Ints, options: Options) -> DualRateDemand:
    """That of a dual-rate filter whose measurement comes at once, whose HR jobs are all alike and whose LR update is
    the LR job."""
    high, low = works(costs)
    alike = DualRateCosts(hr=high, hr_restart=high, hr_update=0, lr_propagate=0, lr_gain=0, lr_update=low)
    return DualRateDemand(alike, N, 0 * N, separate=options.cpus == 2)


def _next_step(demand: DualRateDemand, L: Ints, by_m: bool) -> Quotient:
    """The HR job of step l also runs the HR update. Which step that is depends on the speed, and there are three
    cases: l = k+N, where it delays the LR jobs of the next cycle; l = k+1, whose HR job is another; all others.
    A slower processor lands later, so the first case that is consistent with itself is the least speed.
    """
    N, M, hr_update = demand.N, demand.M, demand.costs.hr_update
    idle = quotient(0 * N, 1, Binding.hr)
    longest = demand.longest_hr_job()

    def least(end: Ints, landing_job: Ints, delay: Ints | int) -> Quotient:
        hr = quotient(np.maximum(longest, landing_job + hr_update), 1, Binding.hr)
        propagate = demand.propagate_window(Binding.lr_propagate, delay) if by_m else idle
        update = demand.update_window(end, Binding.lr_update, np.where(M == 0, 0 * N + delay, 0))
        return largest(hr, propagate, update, demand.total_window(end, Binding.lr_total, delay))

    at_next_k = least(N, demand.hr_job(0), hr_update)
    lands_earlier = (M < N - 1) & (demand.first_end(at_next_k.numerator, at_next_k.denominator) < N)

    ordinary_end = np.maximum(np.minimum(L, N - 1), M + 1)
    ordinary = least(ordinary_end, demand.hr_job(2), 0)
    lands_at_once = (M == 0) & ((L == 1) | (demand.first_end(ordinary.numerator, ordinary.denominator) == 1))

    at_restart = least(M + 1, demand.hr_job(1), 0)
    before_next_k = choose(lands_at_once, at_restart, ordinary)
    return choose((L == N) & ~lands_earlier, at_next_k, before_next_k)


def _landing_next_step(demand: DualRateDemand, period: Ints) -> Ints:
    N, M, hr_update = demand.N, demand.M, demand.costs.hr_update
    end = demand.first_end(period)
    before_next_k = (end < N) & (period >= demand.hr_job(end) + hr_update)
    update = demand.update_window(N, Binding.lr_update, np.where(M == 0, 0 * N + hr_update, 0))
    total = demand.total_window(N, Binding.lr_total, hr_update)
    fits = (period >= demand.hr_job(0) + hr_update) & ~_exceed(update, period) & ~_exceed(total, period)
    return np.where(before_next_k | ((end == N) & fits), end, NOT_LANDED)


def _exceed(demand: Quotient, period: Ints) -> Flags:
    return demand.numerator > demand.denominator * period


def _feedback_in(demand: DualRateDemand, step: Ints) -> Quotient:
    """HR update done within `step`, in which the LR update finishes."""
    hr_update = demand.costs.hr_update
    end = step + 1
    windows = [
        demand.update_window(end, Binding.lr_update, hr_update),
        demand.total_window(end, Binding.lr_total, hr_update),
    ]
    if demand.separate:
        windows.append(quotient(demand.hr_job(step) + hr_update, 1, Binding.hr))
    return largest(*windows)


def _feedback_after(demand: DualRateDemand, step: Ints) -> Quotient:
    """HR update begun in `step`, in which the LR update finishes, and done in the next, with the next HR job."""
    hr_update = demand.costs.hr_update
    following = demand.hr_job(step + 1)
    if not demand.separate:
        return largest(
            demand.update_window(step + 2, Binding.lr_update, hr_update),
            demand.total_window(step + 2, Binding.lr_total, hr_update),
        )
    return largest(
        demand.update_window(step + 2, Binding.lr_update, hr_update + following),
        demand.total_window(step + 2, Binding.lr_total, hr_update + following),
        quotient(demand.hr_job(step) + hr_update + following, 2, Binding.hr),
    )


def _same_step(demand: DualRateDemand, L: Ints, by_m: bool) -> Quotient:
    """The HR update runs as soon as the LR update finishes, in step j or, if it does not fit, into step j+1, where
    it delays the HR job. Walks j down from L: a slower processor finishes later, so the first j that is consistent
    with itself gives the least speed.
    """
    N, M = demand.N, demand.M
    loop = quotient(demand.longest_hr_job(), 1, Binding.hr)
    if by_m:
        loop = largest(loop, demand.propagate_window(Binding.lr_propagate))
    step = np.clip(demand.first_end(loop.numerator, loop.denominator) - 1, M, L)
    result = Quotient(*(part.copy() for part in loop))
    open_points = np.arange(N.size)
    while open_points.size:
        at = step[open_points]
        here = DualRateDemand(demand.costs, N[open_points], M[open_points], demand.separate)
        inside = _feedback_in(here, at)
        feedback = choose(at < L[open_points], smaller(inside, _feedback_after(here, at)), inside)
        finished = largest(here.update_window(at + 1, Binding.lr_update), here.total_window(at + 1, Binding.lr_total))
        least = largest(Quotient(*(part[open_points] for part in loop)), finished, feedback)
        consistent = (at == here.M) | (here.first_end(least.numerator, least.denominator) == at + 1)
        settled = open_points[consistent]
        for whole, part in zip(result, least, strict=True):
            whole[settled] = part[consistent]
        open_points = open_points[~consistent]
        step[open_points] -= 1
    return result


def _landing_same_step(demand: DualRateDemand, period: Ints) -> Ints:
    N = demand.N
    step = np.minimum(demand.first_end(period) - 1, N)
    inside = (step < N) & ~_exceed(_feedback_in(demand, step), period)
    after = (step + 1 < N) & ~_exceed(_feedback_after(demand, step), period)
    return np.where(inside, step, np.where(after, step + 1, NOT_LANDED))
