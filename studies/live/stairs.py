"""Speeds through two steps of the staircase, and what was measured at each."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from itertools import pairwise

from sched_sim.design.least_speed import staircase
from studies.live.agreement import Agreement, Word, together
from studies.live.design import MOST_LOAD, Design
from studies.live.measure import Measured
from studies.live.taken import NEAR

FACTORS = tuple(Fraction(percent, 100) for percent in (95, 98, 99, 101, 102, 105))
"""Of the speed of a step: where it is looked at."""


def steps(design: Design) -> list[Fraction]:
    """The speeds at which the predicted l becomes one less, ascending."""
    stairs = staircase(design.costs, design.N, design.M)
    return sorted({stair.speed for stair in stairs if stair.achieved == stair.L})


def nearest_step(design: Design) -> Fraction:
    """How far, relative to it, the speed is from the nearest step: negative below it."""
    return min((design.speed / step - 1 for step in steps(design)), key=abs)


def two_steps(design: Design) -> list[Fraction]:
    """Those on both sides of the speed, or the two that are nearest to it; one, if there are no more."""
    found = steps(design)
    middles = {(low + high) / 2: [low, high] for low, high in pairwise(found)}
    return middles[min(middles, key=lambda middle: abs(middle - design.speed))] if middles else found


def through_two_steps(design: Design) -> list[Design]:
    """Designs at speeds on both sides of two steps, ascending, without those that cannot run."""
    speeds = sorted({factor * step for step in two_steps(design) for factor in FACTORS})
    designs = [design._replace(speed=speed) for speed in speeds]
    return [each for each in designs if each.load <= MOST_LOAD and each.predicted is not None]


def far_from_steps(runs: Sequence[Measured]) -> list[Agreement]:
    """Of the runs that are not near to a step. Near to it a run may disagree without there being anything wrong."""
    return [run.agreement for run in runs if abs(nearest_step(run.design)) >= NEAR]


def word_of(runs: Sequence[Measured]) -> Word:
    """Of all that are far from steps, by the cycles of all together; they disagree if one does alone, and are
    inconclusive if at one speed too many cycles were disturbed."""
    far = far_from_steps(runs)
    if not far:
        return "inconclusive"
    word = together(far).word
    if word == "disagrees" or any(of.word == "disagrees" for of in far):
        return "disagrees"
    return "inconclusive" if any(of.too_disturbed for of in far) else word
