"""Every method by its name."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import TypeAlias, cast, get_args

from sched_sim.bounds import check_kind
from sched_sim.costs.methods import MULTIRATE_METHODS, ROBUST_METHODS
from sched_sim.costs.table import CostTable
from sched_sim.design import carried, delayed_horizon, dual_rate, late_serial, serial, two_rate
from sched_sim.design.method import CostOf, Exact, InTicks, Method
from sched_sim.design.options import Options
from sched_sim.design.pieces import (
    AugmentationCosts,
    CarriedGainCosts,
    CarriedGainInFlightCosts,
    CloneCosts,
    CloneInFlightCosts,
    CloneSplitCosts,
    Costs,
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
    Statistic,
)
from sched_sim.errors import InputError

AnyMethod: TypeAlias = Method[Costs, JobCosts[int]]


def _any(method: Method[Exact, InTicks]) -> AnyMethod:
    """To stand beside others; it is given no pieces but its own."""
    return cast("AnyMethod", method)


_BY_PIECES: Mapping[type, AnyMethod] = {
    StandardCosts: _any(serial.STANDARD),
    RecalculateCosts: _any(serial.RECALCULATE),
    LarsenCosts: _any(serial.LARSEN),
    LarsenInFlightCosts: _any(serial.LARSEN),
    DualRateCosts: _any(dual_rate.DUAL_RATE),
    CloneCosts: _any(carried.CLONE),
    CloneInFlightCosts: _any(carried.CLONE),
    CloneSplitCosts: _any(carried.CLONE_SPLIT),
    CarriedGainCosts: _any(carried.CARRIED_GAIN),
    CarriedGainInFlightCosts: _any(carried.CARRIED_GAIN),
    DelayedHorizonCosts: _any(delayed_horizon.DELAYED_HORIZON),
    Px4PredictorCosts: _any(late_serial.PX4_PREDICTOR),
    AugmentationCosts: _any(late_serial.AUGMENTATION),
    FuseAsFreshCosts: _any(late_serial.FUSE_AS_FRESH),
    MultirateCosts: _any(two_rate.MULTIRATE),
    RobustCosts: _any(two_rate.ROBUST),
}

METHODS: Mapping[str, AnyMethod] = {
    "standard": _BY_PIECES[StandardCosts],
    "recalculate": _BY_PIECES[RecalculateCosts],
    "larsen": _BY_PIECES[LarsenCosts],
    "dual-rate": _BY_PIECES[DualRateCosts],
    "clone": _BY_PIECES[CloneCosts],
    "clone-split": _BY_PIECES[CloneSplitCosts],
    "carried-gain": _BY_PIECES[CarriedGainCosts],
    "delayed-horizon": _BY_PIECES[DelayedHorizonCosts],
    "px4-predictor": _BY_PIECES[Px4PredictorCosts],
    "augmentation": _BY_PIECES[AugmentationCosts],
    "fuse-as-fresh": _BY_PIECES[FuseAsFreshCosts],
    **dict.fromkeys(MULTIRATE_METHODS, _BY_PIECES[MultirateCosts]),
    **dict.fromkeys(ROBUST_METHODS, _BY_PIECES[RobustCosts]),
}


def method_of(costs: JobCosts[Fraction] | JobCosts[int]) -> AnyMethod:
    """The method that has such pieces. Raises InputError for anything else."""
    try:
        return _BY_PIECES[type(costs)]
    except KeyError:
        raise InputError(
            f"costs is a {type(costs).__name__}: give those of one method, as `select(table, method)` returns them"
        ) from None


def select(table: CostTable, method: str, options: Options = Options(), statistic: Statistic = "minimum") -> Costs:
    """The costs that `method` runs with under `options`, as fractions of the table's unit.

    Raises InputError for an unknown method and for an entry that the table lacks.
    """

    check_kind(table, CostTable, "table", "a cost table, as `load_costs` returns it")
    check_kind(options, Options, "options", "Options(...), or leave it out")
    if statistic not in get_args(Statistic):
        raise InputError(f"statistic is {statistic!r}: choose from {', '.join(get_args(Statistic))}")

    if not isinstance(method, str) or method not in METHODS:
        raise InputError(f"method {method!r} is unknown: choose from {', '.join(METHODS)}")
    return METHODS[method].pieces(CostOf(table, method, statistic), options)
