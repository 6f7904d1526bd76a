"""Random designs: a method's costs in whole ticks, N, M, L and options, edges included."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import NamedTuple

from hypothesis import strategies as st

from sched_sim.design.methods import method_of
from sched_sim.design.options import Options
from sched_sim.design.pieces import (
    AugmentationCosts,
    CarriedGainInFlightCosts,
    CloneInFlightCosts,
    CloneSplitCosts,
    DelayedHorizonCosts,
    DualRateCosts,
    FuseAsFreshCosts,
    JobCosts,
    LarsenInFlightCosts,
    MultirateCosts,
    Px4PredictorCosts,
    RecalculateCosts,
    RobustCosts,
    StandardCosts,
)
from sched_sim.design.timing import Timing
from sched_sim.schedule.tasks import Task

ticks = st.integers(1, 5) | st.integers(1, 100)


class Design(NamedTuple):
    costs: JobCosts
    timing: Timing
    options: Options


@st.composite
def serial_designs(draw: st.DrawFn) -> Design:
    costs = draw(
        st.builds(StandardCosts, ticks, ticks)
        | st.builds(RecalculateCosts, ticks, ticks, ticks)
        | st.builds(LarsenInFlightCosts, ticks, ticks, ticks, ticks, ticks, ticks)
        | st.builds(CloneInFlightCosts, ticks, ticks, ticks, ticks, ticks, ticks)
        | st.builds(CloneSplitCosts, ticks, ticks, ticks, ticks)
        | st.builds(CarriedGainInFlightCosts, ticks, ticks, ticks, ticks, ticks, ticks)
        | st.builds(Px4PredictorCosts, ticks, ticks, ticks, ticks, ticks)
        | st.builds(AugmentationCosts, ticks, ticks, ticks, ticks, ticks)
        | st.builds(FuseAsFreshCosts, ticks, ticks)
    )
    N = draw(st.integers(1, 12))
    M = draw(st.sampled_from([0, N]) | st.integers(0, N) | st.integers(N + 1, 3 * N + 1))
    if not method_of(costs).law("next-step").several:
        M = min(M, N)
    return Design(costs, Timing(N, M, max(N, M)), Options())


@st.composite
def dual_rate_designs(draw: st.DrawFn) -> Design:
    precomputed = draw(st.booleans())
    gain = draw(ticks) if precomputed else 0
    costs = DualRateCosts(draw(ticks), draw(ticks), draw(ticks), draw(ticks), gain, draw(ticks))
    N = draw(st.integers(1, 12))
    M = draw(st.sampled_from([0, N - 1]) | st.integers(0, N - 1))
    feedback = draw(st.sampled_from(["next-step", "same-step"]))
    first, last = (M + 1, N) if feedback == "next-step" else (M, N - 1)
    L = draw(st.sampled_from([first, last]) | st.integers(first, last))
    options = Options(
        feedback=feedback,
        lr_propagate_by=draw(st.sampled_from(["m", "l"])),
        gain="precomputed" if precomputed else "at-update",
        cpus=draw(st.sampled_from([1, 2])),
    )
    return Design(costs, Timing(N, M, L), options)


@st.composite
def designs_in_flight(draw: st.DrawFn) -> Design:
    """Of the dual-rate filter, with L beyond N, and M too or not."""
    costs, _, options = draw(dual_rate_designs())
    N = draw(st.integers(1, 8))
    M = draw(st.integers(0, 2 * N + 2))
    first = M + (options.feedback == "next-step")
    L = draw(st.integers(max(first, N - (options.feedback == "same-step") + 1), max(first, N) + 2 * N))
    return Design(costs, Timing(N, M, L), options)


@st.composite
def two_rate_designs(draw: st.DrawFn) -> Design:
    N = draw(st.integers(1, 12))
    L = draw(st.sampled_from([1, N]) | st.integers(1, N))
    costs = draw(st.builds(MultirateCosts, ticks, ticks) | st.builds(RobustCosts, ticks, ticks))
    return Design(costs, Timing(N, 0, L), Options(cpus=draw(st.sampled_from([1, 2]))))


@st.composite
def horizon_designs(draw: st.DrawFn) -> Design:
    N = draw(st.integers(1, 12))
    M = draw(st.sampled_from([0, N - 1]) | st.integers(0, N - 1))
    L = draw(st.sampled_from([M + 1, N]) | st.integers(M + 1, N))
    costs = draw(st.builds(DelayedHorizonCosts, ticks, ticks, ticks, ticks))
    return Design(costs, Timing(N, M, L), Options(cpus=draw(st.sampled_from([1, 2]))))


designs = serial_designs() | dual_rate_designs() | two_rate_designs() | horizon_designs()


@st.composite
def loaded_designs(draw: st.DrawFn) -> tuple[Design, list[Task]]:
    """Context switches that cost something, and one to three tasks whose periods meet the measurements within ten
    cycles, of the filter's priorities too, with any offsets; of the two at least one."""
    design = draw(designs)
    N, cpus = design.timing.N, design.options.cpus
    names = draw(st.sampled_from(["", "a", "ab", "abc"]))
    switch = draw(st.just(Fraction(0)) | st.fractions(Fraction(1, 10), 3, max_denominator=10))
    options = replace(design.options, context_switch=switch if names else switch or Fraction(1, 10))
    periods = st.sampled_from([Fraction(N), Fraction(2 * N), Fraction(1), Fraction(N, 2), Fraction(5 * N, 2)])
    offsets = st.just(Fraction(0)) | st.fractions(0, 30, max_denominator=4)
    priorities = st.sampled_from([5, 10, 15, 20, 30])
    tasks = [
        Task(name, draw(periods), Fraction(draw(ticks)), draw(priorities), draw(offsets), draw(st.integers(1, cpus)))
        for name in names
    ]
    return design._replace(options=options), tasks
