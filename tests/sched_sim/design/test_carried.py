"""Stochastic cloning and the carried gain: what their shipped costs come to, and several measurements at once."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sched_sim.costs.methods import DELAYED_METHODS, PAPER_METHODS
from sched_sim.costs.table import CostTable
from sched_sim.costs.table_file import load_costs
from sched_sim.design.analysis import least_period
from sched_sim.design.cycle import cycle_of
from sched_sim.design.least_speed import achieved_l, least_speed
from sched_sim.design.methods import method_of, select
from sched_sim.design.options import Options
from sched_sim.design.pieces import CarriedGainInFlightCosts, CloneInFlightCosts
from sched_sim.design.timing import Timing
from studies.steffes.tables import cases
from tests.designs import ticks

COUNTED = load_costs("counted-9-3-3")


def short(method: str) -> CostTable:
    """Counted at 9 states, 3 inputs and 3 measurements, in the form `short`."""
    from filters.systems.example import example_system
    from studies.measurement.methods import measure

    return measure(example_system(9, 3, 3), "counted", "short", name="short", methods=["standard", method])


def peak(table: CostTable, method: str, timing: Timing) -> Fraction:
    least = least_speed(select(table, method), timing)
    assert least.binding == "hr"
    return least.speed


def test_the_papers_methods_come_first() -> None:
    assert DELAYED_METHODS[:7] == (*PAPER_METHODS, "clone", "clone-split", "carried-gain")


@pytest.mark.parametrize(("method", "most"), [("clone", 3725), ("clone-split", 3632), ("larsen", 6887)])
def test_the_longest_hr_job_with_n_80_and_m_44(method: str, most: int) -> None:
    """`short`. The prototype: clone 4212, split 3728, Larsen's method 6887."""
    assert peak(short(method), method, Timing(80, 44, 80)) == most


@given(N=st.integers(2, 200), data=st.data())
def test_it_is_shorter_than_larsens(N: int, data: st.DataObject) -> None:
    timing = Timing(N, data.draw(st.integers(1, N)), N)
    larsen, clone, split = (peak(COUNTED, method, timing) for method in ("larsen", "clone", "clone-split"))
    assert clone < larsen
    assert split < clone


def test_the_carried_gain_needs_the_standard_filters_power() -> None:
    """1.00 in the units of Table 4, in every row of it, where Larsen's method needs 1.53."""
    normalised = COUNTED.normalised()
    for timing in [*cases(), Timing(80, 44, 44), Timing(10, 1, 10)]:
        carried, standard = (peak(normalised, method, timing) for method in ("carried-gain", "standard"))
        assert standard == 1
        assert carried < standard
        assert f"{float(carried):.2f}" in ("0.99", "1.00")
        assert achieved_l(select(normalised, "carried-gain"), timing, standard) == timing.M


@pytest.mark.parametrize("pieces", [CarriedGainInFlightCosts, CloneInFlightCosts])
@given(N=st.integers(1, 6), M=st.integers(0, 20), work=st.tuples(*[ticks] * 6))
def test_with_m_beyond_n_jobs_are_those_of_the_timeline(pieces: type, N: int, M: int, work: tuple[int, ...]) -> None:
    """Of each measurement: work at k and at m, carried between; for two of which one is taken while the other is on
    its way, once `couple` and once `compensate`. Closed form, cycle and work of a cycle say what the source does."""
    costs, timing = pieces(*work), beyond(N, M)
    propagate, at_k, carry, at_m, couple, compensate = work
    steps = 2 * M + 3 * N
    expected = [propagate] * steps
    for k in range(0, steps, N):
        for step, at_it in ((k, at_k), (k + M, at_m), *((j, carry) for j in range(k + 1, k + M))):
            if step < steps:
                expected[step] += at_it
        for later in range(k + N, k + M, N):
            for step, at_it in ((later, couple), (k + M, compensate)):
                if step < steps:
                    expected[step] += at_it
    method = method_of(costs)
    source = method.source(costs, timing, Options(), 1, lambda _cycle, _L: None)
    assert [source.release()[0].remaining for _ in range(steps)] == expected
    first = -(-M // N) * N + N
    last_cycle = expected[first : first + N]
    assert max(last_cycle) == least_period(costs, *np.array([[N], [M], [M]]), Options()).numerator[0]
    assert cycle_of(costs, timing, Options()).high == last_cycle
    assert method.work(costs, timing).high == sum(last_cycle)


def beyond(N: int, M: int) -> Timing:
    """A timing that is not checked."""
    timing = Timing(N, 0, N)
    object.__setattr__(timing, "M", M)
    object.__setattr__(timing, "L", max(M, N))
    return timing
