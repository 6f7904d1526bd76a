"""Larsen's extrapolation: exact in its covariance always, optimal where no other sensor measured in between."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from filters.arrays import FloatArray
from filters.delayed import larsen
from filters.modular import (
    Measurement,
    ModularFilter,
    Sensor,
    extended_corrector,
    extended_predictor,
    linear_corrector,
    run,
    space,
)
from tests.filters.modular import cases
from tests.filters.modular.cases import ONE_SENSOR, Case, largest_error, measured, measured_rows, with_timing

POSITION = linear_corrector(cases.H_POSITION, cases.R_POSITION)
BOTH = linear_corrector(cases.H_BOTH, cases.R_BOTH)


def both_ways(case: Case, steps: int, measurements: list[Measurement]) -> tuple[FloatArray, ...]:
    """x and P by Larsen's way, then by recalculation."""
    given_to_both = case.composed, case.x0, case.P0, case.inputs(steps), measurements
    return (
        *run(*given_to_both, late="larsen", backend="reference"),
        *run(*given_to_both, history=steps, backend="reference"),
    )


@pytest.mark.parametrize("name", ONE_SENSOR)
@pytest.mark.parametrize(("every", "delay"), [(every, delay) for every in range(1, 5) for delay in range(every + 1)])
def test_one_sensor_is_the_filter_of_the_system(name: str, every: int, delay: int) -> None:
    case, system = with_timing(ONE_SENSOR[name], every, delay)
    measurements = measured(case, 11)
    found = run(case.composed, case.x0, case.P0, case.inputs(11), measurements, late="larsen", backend="reference")
    expected = larsen.run(system, every, delay, delay, case.x0, case.P0, case.inputs(11), measured_rows(measurements))
    np.testing.assert_allclose(found.x, expected.x, rtol=0, atol=1e-10)


@given(
    delays=st.lists(st.integers(0, 5), max_size=5),
    gaps=st.lists(st.integers(0, 3), min_size=5, max_size=5),
    others=st.sets(st.integers(0, 30)),
)
def test_it_is_optimal_where_no_other_sensor_measures_in_between(
    delays: list[int], gaps: list[int], others: set[int]
) -> None:
    """Random delays, and another sensor that measures in any step in which the late one is not waited for."""
    case = cases.linear_case(Sensor("late", POSITION), Sensor("other", BOTH))
    steps, k = 30, 0
    measurements: list[Measurement] = []
    waiting: set[int] = set()
    for delay, gap in zip(delays, gaps, strict=False):
        measurements.append(Measurement("late", k, k + delay, np.array([np.sin(k)])))
        waiting |= set(range(k + 1, k + delay))
        k += max(delay, 1) + gap
    measurements += [Measurement("other", j, j, np.cos([j, 2.0 * j])) for j in others - waiting]
    x, P, best_x, best_P = both_ways(case, steps, measurements)
    np.testing.assert_allclose(x, best_x, rtol=0, atol=1e-10)
    np.testing.assert_allclose(P, best_P, rtol=0, atol=1e-10)


@pytest.mark.parametrize(("every", "delay", "other_every"), [(4, 3, 1), (3, 3, 2), (5, 4, 2)])
def test_its_covariance_is_that_of_its_error_and_not_below_the_best(every: int, delay: int, other_every: int) -> None:
    """With another sensor in between. The oracle knows nothing of gains: the error of a linear filter is a linear map
    of all noises together, found by giving the filter each noise alone."""
    steps, n = 9, 2
    late, other = Sensor("late", POSITION, every, delay), Sensor("other", BOTH, other_every)
    case = cases.linear_case(late, other)._replace(x0=np.zeros(n), u=np.zeros(1))
    taken = [(sensor, k) for sensor in (late, other) for k in range(0, steps + 1, sensor.every)]
    covariances = [case.P0, *[cases.Q] * steps, *[sensor.corrector.R for sensor, _ in taken]]
    starts = np.cumsum([0, *map(len, covariances)])
    covariance = np.zeros((starts[-1], starts[-1]))
    for start, block in zip(starts, covariances, strict=False):
        covariance[start : start + len(block), start : start + len(block)] = block

    def errors_from(noise: FloatArray) -> FloatArray:
        start, *rest = np.split(noise, starts[1:-1])
        truth = [start]
        for w in rest[:steps]:
            truth.append(cases.F @ truth[-1] + w)
        measurements = [
            Measurement(sensor.name, k, k + sensor.delay, sensor.corrector.view(n).H @ truth[k] + v)
            for (sensor, k), v in zip(taken, rest[steps:], strict=True)
        ]
        return truth - both_ways(case, steps, measurements)[0]

    maps = np.stack([errors_from(noise) for noise in np.eye(starts[-1])], axis=-1)  # (steps + 1, n, noises)
    _, P, _, best_P = both_ways(case, steps, measured(case, steps))
    np.testing.assert_allclose(P, maps @ covariance @ maps.transpose(0, 2, 1), rtol=0, atol=1e-12)
    smallest = np.linalg.eigvalsh(P - best_P).min(axis=1)
    assert smallest.min() >= -1e-12
    assert np.trace(P - best_P, axis1=1, axis2=2).max() >= 1e-3  # something is lost


def small_pendulum(scale: float) -> Case:
    case = cases.JACOBIANS
    predictor = extended_predictor(cases.pendulum, scale**2 * 0.1 * cases.Q, cases.pendulum_jacobian)
    height = extended_corrector(cases.height, [[scale**2 * 0.01]], cases.height_jacobian)
    composed = ModularFilter(predictor, [Sensor("height", height, every=4, delay=3)], case.composed.dt)
    return case._replace(composed=composed, P0=scale**2 * case.P0)


def small_attitude(scale: float) -> Case:
    case = cases.ATTITUDE
    predictor = extended_predictor(cases.gyroscope, scale**2 * 1e-4 * np.eye(6))
    stars = extended_corrector(cases.attitude, scale**2 * 1e-3 * np.eye(3), observed=space(4, attitudes=[0]))
    composed = ModularFilter(predictor, [Sensor("stars", stars, every=4, delay=3)], case.composed.dt, case.composed.of)
    return case._replace(composed=composed, P0=scale**2 * case.P0)


@pytest.mark.parametrize("small", [small_pendulum, small_attitude])
def test_of_extended_parts_it_is_optimal_to_first_order(small: Callable[[float], Case]) -> None:
    """With all noises a tenth, corrections are a tenth and the difference from recalculation is about a hundredth."""
    corrections, differences = [], []
    for scale in (0.1, 0.01):
        case = small(scale)
        x, _, best_x, _ = both_ways(case, 9, measured(case, 9, seed=1))
        undisturbed = run(case.composed, case.x0, case.P0, case.inputs(9), [], backend="reference").x
        corrections.append(largest_error(case, best_x, undisturbed))
        differences.append(largest_error(case, x, best_x))
    assert corrections[1] == pytest.approx(0.1 * corrections[0], rel=0.1)
    assert differences[1] <= 0.012 * differences[0]
    assert differences[0] <= 0.1 * corrections[0]
