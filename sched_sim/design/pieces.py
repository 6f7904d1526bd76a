"""What the pieces of each method cost."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any, Literal

from sched_sim.costs.methods import METHODS, MULTIRATE_METHODS, ROBUST_METHODS
from sched_sim.costs.table import CostTable
from sched_sim.design.options import Options
from sched_sim.errors import InputError

Statistic = Literal["minimum", "median", "p95"]


@dataclass(frozen=True, slots=True)
class StandardCosts:
    """Work of the standard filter's pieces, which is not delayed: the update is due at k itself."""

    propagate: Any
    update: Any


@dataclass(frozen=True, slots=True)
class RecalculateCosts:
    """Work of the pieces of recalculate; update: the fixed part at m, replay: each re-propagated step."""

    propagate: Any
    update: Any
    replay: Any


@dataclass(frozen=True, slots=True)
class LarsenCosts:
    """Work of the pieces of Larsen's method; accumulate: a propagated step with the product Phi(k->j) in it."""

    propagate: Any
    accumulate: Any
    update: Any


@dataclass(frozen=True, slots=True)
class DualRateCosts:
    """Work of the dual-rate filter's pieces.

    hr: the HR job of an ordinary step; hr_restart: that of step k+1; hr_update: Eqs (13), (19);
    lr_propagate: Eq. (14); lr_gain: the part of the update done before the measurement arrives, 0 if none;
    lr_update: what is left to do after it arrived.
    """

    hr: Any
    hr_restart: Any
    hr_update: Any
    lr_propagate: Any
    lr_gain: Any
    lr_update: Any


@dataclass(frozen=True, slots=True)
class MultirateCosts:
    """Work of the pieces of the multirate gain; state_update: the HR job of each step, with a measurement in it;
    covariance_gain: the LR job, once in N steps."""

    state_update: Any
    covariance_gain: Any


@dataclass(frozen=True, slots=True)
class RobustCosts:
    """Work of the pieces of the robust filter at two rates; inertial: the HR job of each step; robust_step: the LR job,
    once in N steps, from step k, at which there is a measurement."""

    inertial: Any
    robust_step: Any


TwoRateCosts = MultirateCosts | RobustCosts
JobCosts = StandardCosts | RecalculateCosts | LarsenCosts | DualRateCosts | TwoRateCosts
"""What one method's pieces cost: fractions of the table's unit, or whole ticks; one number type throughout."""


def select(table: CostTable, method: str, options: Options, statistic: Statistic = "minimum") -> JobCosts:
    """The costs that `method` runs with under `options`, as fractions of the table's unit.

    Raises InputError for an unknown method and for an entry that the table lacks.
    """

    def cost(kind: str) -> Fraction:
        value: Fraction = getattr(table.entry(method, kind), statistic)
        return value

    if method == "standard":
        return StandardCosts(cost("propagate"), cost("update"))
    if method == "recalculate":
        return RecalculateCosts(cost("propagate"), cost("update"), cost("replay"))
    if method == "larsen":
        return LarsenCosts(cost("propagate"), cost("propagate_accumulate"), cost("update"))
    if method == "dual-rate":
        noise = "" if options.low_rate_noise == "exact" else f"_{options.low_rate_noise}"
        early = options.gain == "precomputed"
        return DualRateCosts(
            hr=cost(f"hr_propagate{noise}"),
            hr_restart=cost("hr_restart"),
            hr_update=cost("hr_update"),
            lr_propagate=cost("lr_propagate_euler" if noise == "_euler" else "lr_propagate"),
            lr_gain=cost("lr_gain") if early else Fraction(0),
            lr_update=cost("lr_correct" if early else "lr_update"),
        )
    if method in MULTIRATE_METHODS:
        return MultirateCosts(cost("state_update"), cost("covariance_gain"))
    if method in ROBUST_METHODS:
        return RobustCosts(cost("inertial"), cost("robust_step"))
    raise InputError(f"method {method!r} is unknown: choose from {', '.join(METHODS)}")
