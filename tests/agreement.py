"""Whether the analysis and the simulation, which are each other's oracle, say the same of many designs at once."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import lcm

import numpy as np

from sched_sim.design.analysis import achieved_l, least_period
from sched_sim.design.demand import NOT_LANDED
from sched_sim.design.options import Options
from sched_sim.design.pieces import DelayedHorizonCosts, DualRateCosts, JobCosts, works
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from tests.designs import Design

CYCLES = 4


def assert_agreement(costs: JobCosts, options: Options, timings: Sequence[Timing], shares: Sequence[Fraction]) -> None:
    """Of each design: at the least speed no deadline is missed, at one tick less one is; there, and at each of these
    shares of the least speed, both say where the corrections land. Costs in ticks."""
    N, M, L = (np.array(axis) for axis in zip(*((of.N, of.M, of.L) for of in timings), strict=True))
    least = least_period(costs, N, M, L, options)
    speeds = [Fraction(*pair) for pair in zip(least.numerator.tolist(), least.denominator.tolist(), strict=True)]
    for timing, speed in zip(timings, speeds, strict=True):
        assert simulate(costs, timing, speed, CYCLES, options).misses == 0, (Design(costs, timing, options), speed)
        slower = speed - Fraction(1, speed.denominator)
        if slower:
            missed = simulate(costs, timing, slower, CYCLES, options).misses
            assert missed, (Design(costs, timing, options), speed, "one tick less is enough")
    for share in shares:
        finer = share.denominator * lcm(*least.denominator.tolist())
        fine = type(costs)(*(finer * cost for cost in works(costs)))
        periods = np.array([int(finer * share * speed) for speed in speeds])
        for timing, speed, landed in zip(timings, speeds, achieved_l(fine, N, M, periods, options), strict=True):
            simulated = landing(costs, timing, share * speed, options)
            assert landed == simulated, (Design(costs, timing, options), share * speed)


def landing(costs: JobCosts, timing: Timing, speed: Fraction, options: Options) -> int:
    """The L at which corrections come to land in the simulation, NOT_LANDED as `achieved_l` means it."""
    landings: list[int] = []
    schedule = simulate(costs, timing, speed, CYCLES, options, on_landing=lambda _cycle, L: landings.append(L))
    last_legal = timing.N - 1 if options.feedback == "same-step" else max(timing.N, timing.M)
    in_time = len(landings) == CYCLES and max(landings) <= last_legal
    if not in_time or schedule.responses["hr"].misses:
        return NOT_LANDED
    piles_up = isinstance(costs, DelayedHorizonCosts) and later_and_later(costs, timing, speed, options)
    return NOT_LANDED if piles_up else landings[-1]


def later_and_later(costs: JobCosts, timing: Timing, speed: Fraction, options: Options) -> bool:
    """Whether what a cycle of the delayed horizon leaves undone grows from cycle to cycle."""
    some, more = (
        simulate(costs, timing, speed, cycles, options).responses.get("lr_propagate") for cycles in (CYCLES, 2 * CYCLES)
    )
    return some is not None and more is not None and more.worst_lateness > some.worst_lateness


def legal_timings(costs: JobCosts, N: int, options: Options) -> list[Timing]:
    """Every M and L that the method may have; one L for each M where it lands at m, whatever L is."""
    if isinstance(costs, DualRateCosts):
        first, end = (1, N + 1) if options.feedback == "next-step" else (0, N)
        return [Timing(N, M, L) for M in range(N) for L in range(M + first, end)]
    if isinstance(costs, DelayedHorizonCosts):
        return [Timing(N, M, L) for M in range(N) for L in range(M + 1, N + 1)]
    return [Timing(N, M, N) for M in range(N + 1)]
