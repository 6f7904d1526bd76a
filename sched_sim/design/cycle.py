"""The jobs of one measurement cycle of each method, as demand: when they come, what they take, when they are due.

Written from the timeline, not from the sources of the simulation, which are the oracle of what is built on it.
"""

from __future__ import annotations

from math import floor
from typing import NamedTuple

from sched_sim.design.options import Options
from sched_sim.design.pieces import (
    CarriedCosts,
    CarriedGainCosts,
    CloneCosts,
    DelayedHorizonCosts,
    DualRateCosts,
    JobCosts,
    LarsenCosts,
    LarsenInFlightCosts,
    MultirateCosts,
    RecalculateCosts,
    RobustCosts,
    StandardCosts,
    at_m,
    beside_others,
    each_step,
    product,
    works,
)
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError, option


class LowJob(NamedTuple):
    """An LR job. release, due: steps after k; work: in ticks; after_high: it comes when the HR job of k finishes."""

    kind: str
    release: int
    work: int
    due: int
    after_high: bool = False


class Cycle(NamedTuple):
    """high: work of the HR job of each step, from k on, without the correction.

    correction: HR work that comes once, in any step from k + first to k + last, its own job if `apart`. low: in the
    order in which they run; landing: which of them the correction waits for. passed: steps from the measurement whose
    correction it is to k, where others are taken before it arrives. several: LR work may be left when the next cycle
    begins.
    """

    high: list[int]
    correction: int = 0
    first: int = 1
    last: int = 0
    apart: bool = False
    low: tuple[LowJob, ...] = ()
    landing: int = -1
    passed: int = 0
    several: bool = False


def cycle_of(costs: JobCosts[int], timing: Timing, options: Options, lands: int | None = None) -> Cycle:
    """costs in ticks. lands: the L up to which corrections of the dual-rate filter may come, by default that of the
    design."""
    N, M, L = timing.N, timing.M, timing.L
    if timing.instants is not None and M > N and isinstance(costs, LarsenInFlightCosts | CloneCosts | CarriedGainCosts):
        return _uneven(costs, timing)
    match costs:
        case StandardCosts(propagate, update):
            return Cycle([propagate + update, *[propagate] * (N - 1)])
        case RecalculateCosts(propagate, update, replay):
            high = [propagate] * N
            high[M % N] += update + M * replay
            return Cycle(high)
        case LarsenInFlightCosts() if M > N:
            return _larsen_in_flight(costs, N, M)
        case LarsenCosts(propagate, accumulate, update):
            high = [accumulate if 2 <= step < M else propagate for step in range(N)]
            updated = update + (accumulate if M >= 2 else propagate)
            high[M % N] = max(updated, propagate) if M == N else updated  # the first step has no measurement yet
            return Cycle(high)
        case CloneCosts(propagate, at_k, carry, landing) | CarriedGainCosts(propagate, at_k, carry, landing):
            couple, compensate = beside_others(costs)
            high = [propagate] * N
            for age in range(1, M):
                high[age % N] += carry + couple * (age % N == 0)
            high[0] += at_k
            high[M % N] += landing + sum(compensate for age in range(1, M) if age % N == 0)
            return Cycle(high)
        case MultirateCosts() | RobustCosts():
            always, once = works(costs)
            kind = "lr_gain" if isinstance(costs, MultirateCosts) else "lr_step"
            return Cycle([always] * N, low=(LowJob(kind, 0, once, L, after_high=True),))
        case DualRateCosts():
            return _dual_rate(costs, timing, options, L if lands is None else lands)
        case DelayedHorizonCosts():
            return _delayed_horizon(costs, timing)
        case _:
            high = [each_step(costs, M)] * N
            high[M % N] += at_m(costs, M)
            return Cycle(high)


def _larsen_in_flight(costs: LarsenInFlightCosts[int], N: int, M: int) -> Cycle:
    """Once as many are on their way as there will be."""
    products = [(M - step) // N - (1 - step) // N for step in range(N)]  # of k that are 2 .. M steps ago
    high = [costs.propagate + count * product(costs) for count in products]
    high[0] += costs.gain
    high[M % N] += costs.correct + (M - 1) // N * costs.compensate
    return Cycle(high)


def _uneven(costs: LarsenInFlightCosts[int] | CarriedCosts[int], timing: Timing) -> Cycle:
    """At the most, where intervals are N steps and N + 1: each N, all that is ever done at k and at m in one step, and
    in each step as much as in any."""
    assert timing.instants is not None
    before, with_m = (floor(steps / timing.instants.every) for steps in (timing.M - 1, timing.M))
    if isinstance(costs, LarsenInFlightCosts):
        each, at_once = (before + 1) * product(costs), costs.gain + costs.correct + with_m * costs.compensate
    else:
        _propagate, at_k, carry, landing = works(costs)[:4]
        couple, compensate = beside_others(costs)
        each, at_once = (before + 1) * carry, at_k + landing + with_m * (couple + compensate)
    high = [costs.propagate + each] * timing.N
    high[0] += at_once
    return Cycle(high)


def _dual_rate(costs: DualRateCosts[int], timing: Timing, options: Options, lands: int) -> Cycle:
    """With several on their way, as if each landed that late: it goes through the most cycles, and most are missing."""
    N, M, L = timing.N, timing.M, timing.L
    apart = options.feedback == "same-step"
    if L + apart > N and options.policy == "edf":
        raise InputError(
            f"{option('policy')} edf with L={L} and N={N}: several corrections are on their way, and then it is not "
            f"known by deadlines at which phase of the tasks they are latest: choose {option('policy')} fixed, or give "
            f"each task an offset, and no jitter"
        )
    due = L + 1 if apart else L
    early = due if options.lr_propagate_by == "l" or M == 0 else M
    high = [costs.hr] * N
    high[1 % N] = costs.hr_restart
    if timing.instants is not None:  # fewer restart than with each interval the shorter one
        high = [max(costs.hr, costs.hr_restart)] * N
    waits = M >= N and not costs.lr_gain
    passed = (M // N if waits else max(M - 1, 0) // N) * N
    missing = (lands + apart - 1) // N
    update = LowJob("lr_update", M - passed, costs.lr_update + missing * costs.hr_update, due - passed, M == 0)
    if waits:  # LR propagate of the next cycle, for the update that comes before it
        low = [update, LowJob("lr_propagate", M - passed, costs.lr_propagate, early + N - passed, after_high=M == N)]
    else:
        low = [LowJob("lr_propagate", 0, costs.lr_propagate, early, after_high=True)]
        if costs.lr_gain:
            low.append(LowJob("lr_gain", 0, costs.lr_gain, early, after_high=True))
        low.append(update)
    first = M if apart else M + 1
    correction = max(-(-lands // N), 1) * costs.hr_update
    several, landing = L + apart > N, low.index(update)
    return Cycle(high, correction, first - passed, lands - passed, apart, tuple(low), landing, passed, several)


def _delayed_horizon(costs: DelayedHorizonCosts[int], timing: Timing) -> Cycle:
    """What is replayed counts as if it landed at l."""
    N, M, L = timing.N, timing.M, timing.L
    early = 1 if M == 0 else 0  # propagations that only the measurement's own step tells enough for
    update = early * costs.propagate + costs.update + L * costs.replay
    low = [LowJob("lr_update", M, update, L, after_high=M == 0)]
    if early < N:
        low.append(LowJob("lr_propagate", M, (N - early) * costs.propagate, M + N, after_high=M == 0))
    return Cycle([costs.predict] * N, low=tuple(low), landing=0)
