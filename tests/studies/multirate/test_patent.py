"""The patent's loads exactly, and its operation counts against our loops, term by term."""

from __future__ import annotations

from fractions import Fraction

import pytest

from filters.backends.counted import Operations
from studies.multirate.patent import (
    CYCLES,
    comparison,
    cycle_us,
    loads,
    observations,
    printed_cycle_us,
    printed_operations,
    terms,
    total,
)


def test_execution_times() -> None:
    assert cycle_us("state_update") == 7_626
    assert cycle_us("covariance_gain") == printed_cycle_us() == 166_870


def test_loads() -> None:
    trucks, aircraft, multirate = loads()
    assert [load.percent for load in loads()] == [Fraction("4.17175"), Fraction("16.687"), Fraction("4.1")]
    assert all(f"{float(load.percent):.1f}" == load.printed for load in loads())
    assert trucks.complete_percent == Fraction("4.3624")
    assert aircraft.complete_percent == Fraction("17.4496")
    assert multirate.complete_percent == multirate.percent


@pytest.mark.parametrize("cycle", CYCLES)
def test_terms_sum_to_the_job(cycle: str) -> None:
    in_job = [term.ours for term in terms() if term.cycle == cycle and term.in_job]
    assert total(in_job) == comparison(cycle).job


def test_what_the_printed_counts_leave_unexplained() -> None:
    state, covariance = (comparison(cycle) for cycle in CYCLES)
    assert state.job == Operations(multiply=128, add=120)
    assert state.from_zero == Operations(multiply=128, add=140)
    assert state.printed == Operations(multiply=139, add=128)
    assert state.remainder == {"multiply": 11, "add": -12, "divide": 0}
    assert covariance.job == Operations(multiply=2720, add=2432, divide=4)
    assert covariance.with_noise_model == Operations(multiply=3104, add=2720, divide=4)
    assert covariance.from_zero == Operations(multiply=3104, add=3184, divide=4)
    assert covariance.printed == Operations(multiply=2965, add=3488, divide=36)
    assert covariance.remainder == {"multiply": -139, "add": 304, "divide": 32}


def test_observations_are_true() -> None:
    assert [observation.text for observation in observations() if not observation.holds] == []
    assert printed_operations("covariance_gain").divide == 36
