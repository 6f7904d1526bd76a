"""The simulated flight keeps to what is known of rockets, and the filter's model to kinematics."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from filters.arrays import FloatArray
from filters.backends.choose import BackendName
from filters.systems.rocket import BURN_S, Flight, Rocket, rail_attitude, random_rocket, simulate_flight
from filters.systems.rocket_filter import (
    GRAVITY,
    OF,
    TUNED,
    ProcessNoise,
    densities,
    move,
    process_noise,
    rocket_filter,
    specific_force,
    start,
)
from filters.systems.rocket_motion import EARTH_RADIUS_M, Airframe

ROCKET = Rocket()
CALM = ROCKET._replace(wind=0.0, gusts=0.0)
NO_AIR = CALM._replace(airframe=Airframe(density=0.0), elevation=90.0)


@cache
def flight(rocket: Rocket, seed: int = 0, backend: BackendName = "reference") -> Flight:
    return simulate_flight(rocket, seed, backend=backend)


def attitudes(states: FloatArray) -> Rotation:
    return Rotation.from_quat(states[:, 12:], scalar_first=True)


def coasting(flown: Flight) -> FloatArray:
    return flown.states[flown.time_s >= BURN_S]


def energy(states: FloatArray) -> FloatArray:
    """Per kilogram, in the field of a round Earth."""
    height = states[:, 2]
    potential = GRAVITY * EARTH_RADIUS_M * height / (EARTH_RADIUS_M + height)
    return np.asarray(np.sum(states[:, 3:6] ** 2, axis=1) / 2 + potential)


# ----------------------------------------------------------------------------------------------------- the truth


def test_it_stands_on_the_pad_flies_and_ends_at_apogee() -> None:
    flown = flight(ROCKET)
    assert flown.time_s[0] == -1.0
    np.testing.assert_allclose(np.diff(flown.time_s), 0.01)
    pad = flown.states[flown.time_s <= 0]
    np.testing.assert_array_equal(pad[:, :12], 0.0)
    np.testing.assert_array_equal(pad[:, 12:], np.tile(rail_attitude(ROCKET), (len(pad), 1)))
    climb = flown.states[1 + len(pad) :, 5]
    assert (climb[:-1] > 0).all()
    assert climb[-1] <= 0
    assert 2000 < flown.states[-1, 2] < 3500


def test_the_rail_points_where_it_is_told() -> None:
    nose = Rotation.from_quat(rail_attitude(ROCKET), scalar_first=True).apply([1.0, 0.0, 0.0])
    up, heading = np.radians(85.0), np.radians(60.0)
    np.testing.assert_allclose(nose, [np.cos(up) * np.cos(heading), np.cos(up) * np.sin(heading), np.sin(up)])


def test_mass_falls_by_the_propellant_as_thrust_says() -> None:
    """thrust = exhaust speed times the mass that goes, so the impulse is that of all propellant."""
    flown = flight(ROCKET)
    assert flown.mass_kg[0] == ROCKET.dry_mass + ROCKET.propellant
    np.testing.assert_allclose(flown.mass_kg[flown.time_s >= BURN_S], ROCKET.dry_mass)
    impulse = (flown.thrust_n[1:] + flown.thrust_n[:-1]) / 2 * 0.01
    np.testing.assert_allclose(ROCKET.exhaust_speed * -np.diff(flown.mass_kg), impulse, atol=1e-9)
    assert impulse.sum() == pytest.approx(ROCKET.propellant * ROCKET.exhaust_speed)


def test_without_air_it_burns_out_as_tsiolkovsky_says() -> None:
    """c ln(m0 / m1) - g t; thrust less than weight is borne by the pad, for 5 ms."""
    flown = flight(NO_AIR)
    speed = coasting(flown)[0, 5]
    gained = ROCKET.exhaust_speed * np.log(1 + ROCKET.propellant / ROCKET.dry_mass)
    assert speed == pytest.approx(gained - GRAVITY * BURN_S, abs=0.05)


def test_without_air_it_coasts_as_high_as_its_energy_takes_it() -> None:
    coast = coasting(flight(NO_AIR))
    np.testing.assert_allclose(energy(coast), energy(coast)[0], rtol=1e-10)
    of_speed = energy(coast)[0] / GRAVITY
    apogee = of_speed * EARTH_RADIUS_M / (EARTH_RADIUS_M - of_speed)
    assert coast[-1, 2] == pytest.approx(apogee, abs=GRAVITY * 0.01**2 / 2)
    np.testing.assert_allclose(coast[:, :2], 0.0, atol=1e-9)


def test_drag_takes_energy_and_a_quarter_of_the_height() -> None:
    coast = coasting(flight(CALM))
    assert (np.diff(energy(coast)) < 0).all()
    assert 0.5 < coast[-1, 2] / flight(NO_AIR).states[-1, 2] < 0.85


def test_velocity_acceleration_and_turn_rate_are_derivatives() -> None:
    """By central differences, but for the corners: thrust onset and end, and the end of the rail; without gusts."""
    flown = flight(CALM)
    states = flown.states
    difference = (states[2:] - states[:-2]) / 0.02
    np.testing.assert_allclose(difference[:, :3], states[1:-1, 3:6], atol=0.05)
    gap = np.abs(difference[:, 3:6] - states[1:-1, 6:9]).max(axis=1)
    assert np.percentile(gap, 98) < 0.02
    turned = (attitudes(states[:-1]).inv() * attitudes(states[1:])).as_rotvec() / 0.01
    np.testing.assert_allclose(turned, (states[1:, 9:12] + states[:-1, 9:12]) / 2, atol=1e-3)
    np.testing.assert_allclose(np.linalg.norm(states[:, 12:], axis=1), 1.0, atol=1e-14)


def test_it_turns_into_the_wind_and_flies_upwind() -> None:
    """Wind towards the east: fins turn the nose west, as of any stable rocket."""
    flown = flight(CALM._replace(elevation=90.0, wind=6.0, wind_to=0.0))
    burnout = coasting(flown)[0]
    assert burnout[3] < -5
    assert abs(burnout[4]) < 1
    assert attitudes(burnout[np.newaxis]).apply([1.0, 0.0, 0.0])[0, 0] < -0.02


def test_gravity_turns_it_and_fins_keep_the_nose_to_the_air() -> None:
    states = flight(CALM).states[250:-500]
    nose = attitudes(states).apply([1.0, 0.0, 0.0])
    along = states[:, 3:6] / np.linalg.norm(states[:, 3:6], axis=1)[:, np.newaxis]
    assert np.degrees(np.arccos(np.sum(nose * along, axis=1))).max() < 2.0
    assert (np.diff(along[:, 2]) < 0).all()


def test_canted_fins_make_it_roll_in_proportion_to_speed() -> None:
    """Once motor and roll have settled; later it rolls on while speed falls."""
    states = flight(CALM).states[550:1300]
    assert states[:, 9] == pytest.approx(Airframe().cant * np.linalg.norm(states[:, 3:6], axis=1), rel=0.25)


def test_flights_are_those_of_their_seeds() -> None:
    assert random_rocket(3) == random_rocket(3)
    assert random_rocket(3) != random_rocket(4)
    gusty = flight(ROCKET, 1).states
    assert np.abs(gusty[1000] - flight(ROCKET).states[1000]).max() > 0.1


def test_a_rocket_that_is_too_heavy_is_refused() -> None:
    with pytest.raises(ValueError, match="does not leave the pad"):
        simulate_flight(ROCKET._replace(dry_mass=400.0), backend="reference")


@pytest.mark.exhaust
def test_compiled_flights_are_the_same() -> None:
    found, expected = flight(ROCKET, 0, "compiled"), flight(ROCKET)
    np.testing.assert_allclose(found.states, expected.states, rtol=1e-9, atol=1e-9)


# ------------------------------------------------------------------------------------------------ the filter's model


def test_a_step_is_constant_acceleration_and_constant_rate() -> None:
    x = np.arange(16.0) / 10
    x[12:] = rail_attitude(ROCKET)
    out = np.empty(16)
    move(x, np.empty(0), 0.2, out)
    np.testing.assert_allclose(out[:3], x[:3] + 0.2 * x[3:6] + 0.02 * x[6:9])
    np.testing.assert_allclose(out[3:6], x[3:6] + 0.2 * x[6:9])
    np.testing.assert_array_equal(out[6:12], x[6:12])
    turned = Rotation.from_quat(x[12:], scalar_first=True) * Rotation.from_rotvec(0.2 * x[9:12])
    assert abs(out[12:] @ turned.as_quat(scalar_first=True)) == pytest.approx(1.0, abs=4e-15)


def test_accelerometers_feel_weight_on_the_pad_and_nothing_in_free_fall() -> None:
    x, out = np.zeros(16), np.empty(3)
    x[12:] = rail_attitude(ROCKET)
    specific_force(x, out)
    up = np.radians(ROCKET.elevation)
    np.testing.assert_allclose(out, GRAVITY * np.array([np.sin(up), 0.0, np.cos(up)]), atol=1e-14)
    x[8] = -GRAVITY
    specific_force(x, out)
    np.testing.assert_array_equal(out, 0.0)


def test_accelerometers_feel_thrust_and_drag_only() -> None:
    """Without air: thrust over mass along the nose, once off the rail."""
    flown = flight(NO_AIR)
    for step in (150, 300, 800):
        out = np.empty(3)
        specific_force(flown.states[step], out)
        expected = [flown.thrust_n[step] / flown.mass_kg[step], 0.0, 0.0]
        np.testing.assert_allclose(out, expected, atol=1e-3 * GRAVITY)


def test_process_noise_of_two_steps_is_that_of_one_twice_as_long() -> None:
    dt, F = 0.01, np.eye(15)
    for a in range(3):
        F[a, 3 + a] = F[3 + a, 6 + a] = F[12 + a, 9 + a] = dt
        F[a, 6 + a] = dt * dt / 2
    one, two = process_noise(TUNED, dt), process_noise(TUNED, 2 * dt)
    np.testing.assert_allclose(F @ one @ F.T + one, two, rtol=1e-12, atol=1e-25)
    np.testing.assert_allclose(np.diag(one)[6:9], TUNED.jerk * dt)
    np.testing.assert_allclose(np.diag(one)[9:12], np.array([TUNED.roll, TUNED.across, TUNED.across]) * dt)


def test_densities_of_a_random_walk_are_those_it_was_made_with() -> None:
    made, random = ProcessNoise(30.0, 0.5, 0.01), np.random.default_rng(0)
    sigma = np.sqrt(0.01 * np.array([*[made.jerk] * 3, made.roll, made.across, made.across]))
    states = np.zeros((20_000, 16))
    states[:, 6:12] = np.cumsum(random.normal(0.0, sigma, (20_000, 6)), axis=0)
    np.testing.assert_allclose(densities(states), made, rtol=0.1)


def test_the_filter_is_tuned_to_a_flight() -> None:
    np.testing.assert_allclose(TUNED, densities(flight(ROCKET).states), rtol=0.05)


def test_the_filter_mixes_all_kinds() -> None:
    composed = rocket_filter()
    kinds = {composed.predictor.kind, *(sensor.corrector.kind for sensor in composed.sensors)}
    assert kinds == {"linear", "extended", "unscented"}
    assert rocket_filter("extended").predictor.kind == "extended"
    assert {sensor.dropout for sensor in rocket_filter(dropout=0.5).sensors} == {0.5}
    assert OF.numbers == 16
    assert OF.errors == 15


def test_it_starts_with_an_error_of_the_size_it_knows() -> None:
    truth = flight(ROCKET).states[0]
    x, P = start(truth, 0)
    assert 0.1 < np.abs(x - truth)[:3].max() < 4 * np.sqrt(P[0, 0])
    np.testing.assert_array_equal(x, start(truth, 0)[0])
