"""Least speed and achieved l in closed form, for one design or for whole arrays of N, M, L and speed at once.

Everything is exact: costs and HR periods are whole ticks, a least speed is a quotient of two whole numbers. Each
deadline is a demand over a window, the least speed the largest of them (Steffes 2014, Sec. III.C). Nothing is
simulated here: `sched_sim.design.simulate` is the oracle of this module, and this module of that.

Any integers will do: arrays are computed as int64 where nothing can overflow, else as Python's integers. One design, in
plain integers, needs no numpy.
"""

from __future__ import annotations

from enum import IntEnum
from operator import index

from sched_sim.design.demand import DualRateDemand, Quotient, choose, largest, quotient, smaller
from sched_sim.design.horizon_demand import HorizonDemand
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
    SerialCosts,
    StandardCosts,
    TwoRateCosts,
    beside_others,
    converted,
    product,
    works,
)
from sched_sim.design.whole import Flags, Ints, Whole, larger, lesser, where


class Binding(IntEnum):
    """Which demand fixes the least speed.

    hr: one HR job; lr_propagate: LR propagate by its deadline, of a delayed horizon all LR work of a cycle; lr_update:
    the LR update between m and l; lr_total: all LR work between k and l; lr_gain: covariance and gain of a multirate
    method by l; lr_step: the robust step by l.
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
"""Instead of an achieved L where an HR job overruns its step, or nothing lands before the next measurement; of
a delayed horizon also where its LR jobs pile up."""

STEPS_ALONE = 32
"""So many steps are looked at one by one, without numpy, before all the others at once."""


def least_period(costs: JobCosts[int], N: Whole, M: Whole, L: Whole, options: Options) -> Quotient[Whole]:
    """The least HR period, in ticks, at which every deadline holds; its code is a `Binding`.

    costs in ticks; N, M, L: integers, or integer arrays of one shape, legal for the method, and of the dual-rate filter
    with one correction on its way at a time. `context_switch` and `policy` of the options are not looked at: see
    `sched_sim.design.search`.
    Raises TypeError for what is no whole number.
    """
    costs = _counted(costs)
    if isinstance(N, int):
        return _least_period(costs, N, index(M), index(L), options)
    flat = _least_period(costs, *_arrays(costs, N, M, L), options)
    return Quotient(*(part.reshape(N.shape) for part in flat))


def _least_period(costs: JobCosts[int], N: Whole, M: Whole, L: Whole, options: Options) -> Quotient[Whole]:
    if isinstance(costs, MultirateCosts | RobustCosts):
        least = _next_step(_two_rate_demand(costs, N, options), L, by_m=False)
        low = Binding.lr_gain if isinstance(costs, MultirateCosts) else Binding.lr_step
        return least._replace(code=where(least.code == Binding.hr, least.code, low))
    if isinstance(costs, DualRateCosts):
        demand = DualRateDemand(costs, N, M, separate=options.cpus == 2)
        by_m = options.lr_propagate_by == "m"
        return (_next_step if options.feedback == "next-step" else _same_step)(demand, L, by_m)
    if isinstance(costs, DelayedHorizonCosts):
        horizon = HorizonDemand(costs, N, M, separate=options.cpus == 2)
        return horizon.least_period(L, Binding.hr, Binding.lr_update, Binding.lr_propagate)
    return quotient(_longest_serial_job(costs, N, M), 1, Binding.hr)


def achieved_l(costs: JobCosts[int], N: Whole, M: Whole, period: Whole, options: Options) -> Whole:
    """The L at which corrections land (or gains are in use) at an HR period of `period` ticks, or NOT_LANDED.

    As `least_period`; `period` is an integer too, or an array of the same shape.
    """
    costs = _counted(costs)
    if isinstance(N, int):
        return _achieved_l(costs, N, index(M), index(period), options)
    return _achieved_l(costs, *_arrays(costs, N, M, period), options).reshape(N.shape)


def _achieved_l(costs: JobCosts[int], N: Whole, M: Whole, period: Whole, options: Options) -> Whole:
    if isinstance(costs, MultirateCosts | RobustCosts):
        demand = _two_rate_demand(costs, N, options)
        return where(period >= demand.longest_hr_job(), _landing_next_step(demand, period), NOT_LANDED)
    if isinstance(costs, DelayedHorizonCosts):
        return HorizonDemand(costs, N, M, separate=options.cpus == 2).landed(period, NOT_LANDED)
    if not isinstance(costs, DualRateCosts):
        landed = 0 * M if isinstance(costs, StandardCosts) else M
        return where(period >= _longest_serial_job(costs, N, M), landed, NOT_LANDED)
    demand = DualRateDemand(costs, N, M, separate=options.cpus == 2)
    landing = _landing_next_step if options.feedback == "next-step" else _landing_same_step
    return where(period >= demand.longest_hr_job(), landing(demand, period), NOT_LANDED)


def _counted(costs: JobCosts[int]) -> JobCosts[int]:
    """With Python's integers, whatever whole numbers they were."""
    return converted(costs, index)


def _arrays(costs: JobCosts[int], N: Ints, M: Ints, other: Ints) -> tuple[Ints, Ints, Ints]:
    """Flat, and of a type in which nothing overflows: the analysis multiplies the work of a cycle, or a period, by at
    most two numbers of steps."""
    import numpy as np

    arrays = [_whole_numbers(array).ravel() for array in (N, M, other)]
    steps = max(int(array.max(initial=0)) for array in arrays[:2]) + 3
    largest = max(int(array.max(initial=0)) for array in arrays)
    fits = 8 * steps * max(steps * sum(works(costs)), largest) <= np.iinfo(np.int64).max
    N, M, other = (array.astype(np.int64 if fits else object) for array in arrays)
    return N, M, other


def _whole_numbers(values: Ints) -> Ints:
    """An array of some integer type, or of Python's integers. Raises TypeError for what is no whole number."""
    import numpy as np

    array = np.asarray(values)
    if array.dtype.kind not in "iu":
        array = np.asarray(np.frompyfunc(index, 1, 1)(array), dtype=object)
    return array


def _longest_serial_job(costs: SerialCosts[int], N: Whole, M: Whole) -> Whole:
    match costs:
        case StandardCosts(propagate, update):
            return propagate + update + 0 * N
        case RecalculateCosts(propagate, update, replay):
            return propagate + update + replay * M
        case LarsenCosts(propagate, accumulate, update):
            alone = where(M >= 2, 0 * N + max(accumulate + update, propagate), 0 * N + propagate + update)
            if isinstance(costs, LarsenInFlightCosts):
                return where(M <= N, alone, _longest_of_several(costs, N, M))
            return alone
        case CloneCosts(propagate, at_k, carry, landing) | CarriedGainCosts(propagate, at_k, carry, landing):
            couple, compensate = beside_others(costs)
            others = larger(M - 1, 0) // N
            beside_k, beside_m = others * couple, others * compensate
            return propagate + others * carry + _longest_carried(at_k + beside_k, carry, landing + beside_m, N, M)
        case Px4PredictorCosts(predict, propagate, update, pull, shift):
            return predict + propagate + update + pull + shift * (M + 1)
        case AugmentationCosts(predict, predict_more, update, update_more, bend):
            return predict + update + (predict_more + update_more) * M + bend * (M * (M - 1) // 2)
        case FuseAsFreshCosts(propagate, update):
            return propagate + update + 0 * N


def _longest_carried(at_k: Whole | int, carry: int, at_m: Whole | int, N: Whole, M: Whole) -> Whole:
    """The most that a step has beyond what all have: the work at k, with that at m where these are one step, or that at
    m, or, where a step lies between them, one measurement more to carry."""
    zero = 0 * N
    together = zero + at_k + where(M % N == 0, zero + at_m, 0)
    between = where(larger(M - 1, 0) % N > 0, zero + carry, 0)
    return larger(larger(together, zero + at_m), between)


def _longest_of_several(costs: LarsenInFlightCosts[int], N: Whole, M: Whole) -> Whole:
    """Of Larsen's method where others are measured before one arrives, M > N: the HR job of step m, where as many
    products are accumulated as in any, or that of step k, which is the same where N divides M."""
    others = (M - 1) // N
    at_m = M % N
    correction = costs.correct + others * costs.compensate + where(at_m == 0, 0 * N + costs.gain, 0)
    products_at_m, products_at_k = M // N - (1 - at_m) // N, M // N - 1 // N
    at_k = products_at_k * product(costs) + costs.gain
    longest: Whole = costs.propagate + larger(products_at_m * product(costs) + correction, at_k)
    return longest


def _two_rate_demand(costs: TwoRateCosts[int], N: Whole, options: Options) -> DualRateDemand[Whole]:
    """That of a dual-rate filter whose measurement comes at once, whose HR jobs are all alike and whose LR update is
    the LR job."""
    high, low = works(costs)
    alike = DualRateCosts(hr=high, hr_restart=high, hr_update=0, lr_propagate=0, lr_gain=0, lr_update=low)
    return DualRateDemand(alike, N, 0 * N, separate=options.cpus == 2)


def _next_step(demand: DualRateDemand[Whole], L: Whole, by_m: bool) -> Quotient[Whole]:
    """The HR job of step l also runs the HR update. Which step that is depends on the speed, and there are three
    cases: l = k+N, where it delays the LR jobs of the next cycle; l = k+1, whose HR job is another; all others.
    A slower processor lands later, so the first case that is consistent with itself is the least speed.
    """
    N, M, hr_update = demand.N, demand.M, demand.costs.hr_update
    idle = quotient(0 * N, 1, Binding.hr)
    longest = demand.longest_hr_job()

    def least(end: Whole, landing_job: Whole, delay: Whole | int) -> Quotient[Whole]:
        hr = quotient(larger(longest, landing_job + hr_update), 1, Binding.hr)
        propagate = demand.propagate_window(Binding.lr_propagate, delay) if by_m else idle
        update = demand.update_window(end, Binding.lr_update, where(M == 0, 0 * N + delay, 0))
        return largest(hr, propagate, update, demand.total_window(end, Binding.lr_total, delay))

    at_next_k = least(N, demand.hr_job(0), hr_update)
    lands_there = (M >= N - 1) | (demand.first_end(at_next_k.numerator, at_next_k.denominator) >= N)

    ordinary_end = larger(lesser(L, N - 1), M + 1)
    ordinary = least(ordinary_end, demand.hr_job(2), 0)
    lands_at_once = (M == 0) & ((L == 1) | (demand.first_end(ordinary.numerator, ordinary.denominator) == 1))

    at_restart = least(M + 1, demand.hr_job(1), 0)
    before_next_k = choose(lands_at_once, at_restart, ordinary)
    return choose((L == N) & lands_there, at_next_k, before_next_k)


def _landing_next_step(demand: DualRateDemand[Whole], period: Whole) -> Whole:
    N, M, hr_update = demand.N, demand.M, demand.costs.hr_update
    end = demand.first_end(period)
    before_next_k = (end < N) & (period >= demand.hr_job(end) + hr_update)
    update = demand.update_window(N, Binding.lr_update, where(M == 0, 0 * N + hr_update, 0))
    total = demand.total_window(N, Binding.lr_total, hr_update)
    fits = (period >= demand.hr_job(0) + hr_update) & _meets(period, update) & _meets(period, total)
    return where(before_next_k | ((end == N) & fits), end, NOT_LANDED)


def _meets(period: Whole, demand: Quotient[Whole]) -> bool | Flags:
    return demand.denominator * period >= demand.numerator


def _feedback_in(demand: DualRateDemand[Whole], step: Whole) -> Quotient[Whole]:
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


def _feedback_after(demand: DualRateDemand[Whole], step: Whole) -> Quotient[Whole]:
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


def _same_step(demand: DualRateDemand[Whole], L: Whole, by_m: bool) -> Quotient[Whole]:
    """The HR update runs as soon as the LR update finishes, in step j or, if it does not fit, into step j+1, where
    it delays the HR job. Walks j down from L: a slower processor finishes later, so the first j that is consistent
    with itself gives the least speed.
    """
    loop = quotient(demand.longest_hr_job(), 1, Binding.hr)
    if by_m:
        loop = largest(loop, demand.propagate_window(Binding.lr_propagate))
    step = larger(lesser(demand.first_end(loop.numerator, loop.denominator) - 1, L), demand.M)
    if isinstance(step, int):
        for near in range(step, max(step - STEPS_ALONE, demand.M - 1), -1):
            least = _finished_in(demand, near, L, loop)
            if _consistent(demand, near, least):
                return least
        return _first_consistent(demand, step - STEPS_ALONE, L, loop)
    import numpy as np

    result = Quotient(*(part.copy() for part in loop))
    open_points = np.arange(step.size)
    while open_points.size:
        at = step[open_points]
        here = DualRateDemand(demand.costs, demand.N[open_points], demand.M[open_points], demand.separate)
        least = _finished_in(here, at, L[open_points], Quotient(*(part[open_points] for part in loop)))
        consistent = _consistent(here, at, least)
        settled = open_points[consistent]
        for whole, part in zip(result, least, strict=True):
            whole[settled] = part[consistent]
        open_points = open_points[~consistent]
        step[open_points] -= 1
    return result


def _first_consistent(demand: DualRateDemand[int], step: int, L: int, loop: Quotient[int]) -> Quotient[int]:
    """`_same_step` of one design, the steps from `step` down to M at once."""
    import numpy as np

    at = np.arange(step, demand.M - 1, -1)
    same = np.ones_like(at)
    N, M, at = _arrays(demand.costs, demand.N * same, demand.M * same, at)
    every = DualRateDemand(demand.costs, N, M, demand.separate)
    least = _finished_in(every, at, L + 0 * at, Quotient(*(part + 0 * at for part in loop)))
    first = int(np.argmax(_consistent(every, at, least)))
    return Quotient(*(part[first].item() if hasattr(part[first], "item") else part[first] for part in least))


def _finished_in(demand: DualRateDemand[Whole], step: Whole, L: Whole, loop: Quotient[Whole]) -> Quotient[Whole]:
    """The least period where the LR update finishes in `step`; loop: what is needed besides."""
    inside = _feedback_in(demand, step)
    feedback = choose(step < L, smaller(inside, _feedback_after(demand, step)), inside)
    update, total = demand.update_window(step + 1, Binding.lr_update), demand.total_window(step + 1, Binding.lr_total)
    return largest(loop, update, total, feedback)


def _consistent(demand: DualRateDemand[Whole], step: Whole, least: Quotient[Whole]) -> bool | Flags:
    """Whether at this period the LR update finishes in `step`."""
    end = demand.first_end(least.numerator, least.denominator)
    consistent: bool | Flags = (step == demand.M) | (end == step + 1)
    return consistent


def _landing_same_step(demand: DualRateDemand[Whole], period: Whole) -> Whole:
    N = demand.N
    step = lesser(demand.first_end(period) - 1, N)
    inside = (step < N) & _meets(period, _feedback_in(demand, step))
    after = (step + 1 < N) & _meets(period, _feedback_after(demand, step))
    return where(inside, step, where(after, step + 1, NOT_LANDED))
