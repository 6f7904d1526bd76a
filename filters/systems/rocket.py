"""A simulated flight of a sounding rocket: on the rail, through powered ascent and coast, to apogee.

Six degrees of freedom, a mass that falls, a thrust curve, drag, fins that turn the nose into the wind and make it roll,
gusts. Everything is drawn from one seed. The truth is no filter's model: it is forces, moments and fine steps (RK4).

The rocket is of the size that student teams fly to 3 km. Aerodynamics are those of small angles of attack (Barrowman,
The practical calculation of the aerodynamic characteristics of slender finned vehicles, 1967), air is the International
Standard Atmosphere's, the Earth flat and at rest. World: east, north, up from the pad. Body: x through the nose.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.systems.rocket_motion import Airframe, integrate

RATE_HZ, FINE_STEPS = 100, 4
"""States per second, and steps of the integration between two of them."""

PAD_S, LONGEST_S = 1.0, 60.0
"""Time on the pad before ignition, and the time after which a flight that has not reached apogee is given up."""

THRUST_AT_S = np.array([0.0, 0.05, 0.3, 3.2, 3.5])
THRUST_SHAPE = np.array([0.0, 1.1, 1.15, 0.85, 0.0])
"""A solid motor's curve: up in 50 ms, falling slowly, out in 300 ms. Scaled to the impulse of the propellant."""

BURN_S = float(THRUST_AT_S[-1])


class Rocket(NamedTuple):
    """Masses in kg, exhaust_speed in m/s; elevation and heading (from east to north) of the rail in degrees.

    wind, wind_from: mean wind at 10 m in m/s, and where it blows to, degrees from east to north; it grows with height
    to the power 1/7. gusts: their standard deviation east and north, m/s, correlated over 0.5 s.
    """

    airframe: Airframe = Airframe()
    dry_mass: float = 17.65
    propellant: float = 3.35
    exhaust_speed: float = 1912.0
    elevation: float = 85.0
    heading: float = 60.0
    wind: float = 4.0
    wind_to: float = 200.0
    gusts: float = 1.0


class Flight(NamedTuple):
    """What was true at each of steps + 1 instants, from 1 s before ignition to apogee.

    time_s (steps + 1,): since ignition. states (steps + 1, 16): position (m), velocity (m/s) and acceleration (m/s^2)
    in the world, turn rate in the body (rad/s), attitude (quaternion, scalar first, body to world). mass_kg, thrust_n
    (steps + 1,).
    """

    time_s: FloatArray
    states: FloatArray
    mass_kg: FloatArray
    thrust_n: FloatArray


def random_rocket(seed: int) -> Rocket:
    """One of the many rockets that could be on the pad: motor, drag, fins, rail and wind are not known exactly."""
    random = np.random.default_rng(seed)
    usual, frame = Rocket(), Airframe()
    return Rocket(
        airframe=frame._replace(drag=frame.drag * random.normal(1.0, 0.05), cant=frame.cant * random.uniform(0.5, 1.5)),
        exhaust_speed=usual.exhaust_speed * random.normal(1.0, 0.02),
        elevation=random.uniform(82.0, 88.0),
        heading=random.uniform(0.0, 360.0),
        wind=random.uniform(0.0, 8.0),
        wind_to=random.uniform(0.0, 360.0),
        gusts=random.uniform(0.5, 1.5),
    )


def simulate_flight(rocket: Rocket, seed: int = 0, *, backend: BackendName = "reference") -> Flight:
    """A flight of this rocket; seed: of the gusts. Half a second, compiled a hundredth of it.

    Raises:
        ValueError: it does not leave the pad, or does not reach apogee in 60 s.
    """
    steps, halves = round(LONGEST_S * RATE_HZ), 2 * FINE_STEPS
    half_s = np.arange(steps * halves + 1) / (RATE_HZ * halves) - PAD_S
    thrust, mass = burn(rocket, half_s)
    weight = mass[0] * rocket.airframe.gravity
    if thrust.max() <= weight:
        raise ValueError(
            f"simulate_flight: {rocket} does not leave the pad: it weighs {weight:.0f} N, its thrust is "
            f"{thrust.max():.0f} N at most; give it less mass or more exhaust speed"
        )
    y = np.zeros((steps + 1, 13))
    y[0, 9:13] = rail_attitude(rocket)
    acceleration = np.zeros((steps + 1, 3))
    last = function_for(backend, integrate)(
        arguments_for(backend, rocket.airframe), 1.0 / (RATE_HZ * FINE_STEPS), thrust, mass, _wind(rocket, steps, seed),
        y, acceleration,
    )  # fmt: skip
    if last == steps:
        raise ValueError(f"simulate_flight: {rocket} does not reach apogee in {LONGEST_S:.0f} s")
    kept = slice(0, last + 1)
    states = np.hstack([y[kept, :6], acceleration[kept], y[kept, 6:]])
    return Flight(half_s[::halves][kept], states, mass[::halves][kept], thrust[::halves][kept])


def burn(rocket: Rocket, time_s: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Thrust (N) and mass (kg) at times since ignition. Thrust = exhaust speed times what the mass falls by, per s."""
    impulse = np.concatenate(
        [[0.0], np.cumsum(np.diff(THRUST_AT_S) * (THRUST_SHAPE[1:] + THRUST_SHAPE[:-1]) / 2)]
    )  # of the shape, up to each of its corners
    level = rocket.propellant * rocket.exhaust_speed / impulse[-1]
    shape = np.interp(time_s, THRUST_AT_S, THRUST_SHAPE)
    corner = np.clip(np.searchsorted(THRUST_AT_S, time_s, side="right") - 1, 0, len(THRUST_AT_S) - 1)
    within = np.clip(time_s, 0.0, BURN_S) - THRUST_AT_S[corner]
    so_far = impulse[corner] + within * (THRUST_SHAPE[corner] + shape) / 2
    return level * shape, rocket.dry_mass + rocket.propellant - level * so_far / rocket.exhaust_speed


def rail_attitude(rocket: Rocket) -> FloatArray:
    """The quaternion (4,) that points the body's x along the rail: raised by the elevation, then turned to the heading.

    Raised is a rotation about -y, turned one about z.
    """
    raised, turned = np.radians(rocket.elevation) / 2, np.radians(rocket.heading) / 2
    c, s = np.cos(raised), np.sin(raised)
    return np.array([np.cos(turned) * c, np.sin(turned) * s, -np.cos(turned) * s, np.sin(turned) * c])


def _wind(rocket: Rocket, steps: int, seed: int) -> FloatArray:
    """Gusts and mean wind at 10 m, (steps + 1, 4): east, north of the mean, east, north of the gust."""
    random = np.random.default_rng([seed, 1])
    kept = np.exp(-1.0 / (RATE_HZ * 0.5))
    pushes = rocket.gusts * random.normal(0.0, 1.0, (steps + 1, 2))
    gusts = np.empty((steps + 1, 2))
    gusts[0] = pushes[0]
    for j in range(steps):
        gusts[j + 1] = kept * gusts[j] + np.sqrt(1.0 - kept**2) * pushes[j + 1]
    to = np.radians(rocket.wind_to)
    mean = np.tile(rocket.wind * np.array([np.cos(to), np.sin(to)]), (steps + 1, 1))
    return np.hstack([mean, gusts])
