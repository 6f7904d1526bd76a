"""PX4's output predictor, augmentation, and late measurements taken for new ones: in one thread, the same in each step,
with the update in that of m."""

from __future__ import annotations

from fractions import Fraction

from sched_sim.design.hr_loop import OnLanding
from sched_sim.design.method import CostOf, CycleWork, Method
from sched_sim.design.options import Options
from sched_sim.design.pieces import AugmentationCosts, FuseAsFreshCosts, LateCosts, Px4PredictorCosts, at_m, each_step
from sched_sim.design.serial import Serial, law
from sched_sim.design.timing import Timing
from sched_sim.schedule.jobs import Parts


def _source(costs: LateCosts[int], timing: Timing, _options: Options, period: int, on_landing: OnLanding) -> Serial:
    plain, update = _each_step(costs, timing.M), (("U", at_m(costs, timing.M)),)
    return Serial(plain, plain, update, timing, period, on_landing)


def _each_step(costs: LateCosts[int], M: int) -> Parts:
    if isinstance(costs, Px4PredictorCosts):
        return ("PR", costs.predict), ("P", costs.propagate), ("OC", costs.pull + (M + 1) * costs.shift)
    return (("P", each_step(costs, M)),)


def _work(costs: LateCosts[Fraction], timing: Timing) -> CycleWork:
    return CycleWork(timing.interval * each_step(costs, timing.M) + at_m(costs, timing.M))


def _px4_predictor_pieces(cost: CostOf, _options: Options) -> Px4PredictorCosts[Fraction]:
    return Px4PredictorCosts(*map(cost, ("predict", "propagate", "update", "pull", "shift_output")))


def _augmentation_pieces(cost: CostOf, _options: Options) -> AugmentationCosts[Fraction]:
    """From the costs at D = 0, 1 and for the update 2 by Newton's differences: exact for counts, which are polynomials;
    of measured times, what noise makes negative is taken for nothing."""
    nothing = Fraction(0)
    predict, update = cost("predict_0"), cost("update_0")
    first, second = cost("update_1") - update, cost("update_2") - cost("update_1")
    return AugmentationCosts(
        predict,
        max(cost("predict_1") - predict, nothing),
        update,
        max(first, nothing),
        max(second - first, nothing),
    )


def _fuse_as_fresh_pieces(cost: CostOf, _options: Options) -> FuseAsFreshCosts[Fraction]:
    return FuseAsFreshCosts(cost("propagate"), cost("update"))


PX4_PREDICTOR = Method(_px4_predictor_pieces, _source, _work, law, lands_in_step_m=True)
AUGMENTATION = Method(_augmentation_pieces, _source, _work, law, lands_in_step_m=True)
FUSE_AS_FRESH = Method(_fuse_as_fresh_pieces, _source, _work, law, lands_in_step_m=True)
