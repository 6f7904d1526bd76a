"""The longest HR job where several measurements are on their way, at intervals of N and N + 1 steps.

A measurement is taken q = p / r steps after the one before, and used in the HR job of a step that starts x steps after
it was taken: x is a multiple of 1 / r, d <= x < M + 1, where it arrives d <= M steps late; those that wait M steps
after their k have x >= M. Of those that were taken after it floor((x - a) / q) are of a step at least a before that
one. Each of these numbers changes at few x of such an interval, which are all that is to be looked at, however long it
takes until the intervals repeat.
"""

from __future__ import annotations

from fractions import Fraction
from math import ceil
from typing import TypeGuard

from sched_sim.design.pieces import (
    CarriedCosts,
    CarriedGainCosts,
    CloneCosts,
    Costs,
    LarsenInFlightCosts,
    beside_others,
    product,
    works,
)
from sched_sim.design.timing import Timing

PRODUCT_FROM = 2
"""Larsen's product is Phi itself one step after k, and takes work from two on."""


def comes_unevenly(costs: Costs, timing: Timing) -> TypeGuard[LarsenInFlightCosts[Fraction] | CarriedCosts[Fraction]]:
    """Whether the longest HR job hangs on the intervals."""
    if timing.instants is None or timing.M <= timing.N:
        return False
    return isinstance(costs, LarsenInFlightCosts | CloneCosts | CarriedGainCosts)


def longest_job(
    costs: LarsenInFlightCosts[Fraction] | CarriedCosts[Fraction], timing: Timing, finer: int = 1
) -> Fraction:
    """In the unit of the costs. finer: as if as many times as many measurements came until all repeats, which a rate
    nearby has."""
    assert timing.instants is not None
    every, delay = timing.instants
    one = every.denominator * finer  # a step, of which every other time is so many parts
    apart = every.numerator * finer
    since = _since(one, apart, ceil(delay * one), (timing.M + 1) * one)
    if isinstance(costs, LarsenInFlightCosts):
        at_m = max(
            products * product(costs) + costs.correct + others * costs.compensate + meets * costs.gain
            for products, others, meets in since
        )
        at_k = max(_earlier(one, apart, PRODUCT_FROM, timing.M)) * product(costs) + costs.gain
        return costs.propagate + max(at_m, at_k)
    propagate, start, carry, landing = works(costs)[:4]
    couple, compensate = beside_others(costs)
    at_m = max(
        others * (carry + compensate) + landing + meets * (start + others * couple) for _, others, meets in since
    )
    at_k = max(_earlier(one, apart, 1, timing.M - 1)) * (carry + couple) + start
    between = -(-(timing.M - 1) * one // apart) * carry
    return propagate + max(at_m, at_k, between)


def _since(one: int, apart: int, low: int, high: int) -> set[tuple[int, int, int]]:
    """In a step that starts x after a measurement was taken, low <= x < high: of that one and of those that were taken
    since, how many were at least `PRODUCT_FROM` steps before; of those since, how many earlier than in this step; and
    whether one is in it."""
    near = {low, high - 1}
    for offset in (0, one, PRODUCT_FROM * one):
        for number in range(-(-(low - offset) // apart), (high - offset) // apart + 1):
            at = number * apart + offset
            near |= {x for x in (at - 1, at) if low <= x < high}
    counts = set()
    for x in near:
        others = (x - one) // apart
        counts.add(((x - PRODUCT_FROM * one) // apart + 1, others, x // apart - others))
    return counts


def _earlier(one: int, apart: int, least: int, most: int) -> set[int]:
    """How many k may be at least and at most so many steps before a k, 1 <= least."""
    near = {0, one - 1}
    for steps in (least, most + 1):
        for number in range((steps - 1) * one // apart, steps * one // apart + 1):
            at = steps * one - number * apart
            near |= {y for y in (at - 1, at, at + 1) if 0 <= y < one}
    return {max(-((y - (most + 1) * one) // apart) - max(-((y - least * one) // apart), 1), 0) for y in near}


def others_since(timing: Timing, steps: int) -> Fraction:
    """How many k lie less than so many steps after a k, on average."""
    taken = timing.taken

    def sums(end: int) -> int:
        """Of floor(i / p) over i from 0 to end - 1."""
        whole = end // taken.steps
        return taken.steps * whole * (whole - 1) // 2 + whole * (end - whole * taken.steps)

    first = max(steps - 1, 0) * taken.count
    return Fraction(sums(first + taken.count) - sums(first), taken.count)
