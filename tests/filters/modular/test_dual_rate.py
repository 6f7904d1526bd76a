"""The dual rate filter of a modular filter: a correction counts from step k + L on, and not before."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from filters.delayed import dual_rate
from filters.modular import Sensor, extended_corrector, extended_predictor, run
from tests.filters.modular.cases import ONE_SENSOR, height, measured, measured_rows, pendulum_case, with_timing


@pytest.mark.parametrize("name", ONE_SENSOR)
@pytest.mark.parametrize(("every", "delay", "L"), [(1, 0, 1), (3, 0, 2), (3, 1, 2), (4, 2, 4), (5, 4, 5)])
def test_it_is_the_dual_rate_filter_of_the_system(name: str, every: int, delay: int, L: int) -> None:
    case, system = with_timing(ONE_SENSOR[name], every, delay)
    measurements = measured(case, 13)
    found = run(
        case.composed, case.x0, case.P0, case.inputs(13), measurements, late="dual-rate", L=L, backend="reference"
    )
    expected = dual_rate.run(system, every, delay, L, case.x0, case.P0, case.inputs(13), measured_rows(measurements))
    np.testing.assert_allclose(found.x, expected.x, rtol=0, atol=1e-10)
    np.testing.assert_allclose(found.P[::every], expected.P_reference, rtol=0, atol=1e-10)


@settings(max_examples=60)
@given(data=st.data())
def test_it_is_the_filter_to_which_each_measurement_came_L_steps_late(data: st.DataObject) -> None:
    """With any dropouts, and any delays of those that come, in whatever order, several in flight; outside [k, l - 1] of
    all that is the filter without delay."""
    every = data.draw(st.integers(1, 5))
    L = data.draw(st.integers(1, 3 * every))
    case, _ = with_timing(ONE_SENSOR["linear"], every, 0)
    steps = 14
    delays = {k: data.draw(st.none() | st.integers(0, L - 1)) for k in range(0, steps + 1, every)}
    came = [
        one._replace(arrives=one.taken + delays[one.taken])
        for one in measured(case, steps)
        if delays[one.taken] is not None
    ]
    given_to_all = case.composed, case.x0, case.P0, case.inputs(steps)
    found = run(*given_to_all, came, late="dual-rate", L=L, backend="reference")
    landed = [one._replace(arrives=one.taken + L) for one in came]
    expected = run(*given_to_all, landed, history=L, backend="reference")
    in_time = run(*given_to_all, [one._replace(arrives=one.taken) for one in came], backend="reference")
    outside = [j for j in range(steps + 1) if j % every >= L]
    for each, late, undelayed in zip(found, expected, in_time, strict=True):
        np.testing.assert_allclose(each, late, rtol=0, atol=1e-10)
        np.testing.assert_allclose(each[outside], undelayed[outside], rtol=0, atol=1e-10)


def test_several_of_one_step_and_others_are_in_flight() -> None:
    case, _ = with_timing(ONE_SENSOR["linear"], 3, 0)
    first = measured(case, 14)
    both = [
        *(one._replace(arrives=one.taken + 6) for one in first),
        *(one._replace(arrives=one.taken) for one in first),
    ]
    given_to_both = case.composed, case.x0, case.P0, case.inputs(20)
    found = run(*given_to_both, both, late="dual-rate", L=8)
    expected = run(*given_to_both, [one._replace(arrives=one.taken + 8) for one in both], history=8)
    for each, late in zip(found, expected, strict=True):
        np.testing.assert_allclose(each, late, rtol=0, atol=1e-10)


def test_by_default_it_lands_in_the_first_step_of_a_cycle_after_the_delay() -> None:
    case, _ = with_timing(ONE_SENSOR["linear"], 3, 7)
    given_to_both = case.composed, case.x0, case.P0, case.inputs(20), measured(case, 14)
    for found, expected in zip(
        run(*given_to_both, late="dual-rate"), run(*given_to_both, late="dual-rate", L=9), strict=True
    ):
        np.testing.assert_array_equal(found, expected)


def test_jacobians_by_differences_are_as_good_as_given_ones() -> None:
    exact, _ = with_timing(ONE_SENSOR["extended"], 4, 2)
    by_differences = pendulum_case(extended_predictor, Sensor("height", extended_corrector(height, [[0.01]]), 4, 2))
    measurements = measured(exact, 13)
    by_both = [
        run(case.composed, case.x0, case.P0, case.inputs(13), measurements, late="dual-rate", backend="reference")
        for case in (by_differences, exact)
    ]
    for found, expected in zip(*by_both, strict=True):
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-7)
