"""Least speed and achieved l in closed form, for one design or for whole arrays of N, M, L and speed at once.

Everything is exact: costs and HR periods are whole ticks, a least speed is a quotient of two whole numbers. Each
deadline is a demand over a window, the least speed the largest of them (Steffes 2014, Sec. III.C). Nothing is
simulated here: `sched_sim.design.simulate` is the oracle of this module, and this module of that.

Any integers will do: arrays are computed as int64 where nothing can overflow, else as Python's integers. One design, in
plain integers, needs no numpy; many of the dual-rate filter are computed compiled.
"""

from __future__ import annotations

from collections.abc import Callable
from math import prod
from operator import index

from sched_sim.compiled import compiled
from sched_sim.design import dual_rate_period
from sched_sim.design.binding import Binding
from sched_sim.design.demand import NOT_LANDED, Work, work_of
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
from sched_sim.design.quotient import Quotient, quotient
from sched_sim.design.whole import Ints, Whole, larger, where

COMPILED_FROM = 20_000
"""So many designs of the dual-rate filter, as in a portion of a large sweep, are computed compiled. To load that takes
a fraction of a second, to compile it, once on a machine, some."""


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
    flat_N, flat_M, flat_L = _arrays(costs, N, M, L)
    return Quotient(*(part.reshape(N.shape) for part in _least_period(costs, flat_N, flat_M, flat_L, options)))


def _least_period(costs: JobCosts[int], N: Whole, M: Whole, L: Whole, options: Options) -> Quotient[Whole]:
    if isinstance(costs, MultirateCosts | RobustCosts):
        least = _least_of_cycle(_two_rate_work(costs, options), N, 0 * N, L)
        low = Binding.lr_gain if isinstance(costs, MultirateCosts) else Binding.lr_step
        return least._replace(code=where(least.code == Binding.hr, least.code, low))
    if isinstance(costs, DualRateCosts):
        return _least_of_cycle(work_of(costs, options), N, M, L)
    if isinstance(costs, DelayedHorizonCosts):
        horizon = HorizonDemand(costs, N, M, separate=options.cpus == 2)
        return horizon.least_period(L, Binding.hr, Binding.lr_update, Binding.lr_propagate)
    return quotient(_longest_serial_job(costs, N, M), 1, Binding.hr)


def _least_of_cycle(work: Work, N: Whole, M: Whole, L: Whole) -> Quotient[Whole]:
    if isinstance(N, int):
        return Quotient(*dual_rate_period.least_period(work, N, M, L))
    return Quotient(*_of_each(dual_rate_period.least_periods, work, (N, M, L), results=3))


def achieved_l(
    costs: JobCosts[int], N: Whole, M: Whole, period: Whole, options: Options, scale: Whole | int = 1
) -> Whole:
    """The L at which corrections land (or gains are in use) at an HR period of `period / scale` ticks, or NOT_LANDED.

    As `least_period`; `period` and `scale`, which is positive, are integers too, or arrays of the same shape.
    """
    costs = _counted(costs)
    if isinstance(N, int):
        return _achieved_l(costs, N, index(M), index(period), index(scale), options)
    flat_N, flat_M, periods, scales = _arrays(costs, N, M, period, scale)
    return _achieved_l(costs, flat_N, flat_M, periods, scales, options).reshape(N.shape)


def _achieved_l(costs: JobCosts[int], N: Whole, M: Whole, period: Whole, scale: Whole, options: Options) -> Whole:
    if isinstance(costs, MultirateCosts | RobustCosts):
        return _landing_of_cycle(_two_rate_work(costs, options), N, 0 * N, period, scale)
    if isinstance(costs, DualRateCosts):
        return _landing_of_cycle(work_of(costs, options), N, M, period, scale)
    if isinstance(costs, DelayedHorizonCosts):
        return HorizonDemand(costs, N, M, separate=options.cpus == 2).landed(period, scale, NOT_LANDED)
    landed = 0 * M if isinstance(costs, StandardCosts) else M
    return where(period >= _longest_serial_job(costs, N, M) * scale, landed, NOT_LANDED)


def _landing_of_cycle(work: Work, N: Whole, M: Whole, period: Whole, scale: Whole) -> Whole:
    if isinstance(N, int):
        return dual_rate_period.landing(work, N, M, period, scale)
    (landed,) = _of_each(dual_rate_period.landings, work, (N, M, period, scale), results=1)
    return landed


def _of_each(
    loop: Callable[[Work, dual_rate_period.Columns, dual_rate_period.Found], None],
    work: Work,
    designs: tuple[Ints, ...],
    results: int,
) -> list[Ints]:
    """What the loop finds of each design: `results` arrays."""
    import numpy as np

    size, kind = designs[0].size, designs[0].dtype
    if kind.kind == "i" and size >= COMPILED_FROM:
        table = np.empty((results, size), kind)
        compiled(loop)(work, designs, table)
        return [*table]
    columns = [[0] * size for _ in range(results)]
    loop(work, tuple(part.tolist() for part in designs), columns)
    return [np.array(column, kind) for column in columns]


def _counted(costs: JobCosts[int]) -> JobCosts[int]:
    """With Python's integers, whatever whole numbers they were."""
    return costs if all(type(work) is int for work in works(costs)) else converted(costs, index)


def _arrays(costs: JobCosts[int], N: Ints, *others: Ints | int) -> list[Ints]:
    """Flat, of the shape of N, and of a type in which nothing overflows: the analysis multiplies the work of a cycle,
    or a period, by at most two numbers of steps and a scale. others: M; L or a period; a scale."""
    import numpy as np

    flat = [_whole_numbers(np.full(N.shape, part) if isinstance(part, int) else part).ravel() for part in (N, *others)]
    largest = [int(array.max(initial=0)) for array in flat]
    steps, scale = max(largest[:2]) + 3, prod(largest[3:])
    fits = 8 * steps * max(steps * scale * sum(works(costs)), *largest) <= np.iinfo(np.int64).max
    return [array.astype(np.int64 if fits else object, copy=False) for array in flat]


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


def _two_rate_work(costs: TwoRateCosts[int], options: Options) -> Work:
    """That of a dual-rate filter whose measurement comes at once, whose HR jobs are all alike and whose LR update is
    the LR job."""
    high, low = works(costs)
    return Work(high, high, 0, 0, low, options.cpus == 2)
