"""What arrives: with numbers lost, several of one sensor in one step, too late to be used, or without inputs."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from filters.arrays import FloatArray
from filters.backends.choose import BackendName
from filters.modular import (
    Measurement,
    ModularFilter,
    ModularHistory,
    Sensor,
    extended_corrector,
    extended_predictor,
    linear_corrector,
    linear_predictor,
    run,
    space,
    unscented_corrector,
)
from filters.modular.correctors import Corrector
from filters.modular.late import Late
from tests.filters.modular import cases

LEFT_OUT: tuple[Late, ...] = ("recalculate", "larsen", "dual-rate")
"""What is lost, or never arrives, is as if it had not been taken: but to "carried-gain", see its own tests."""
WAYS: tuple[Late, ...] = (*LEFT_OUT, "carried-gain")
H, R = np.array([[1.0, 0.5], [0.3, -1.0], [0.0, 1.0]]), np.array([[0.5, 0.1, 0.0], [0.1, 0.3, -0.1], [0.0, -0.1, 0.4]])
X0, P0 = np.array([0.5, -0.3]), np.array([[1.0, 0.2], [0.2, 0.8]])
STEPS, EVERY, DELAY = 11, 4, 2


def seen(x: FloatArray, out: FloatArray) -> None:
    out[0], out[1], out[2] = x[0] * x[1], np.sin(x[0]), x[1] ** 2


def sensor_of(kind: str, rows: list[int]) -> Sensor:
    """With these rows of the measurement only."""

    def h(x: FloatArray, out: FloatArray) -> None:
        everything = np.empty(3)
        seen(x, everything)
        out[:] = everything[rows]

    noise = R[np.ix_(rows, rows)]
    correctors = {"linear": lambda: linear_corrector(H[rows], noise)}
    correctors |= {"extended": lambda: extended_corrector(h, noise), "unscented": lambda: unscented_corrector(h, noise)}
    return Sensor("s", correctors[kind](), EVERY, DELAY)


def history(
    sensors: list[Sensor],
    measurements: list[Measurement],
    late: Late,
    backend: BackendName = "reference",
    **options: Any,
) -> ModularHistory:
    composed = ModularFilter(linear_predictor(cases.F, cases.Q), sensors)
    return run(composed, X0, P0, np.zeros((STEPS, 0)), measurements, late=late, backend=backend, **options)


def taken(*ys: Any) -> list[Measurement]:
    """One of these each EVERY steps, late."""
    return [Measurement("s", EVERY * i, EVERY * i + DELAY, y) for i, y in enumerate(ys)]


@pytest.mark.parametrize(
    ("kind", "late"),
    [*(("linear", late) for late in WAYS), *(("extended", late) for late in WAYS), ("unscented", "recalculate")],
)
@pytest.mark.parametrize("rows", [[0], [1], [2], [0, 1], [0, 2], [1, 2], [0, 1, 2]])
def test_lost_numbers_are_as_if_the_sensor_had_no_such_rows(rows: list[int], kind: str, late: Late) -> None:
    """Of h and of R, which is not diagonal."""
    ys = np.array([[0.4, -0.2, 0.9], [0.1, 0.3, 0.5], [-0.6, 0.2, 0.1]])
    with_gaps = [[y[r] if r in rows else None for r in range(3)] for y in ys]
    found = history([sensor_of(kind, [0, 1, 2])], taken(*with_gaps), late)
    expected = history([sensor_of(kind, rows)], taken(*ys[:, rows]), late)
    for each, same in zip(found, expected, strict=True):
        np.testing.assert_allclose(each, same, rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("late", WAYS)
def test_a_masked_number_is_lost(late: Late) -> None:
    sensor = sensor_of("linear", [0, 1, 2])
    expected = history([sensor], taken([0.4, None, 0.9], [None, None, None]), late)
    masked = [np.ma.array([0.4, -0.2, 0.9], mask=[0, 1, 0]), np.ma.masked_all(3)]
    for ys in (masked, [[0.4, np.ma.masked, 0.9], [np.ma.masked] * 3]):
        np.testing.assert_array_equal(history([sensor], taken(*ys), late).x, expected.x)


@pytest.mark.parametrize("late", LEFT_OUT)
def test_a_measurement_that_has_lost_all_is_none(late: Late) -> None:
    sensor = sensor_of("linear", [0, 1, 2])
    found = history([sensor], taken([None, None, None], [0.1, 0.3, 0.5]), late)
    expected = history([sensor], taken([0.0, 0.0, 0.0], [0.1, 0.3, 0.5])[1:], late)
    for each, same in zip(found, expected, strict=True):
        np.testing.assert_array_equal(each, same)


@pytest.mark.parametrize("late", WAYS)
def test_none_in_place_of_a_measurement_is_one_that_has_lost_all(late: Late) -> None:
    sensor = sensor_of("extended", [0, 1, 2])
    found = history([sensor], taken(None, [0.1, 0.3, 0.5]), late)
    expected = history([sensor], taken([None, None, None], [0.1, 0.3, 0.5]), late)
    np.testing.assert_array_equal(found.x, expected.x)
    np.testing.assert_array_equal(found.P, expected.P)


def test_a_lost_number_need_not_be_one_that_the_model_can_expect() -> None:
    """A bearing to a beacon that the vehicle stands on: the rest of the measurement is used."""

    def bearing_and_first(x: FloatArray, out: FloatArray) -> None:
        out[0] = np.log(x[0] - 100.0)
        out[1] = x[0]

    def only_first(x: FloatArray, out: FloatArray) -> None:
        out[0] = x[0]

    for make in (extended_corrector, unscented_corrector):
        both, first = Sensor("s", make(bearing_and_first, np.eye(2))), Sensor("s", make(only_first, np.eye(1)))
        composed = [ModularFilter(linear_predictor(np.eye(1), np.eye(1)), [sensor]) for sensor in (both, first)]
        inputs = np.zeros((3, 0))
        with_gap, without = [Measurement("s", 2, 2, [None, 7.0])], [Measurement("s", 2, 2, [7.0])]
        found = run(_moving(composed[0]), [110.0], 1e-4 * np.eye(1), inputs, with_gap)
        expected = run(_moving(composed[1]), [110.0], 1e-4 * np.eye(1), inputs, without)
        np.testing.assert_allclose(found.x, expected.x, rtol=1e-12)
        np.testing.assert_allclose(found.P, expected.P, rtol=1e-12)


def _moving(composed: ModularFilter) -> ModularFilter:
    """To where the logarithm is not defined."""

    def down(x: FloatArray, _u: FloatArray, _dt: float, out: FloatArray) -> None:
        out[0] = x[0] - 50.0

    return ModularFilter(extended_predictor(down, np.eye(1)), composed.sensors)


def test_an_attitude_is_lost_whole_and_the_numbers_beside_it_are_used() -> None:
    def attitude_and_bias(x: FloatArray, out: FloatArray) -> None:
        out[0] = x[4]
        out[1:5] = x[:4]
        out[5] = x[5]

    def biases(x: FloatArray, out: FloatArray) -> None:
        out[0], out[1] = x[4], x[5]

    def stars(x: FloatArray, out: FloatArray) -> None:
        out[:] = x[:4]

    noise, P = np.diag([1e-3, 1e-4, 2e-4, 3e-4, 2e-3]), [0, 4]
    q = [0.8, 0.0, 0.6, 0.0]
    whole = extended_corrector(attitude_and_bias, noise, observed=space(6, attitudes=[1]))
    parts = {
        (0.02, None, None, None, None, -0.01): (extended_corrector(biases, noise[np.ix_(P, P)]), [0.02, -0.01]),
        (None, *q, None): (extended_corrector(stars, noise[1:4, 1:4], observed=space(4, attitudes=[0])), q),
    }
    for y, (corrector, rest) in parts.items():
        found, expected = (_attitude_run(one, what) for one, what in ((whole, y), (corrector, rest)))
        assert cases.largest_error(cases.ATTITUDE, found.x, expected.x) <= 1e-12
        np.testing.assert_allclose(found.P, expected.P, rtol=0, atol=1e-14)
    with pytest.raises(ValueError, match=r"sensor 's', .* an attitude in y is lost whole or not at all"):
        _attitude_run(whole, (0.02, 0.8, None, 0.6, 0.0, -0.01))


def _attitude_run(corrector: Corrector, y: Any) -> ModularHistory:
    case = cases.attitude_case(extended_predictor, Sensor("s", corrector))
    return run(case.composed, case.x0, case.P0, case.inputs(3), [Measurement("s", 1, 1, y)])


@pytest.mark.exhaust
def test_lost_numbers_in_compiled_code() -> None:
    sensor = sensor_of("linear", [0, 1, 2])
    measurements = taken([0.4, None, 0.9], [None, 0.3, None], [-0.6, 0.2, 0.1])
    measurements += [one._replace(y=[0.3, 0.2, None]) for one in measurements]
    found, expected = (history([sensor], measurements, "larsen", backend) for backend in ("compiled", "reference"))
    for each, same in zip(found, expected, strict=True):
        np.testing.assert_allclose(each, same, rtol=1e-12, atol=1e-14)


@settings(max_examples=60)
@given(
    ages=st.lists(st.integers(0, DELAY), min_size=1, max_size=4),
    lost=st.lists(st.sets(st.integers(0, 2), max_size=3), min_size=4, max_size=4),
    late=st.sampled_from(LEFT_OUT),
)
def test_several_of_one_sensor_in_one_step_are_all_used(ages: list[int], lost: list[set[int]], late: Late) -> None:
    """Taken in step 4, they arrive in it or later, with numbers lost: the information of those that are there adds up.
    x and P by P^-1 + sum H^T R^-1 H, without a gain, in the step in which every way has used all."""
    ys = [[None if r in gone else 0.1 * (1 + i) + 0.2 * r for r in range(3)] for i, gone in enumerate(lost)]
    measurements = [Measurement("s", 4, 4 + age, y) for age, y in zip(ages, ys, strict=False)]
    end = 4 + DELAY + 1
    found = history(
        [sensor_of("linear", [0, 1, 2])], measurements, late, **({"L": DELAY + 1} if late == "dual-rate" else {})
    )
    x, P = X0, P0
    for j in range(end + 1):
        if j > 0:
            x, P = cases.F @ x, cases.F @ P @ cases.F.T + cases.Q
        if j == 4:
            information, vector = np.linalg.inv(P), np.linalg.solve(P, x)
            for _, _, _, y in measurements:
                there = [r for r in range(3) if y[r] is not None]
                weight = H[there].T @ np.linalg.inv(R[np.ix_(there, there)])
                information = information + weight @ H[there]
                vector = vector + weight @ np.array([y[r] for r in there], dtype=float)
            P = np.linalg.inv(information)
            x = P @ vector
    np.testing.assert_allclose(found.x[end], x, rtol=0, atol=1e-10)
    np.testing.assert_allclose(found.P[end], P, rtol=0, atol=1e-10)


def test_they_are_used_in_the_order_in_which_they_arrive() -> None:
    """Which matters where h is bent: as two sensors would that are listed so."""
    one, other = [0.9, 0.4, 0.2], [-0.3, 0.1, 0.6]
    sensor = sensor_of("extended", [0, 1, 2])
    pair = [Sensor("first", sensor.corrector), Sensor("second", sensor.corrector)]
    for first, second in ((one, other), (other, one)):
        found = history([sensor], [Measurement("s", 4, 6, second), Measurement("s", 4, 5, first)], "recalculate")
        expected = history(
            pair, [Measurement("first", 4, 5, first), Measurement("second", 4, 6, second)], "recalculate", history=2
        )
        np.testing.assert_allclose(found.x, expected.x, rtol=0, atol=1e-13)
    listed = [
        history([sensor], [*taken(*ys)[:1], Measurement("s", 0, DELAY, ys[1])], "larsen").x[-1]
        for ys in ((one, other), (other, one))
    ]
    assert np.abs(listed[0] - listed[1]).max() > 1e-6


def test_the_too_old_are_dropped_where_that_is_asked_for() -> None:
    sensor = sensor_of("linear", [0, 1, 2])
    good = taken([0.4, -0.2, 0.9], [0.1, 0.3, 0.5])
    old = [Measurement("s", 2, 7, [9.0, 9.0, 9.0]), Measurement("s", 0, 5, [8.0, 8.0, 8.0])]
    never = Measurement("s", 3, STEPS + 1, [7.0, 7.0, 7.0])
    with pytest.raises(ValueError, match=r"step 0, which arrives in step 5: the history goes back 2 .*too_old='drop'"):
        history([sensor], [*good, *old], "recalculate")
    found = history([sensor], [*old, *good, never], "recalculate", too_old="drop")
    assert found.dropped == (old[1], old[0])
    assert pickle.loads(pickle.dumps(found)).dropped == found.dropped
    x, P = history([sensor], good, "recalculate")
    np.testing.assert_array_equal(found.x, x)
    np.testing.assert_array_equal(found.P, P)
    assert history([sensor], good, "recalculate", too_old="drop").dropped == ()


def test_dual_rate_drops_what_comes_when_the_correction_has_landed() -> None:
    sensor = sensor_of("linear", [0, 1, 2])
    good, late = taken([0.4, -0.2, 0.9]), [Measurement("s", 4, 4 + age, [9.0, 9.0, 9.0]) for age in (3, 5)]
    with pytest.raises(ValueError, match=r"it arrives in step 7, and its correction lands in step 7; .*too_old='drop'"):
        history([sensor], [*good, *late], "dual-rate", L=3)
    found = history([sensor], [*good, *late], "dual-rate", L=3, too_old="drop")
    assert found.dropped == tuple(late)
    np.testing.assert_array_equal(found.x, history([sensor], good, "dual-rate", L=3).x)


@pytest.mark.parametrize("late", LEFT_OUT)
@pytest.mark.parametrize("arrives", [STEPS + 1, 99])
def test_what_arrives_after_the_last_step_is_left_out_however_old_it_is(late: Late, arrives: int) -> None:
    sensor = sensor_of("linear", [0, 1, 2])
    good, never = taken([0.4, -0.2, 0.9]), Measurement("s", 4, arrives, [7.0, 7.0, 7.0])
    found = history([sensor], [*good, never], late)
    np.testing.assert_array_equal(found.x, history([sensor], good, late).x)
    assert found.dropped == ()
    composed = ModularFilter(linear_predictor(cases.F, cases.Q), [sensor])
    assert len(run(composed, X0, P0, np.zeros((0, 0)), [Measurement("s", 0, 5, [7.0] * 3)], late=late).x) == 1


@pytest.mark.parametrize("late", WAYS)
def test_without_inputs_the_measurements_say_how_many_steps(late: Late) -> None:
    composed = ModularFilter(linear_predictor(cases.F, cases.Q), [sensor_of("linear", [0, 1, 2])])
    measurements = taken([0.4, -0.2, 0.9], [0.1, 0.3, 0.5])
    found = run(composed, X0, P0, None, measurements, late=late)
    expected = run(composed, X0, P0, np.zeros((EVERY + DELAY, 0)), measurements, late=late)
    np.testing.assert_array_equal(found.x, expected.x)
    assert len(run(composed, X0, P0, None, [], late=late).x) == 1


def test_a_history_longer_than_the_run_is_no_longer_than_it() -> None:
    assert history([sensor_of("linear", [0])], [], "recalculate", history=10**15).x.shape == (STEPS + 1, 2)


def test_a_number_too_large_for_a_float_is_named() -> None:
    with pytest.raises(ValueError, match=r"sensor 's', measurement of step 0, .*y is .1000.*; its corrector needs"):
        history([sensor_of("linear", [0])], [Measurement("s", 0, 0, [10**400])], "recalculate")
