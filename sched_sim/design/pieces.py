"""What the pieces of each method cost: one record for each family of methods, of one type of number throughout."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Generic, Literal, TypeAlias, TypeVar, cast

Statistic = Literal["minimum", "median", "p95"]

Number = TypeVar("Number", bound=int | Fraction)
"""Whole ticks, or fractions of a cost table's unit."""

Other = TypeVar("Other", bound=int | Fraction)

Exact = TypeVar("Exact", int, Fraction)


@dataclass(frozen=True, slots=True)
class StandardCosts(Generic[Number]):
    """Work of the standard filter's pieces, which is not delayed: the update is due at k itself."""

    propagate: Number
    update: Number


@dataclass(frozen=True, slots=True)
class RecalculateCosts(Generic[Number]):
    """Work of the pieces of recalculate; update: the fixed part at m; replay: each re-propagated step."""

    propagate: Number
    update: Number
    replay: Number


@dataclass(frozen=True, slots=True)
class LarsenCosts(Generic[Number]):
    """Work of the pieces of Larsen's method; accumulate: a propagated step with the product Phi(k->j) in it.

    lacks: what the cost table has not that takes several in flight, M > N, in words."""

    propagate: Number
    accumulate: Number
    update: Number
    lacks: str = field(default="", kw_only=True, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class LarsenInFlightCosts(LarsenCosts[Number]):
    """Those of Larsen's method where it can also have several measurements in flight, M > N, and in place of update:
    gain, with the covariance, at k; correct, the state, at m; compensate, for each that is in flight then, at m too."""

    gain: Number
    correct: Number
    compensate: Number


@dataclass(frozen=True, slots=True)
class CloneCosts(Generic[Number]):
    """Work of the pieces of stochastic cloning; start: at k; carry: in each of the steps k+1 .. m-1; update: at m;
    lacks: as in `LarsenCosts`."""

    propagate: Number
    start: Number
    carry: Number
    update: Number
    lacks: str = field(default="", kw_only=True, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class CloneInFlightCosts(CloneCosts[Number]):
    """Those of stochastic cloning where it can also have several measurements in flight, M > N; couple, compensate: for
    each other that is on its way at k, at k and when that one lands."""

    couple: Number
    compensate: Number


@dataclass(frozen=True, slots=True)
class CloneSplitCosts(CloneCosts[Number]):
    """Those of stochastic cloning where S is formed at m: one measurement is on its way at a time."""


@dataclass(frozen=True, slots=True)
class CarriedGainCosts(Generic[Number]):
    """Work of the pieces of the carried gain; update: gain and covariance, at k; carry: in each of the steps
    k+1 .. m-1; land: at m; lacks: as in `LarsenCosts`."""

    propagate: Number
    update: Number
    carry: Number
    land: Number
    lacks: str = field(default="", kw_only=True, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class CarriedGainInFlightCosts(CarriedGainCosts[Number]):
    """Those of the carried gain where it can also have several measurements in flight, M > N; couple, compensate: as in
    `CloneInFlightCosts`."""

    couple: Number
    compensate: Number


@dataclass(frozen=True, slots=True)
class DualRateCosts(Generic[Number]):
    """Work of the dual-rate filter's pieces.

    hr: the HR job of an ordinary step; hr_restart: that of step k+1; hr_update: Eqs (13), (19);
    lr_propagate: Eq. (14); lr_gain: the part of the update done before the measurement arrives, 0 if none;
    lr_update: what is left to do after it arrived.
    """

    hr: Number
    hr_restart: Number
    hr_update: Number
    lr_propagate: Number
    lr_gain: Number
    lr_update: Number


@dataclass(frozen=True, slots=True)
class MultirateCosts(Generic[Number]):
    """Work of the pieces of the multirate gain; state_update: the HR job of each step, with a measurement in it;
    covariance_gain: the LR job, once in N steps."""

    state_update: Number
    covariance_gain: Number


@dataclass(frozen=True, slots=True)
class RobustCosts(Generic[Number]):
    """Work of the pieces of the robust filter at two rates; inertial: the HR job of each step; robust_step: the LR job,
    once in N steps, from step k, at which there is a measurement."""

    inertial: Number
    robust_step: Number


@dataclass(frozen=True, slots=True)
class DelayedHorizonCosts(Generic[Number]):
    """Work of the pieces of the delayed horizon; predict: the HR job of each step; update: at the horizon; replay: each
    step from there to the present; propagate: the covariance over one step."""

    predict: Number
    update: Number
    replay: Number
    propagate: Number


@dataclass(frozen=True, slots=True)
class Px4PredictorCosts(Generic[Number]):
    """Work of the pieces of PX4's output predictor; predict: the output; propagate, update: the filter behind it; pull:
    how far the outputs are to be shifted; shift: one of them."""

    predict: Number
    propagate: Number
    update: Number
    pull: Number
    shift: Number


@dataclass(frozen=True, slots=True)
class AugmentationCosts(Generic[Number]):
    """Work of the pieces of augmentation: predict + predict_more D in each step, and for the update
    update + update_more D + update_bend D (D - 1) / 2, where D = M states are delayed."""

    predict: Number
    predict_more: Number
    update: Number
    update_more: Number
    update_bend: Number


@dataclass(frozen=True, slots=True)
class FuseAsFreshCosts(Generic[Number]):
    """Work of the pieces of a standard filter that takes late measurements for new ones."""

    propagate: Number
    update: Number


LateCosts: TypeAlias = Px4PredictorCosts[Number] | AugmentationCosts[Number] | FuseAsFreshCosts[Number]
"""Work of methods that do the same `each_step`, and besides something `at_m`."""
CarriedCosts: TypeAlias = CloneCosts[Number] | CarriedGainCosts[Number]
SerialCosts: TypeAlias = (
    StandardCosts[Number] | RecalculateCosts[Number] | LarsenCosts[Number] | CarriedCosts[Number] | LateCosts[Number]
)
TwoRateCosts: TypeAlias = MultirateCosts[Number] | RobustCosts[Number]
JobCosts: TypeAlias = SerialCosts[Number] | DualRateCosts[Number] | TwoRateCosts[Number] | DelayedHorizonCosts[Number]
Costs: TypeAlias = JobCosts[Fraction]
"""The costs of one method, as fractions of the cost table's unit."""


def product(costs: LarsenInFlightCosts[Exact]) -> Exact:
    """Work of one more product in a step."""
    return max(costs.accumulate, costs.propagate) - costs.propagate


def beside_others(costs: CarriedCosts[Exact]) -> tuple[Exact, Exact]:
    """Work for each other measurement that is on its way, at k and at m; none where there can be no other."""
    if isinstance(costs, CloneInFlightCosts | CarriedGainInFlightCosts):
        return costs.couple, costs.compensate
    return 0 * costs.propagate, 0 * costs.propagate


def each_step(costs: LateCosts[Exact], M: int) -> Exact:
    """Work of every step, with a delay of M steps."""
    match costs:
        case Px4PredictorCosts():
            return costs.predict + costs.propagate + costs.pull + costs.shift * (M + 1)
        case AugmentationCosts():
            return costs.predict + costs.predict_more * M
        case FuseAsFreshCosts():
            return costs.propagate


def at_m(costs: LateCosts[Exact], M: int) -> Exact:
    """Work of the update in the step in which the measurement arrives."""
    if isinstance(costs, AugmentationCosts):
        return costs.update + costs.update_more * M + costs.update_bend * (M * (M - 1) // 2)
    return costs.update


def converted(costs: JobCosts[Number], convert: Callable[[Number], Other]) -> JobCosts[Other]:
    """The same pieces in other numbers."""
    lacks = getattr(costs, "lacks", "")
    said = {"lacks": lacks} if lacks else {}
    return cast("JobCosts[Other]", type(costs)(*map(convert, works(costs)), **said))  # type: ignore[arg-type]  # each of one kind


def works(costs: JobCosts[Number]) -> tuple[Number, ...]:
    """What each piece costs."""
    return tuple([getattr(costs, piece) for piece in costs.__match_args__])
