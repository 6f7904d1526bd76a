"""Along a record of landings: the joint Gaussian conditioned on what has landed, whenever and in whatever order."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from filters.accuracy import Landing, along, linear_model, lossless, spread
from filters.arrays import FloatArray
from tests.filters.accuracy.cases import CV, INS, POSITION, random_model


class Flight(NamedTuple):
    """A model that changes, three sensors that do, and what landed when."""

    Phi: FloatArray
    Q: FloatArray
    sensors: dict[str, tuple[FloatArray, FloatArray]]
    P0: FloatArray
    steps: int
    landings: list[Landing]


@st.composite
def flights(draw: st.DrawFn) -> Flight:
    seed, n = draw(st.integers(0, 2**31 - 1)), draw(st.integers(1, 3))
    changing = [random_model(seed + i, 1.05, n, 1 + i % 2) for i in range(4)]
    sensors = {
        "gps": (changing[0].H, changing[0].R),
        "camera": (np.array([changing[1].H, changing[3].H]), np.array([changing[1].R, changing[3].R])),
        "wheel": (changing[2].H, changing[2].R),
    }
    steps = draw(st.integers(0, 14))
    taken = st.tuples(st.sampled_from(list(sensors)), st.integers(0, steps), st.integers(0, 12))
    landings = [Landing(sensor, k, k + late) for sensor, k, late in draw(st.lists(taken, max_size=8))]
    Phi, Q = np.array([model.Phi for model in changing]), np.array([model.Q for model in changing[:3]])
    return Flight(Phi, Q, sensors, changing[0].Q + np.eye(n), steps, landings)


def batch(flight: Flight, j: int) -> FloatArray:
    """The covariance of x_j given all that has landed by j, by stacking all noises."""
    n = len(flight.P0)
    landed = [landing for landing in flight.landings if landing.step <= j]
    size = n * (1 + j)
    covariance = np.zeros((size, size))
    covariance[:n, :n] = flight.P0
    x, states = np.eye(n, size), [np.eye(n, size)]
    for i in range(j):
        at = slice(n * (1 + i), n * (2 + i))
        covariance[at, at] = flight.Q[i % len(flight.Q)]
        x = flight.Phi[i % len(flight.Phi)] @ x
        x[:, at] += np.eye(n)
        states.append(x)
    for sensor, k, _ in landed:
        H, R = flight.sensors[sensor]
        H, R = (H, R) if H.ndim == 2 else (H[k % 2], R[k % 2])
        rows = H @ states[k]
        gain = covariance @ rows.T @ np.linalg.inv(rows @ covariance @ rows.T + R)
        covariance = covariance - gain @ rows @ covariance
    return np.asarray(x @ covariance @ x.T)


@given(flights())
def test_it_is_the_joint_gaussian_conditioned_on_what_has_landed(flight: Flight) -> None:
    found = along(flight.Phi, flight.Q, flight.sensors, np.eye(len(flight.P0)), *flight[3:])
    expected = [np.trace(batch(flight, j)) for j in range(flight.steps + 1)]
    np.testing.assert_allclose(found.deviations**2, expected, rtol=1e-10)


@given(flights())
def test_ages_are_of_the_newest_that_has_landed(flight: Flight) -> None:
    found = along(flight.Phi, flight.Q, flight.sensors, np.eye(len(flight.P0)), *flight[3:])
    for sensor, ages in found.ages.items():
        for j, age in enumerate(ages):
            landed = [k for name, k, step in flight.landings if name == sensor and step <= j]
            assert age == (j - max(landed) if landed else np.inf)


@given(flights(), st.randoms())
def test_the_order_in_which_landings_are_listed_is_no_matter(flight: Flight, random: object) -> None:
    other = list(flight.landings)
    random.shuffle(other)  # type: ignore[attr-defined]
    C = np.eye(len(flight.P0))
    found, expected = (
        along(flight.Phi, flight.Q, flight.sensors, C, flight.P0, flight.steps, landings)
        for landings in (other, flight.landings)
    )
    np.testing.assert_allclose(found.deviations, expected.deviations, rtol=1e-12)


@pytest.mark.parametrize("L", [0, 4, 10, 14, 25])
def test_regular_landings_lead_to_the_periodic_regime(L: int) -> None:
    steps = 600
    record = [("radar", k, k + L) for k in range(0, steps + 1, 10)]
    found = along(CV.Phi, CV.Q, {"radar": (CV.H, CV.R)}, [0], 9 * np.eye(2), steps, record)
    settled, expected = found.deviations[-10:], lossless(CV, [0], 10, L)
    assert settled.max() == pytest.approx(expected.worst, rel=1e-11)
    assert np.sqrt(np.square(settled).mean()) == pytest.approx(expected.rms, rel=1e-11)
    assert found.ages["radar"][-10:].max() == expected.oldest


def test_a_second_sensor_helps_and_a_lost_measurement_hurts() -> None:
    steps = 800
    gps = [("gps", k, k + 44) for k in range(0, steps, 80)]
    fine = {"gps": (INS.H, INS.R), "baro": (INS.H[2:], [[0.01]])}
    start = np.eye(9)
    alone = along(INS.Phi, INS.Q, fine, POSITION, start, steps, gps).deviations
    both = along(INS.Phi, INS.Q, fine, POSITION, start, steps, [*gps, *(("baro", k, k) for k in range(0, steps, 8))])
    fewer = along(INS.Phi, INS.Q, fine, POSITION, start, steps, [landing for landing in gps if landing[1] != 400])
    assert (both.deviations <= alone).all()
    assert (fewer.deviations[444:524] > alone[444:524]).all()
    np.testing.assert_array_equal(fewer.deviations[:444], alone[:444])


def test_the_spread_of_a_record() -> None:
    assert spread(np.arange(101.0)) == (50.0, 95.0, 100.0)
    assert spread(np.array([9.0, 1.0, 2.0, 3.0]), start=1) == (2.0, pytest.approx(2.9), 3.0)
    with pytest.raises(ValueError, match="start=4 must be one of the steps 0 to 3"):
        spread(np.zeros(4), start=4)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"landings": [("lidar", 0, 1)]}, "sensor 'lidar', which is unknown; there are radar"),
        ({"landings": [("radar", 3, 2)]}, "'radar' is in step 2, before its measurement is taken in k=3"),
        ({"landings": [("radar", -1, 2)]}, "k of a landing=-1 must be a whole number of steps, at least 0"),
        ({"landings": [("radar", 0.5, 2)]}, "k of a landing=0.5 must be a whole number of steps"),
        ({"steps": -1}, "steps=-1 must be a whole number of steps, at least 0"),
        ({"P0": np.eye(3)}, r"P0 has shape \(3, 3\), needed is \(2, 2\)"),
        ({"P0": -np.eye(2)}, "P0 is no covariance"),
        ({"Phi": [[1, np.nan], [0, 1]]}, "Phi holds a value that is not finite; give numbers"),
        ({"Phi": [1, 2]}, "Phi has shape .*needed is a matrix, or one for each step"),
        ({"Q": np.eye(3)}, r"Q has shape \(3, 3\), needed is \(2, 2\)"),
        ({"sensors": {"radar": ([[1, 0, 0]], [[1]])}}, r"H of radar has shape \(1, 3\), needed is \(1, 2\)"),
        ({"sensors": {"radar": ([[1, 0]], [[0]])}}, "R of radar is not positive definite"),
        ({"sensors": {"radar": ([[1, 0]], [[[1]], [[0]]])}}, "R of radar of step 1 is not positive definite"),
        ({"outputs": [2]}, "give numbers of states, from 0 to 1"),
    ],
)
def test_bad_input_is_named(change: dict[str, object], message: str) -> None:
    good = {
        "Phi": CV.Phi,
        "Q": CV.Q,
        "sensors": {"radar": (CV.H, CV.R)},
        "outputs": [0],
        "P0": np.eye(2),
        "steps": 5,
        "landings": [("radar", 0, 2)],
    }
    with pytest.raises(ValueError, match=message):
        along(**{**good, **change})  # type: ignore[arg-type]


def test_a_landing_after_the_last_step_comes_too_late_to_matter() -> None:
    model = linear_model([[1]], [[1]], [[1]], [[1]])
    sensors = {"radar": (model.H, model.R)}
    found = along(model.Phi, model.Q, sensors, [0], [[1]], 3, [("radar", 0, 4)])
    np.testing.assert_allclose(found.deviations**2, [1, 2, 3, 4])
