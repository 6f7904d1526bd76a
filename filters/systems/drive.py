"""A simulated drive of a cargo vehicle with an inertial unit at 400 Hz and GPS at 10 Hz.

Once around a block at 12 m/s: four turns of 90 degrees, hills, and a body that leans in the turns. The gyros read a few
per cent too much. The unit's own roll and pitch are good, its yaw drifts away by 8 degrees, as with a magnetometer near
iron. Everything is drawn from one seed. The truth is not the filters' model: positions follow from exact velocities.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from filters.arrays import FloatArray
from filters.systems.position import curvature_radii, gravity, write_body_to_ned

RATE_HZ, FIX_EVERY = 400, 40
SPEED = 12.0
START = np.array([np.radians(-22.0075), np.radians(-47.8909), 850.0])
TURNS_AT_S, TURN_S, RAMP_S = (8.0, 31.0, 54.0, 77.0), 14.0, 2.0


class CargoDrive(NamedTuple):
    """What was true at each of steps + 1 instants, and what was measured.

    time_s (steps + 1,). attitude (steps + 1, 3): roll, pitch, yaw (rad), yaw not wrapped. position (steps + 1, 3):
    latitude, longitude (rad), height (m). velocity (steps + 1, 3): north, east, down (m/s).
    gyro (steps, 3): turn rates (rad/s); accelerometer (steps, 3): specific force (m/s^2); both means over the step
    that follows. imu_attitude (steps, 3): roll, pitch, yaw (rad).
    GPS, in steps 0, 40, 80, ...: gps (fixes, 6), position and velocity; gps_yaw (fixes,).
    """

    time_s: FloatArray
    attitude: FloatArray
    position: FloatArray
    velocity: FloatArray
    gyro: FloatArray
    accelerometer: FloatArray
    imu_attitude: FloatArray
    gps: FloatArray
    gps_yaw: FloatArray


def simulate_cargo_drive(
    seconds: float = 100.0, scale_error: float = 0.02, seed: int = 0, accelerometer_error: float = 0.002
) -> CargoDrive:
    """A drive of so many seconds. scale_error: of the gyros, all three read (1 + scale_error) times the rate.
    accelerometer_error: likewise, of the accelerometers.

    The same seed gives the same noise whatever the scale errors.

    Raises:
        ValueError: there is not one whole step, or more than a day.
    """
    steps = round(seconds * RATE_HZ)
    if not 1 <= steps <= 86_400 * RATE_HZ:
        raise ValueError(f"simulate_cargo_drive: seconds={seconds} must be between one step, {1 / RATE_HZ}, and a day")
    random = np.random.default_rng(seed)
    time_s = np.arange(steps + 1) / RATE_HZ
    attitude, velocity = _motion(time_s)
    position = _positions(velocity)
    rates, force = _rates(attitude), _specific_force(attitude, position, velocity)

    gyro_bias = _gauss_markov(random, steps, 0.005, 200.0)
    accelerometer_bias = _gauss_markov(random, steps, 0.05, 300.0)
    gyro = (1 + scale_error) * rates + gyro_bias + random.normal(0.0, 0.0025, (steps, 3))
    accelerometer = (1 + accelerometer_error) * force + accelerometer_bias + random.normal(0.0, 0.02, (steps, 3))
    imu_attitude = attitude[:-1] + random.normal(0.0, 0.005, (steps, 3))
    imu_attitude[:, 2] = wrap(imu_attitude[:, 2] + np.radians(8.0) * (time_s[:-1] / 100.0) ** 2)

    fixes = slice(0, steps, FIX_EVERY)
    metres = random.normal(0.0, 1.0, (len(time_s[fixes]), 3)) * [0.5, 0.5, 1.0]
    speeds = random.normal(0.0, 0.05, metres.shape)
    gps_position = position[fixes] + metres_to_position(metres)
    gps_yaw = wrap(attitude[fixes, 2] + random.normal(0.0, np.radians(0.3), len(metres)))
    gps = np.hstack([gps_position, velocity[fixes] + speeds])
    return CargoDrive(time_s, attitude, position, velocity, gyro, accelerometer, imu_attitude, gps, gps_yaw)


def held_yaw(drive: CargoDrive, available: NDArray[np.bool_] | None = None) -> FloatArray:
    """The unit's yaw in each step (steps,), corrected by its difference from GPS in the last fix: rad, (-pi, pi].

    available (fixes,): false where a fix is missing; the correction before it is then held on, or 0 if there is none.
    """
    yaw = drive.imu_attitude[:, 2]
    difference = wrap(drive.gps_yaw - yaw[::FIX_EVERY])
    if available is not None:
        last = np.maximum.accumulate(np.where(available, np.arange(len(available)), -1))
        difference = np.where(last >= 0, difference[np.maximum(last, 0)], 0.0)
    return wrap(yaw + np.repeat(difference, FIX_EVERY)[: len(yaw)])


def metres_to_position(metres: FloatArray) -> FloatArray:
    """Changes of latitude, longitude (rad) and height near the start, from metres north, east, down (any, 3)."""
    return metres / _metres_per_unit()


def position_to_metres(change: FloatArray) -> FloatArray:
    """The inverse of `metres_to_position`."""
    return change * _metres_per_unit()


def wrap(angles: FloatArray) -> FloatArray:
    """The same angles in (-pi, pi]."""
    wrapped: FloatArray = np.pi - (np.pi - angles) % (2 * np.pi)
    return wrapped


def _metres_per_unit() -> FloatArray:
    meridian, transverse = curvature_radii(START[0])
    return np.array([meridian + START[2], (transverse + START[2]) * np.cos(START[0]), -1.0])


def _motion(time_s: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Attitude and velocity. The turn rate goes up in a straight line, stays, and goes down again."""
    corners_s = np.add.outer(TURNS_AT_S, [0.0, RAMP_S, TURN_S - RAMP_S, TURN_S])
    turn_rate = np.pi / 2 / (TURN_S - RAMP_S)
    yaw_rate = np.interp(time_s, corners_s.ravel(), np.tile([0.0, turn_rate, turn_rate, 0.0], len(corners_s)))
    yaw = 0.5 + _accumulated((yaw_rate[1:] + yaw_rate[:-1]) / (2 * RATE_HZ))
    pitch = 0.03 * np.sin(2 * np.pi * time_s / 50)
    roll = -0.012 * SPEED * yaw_rate + 0.01 * np.sin(2 * np.pi * time_s / 7)
    velocity = SPEED * np.stack([np.cos(pitch) * np.cos(yaw), np.cos(pitch) * np.sin(yaw), -np.sin(pitch)], axis=1)
    return np.stack([roll, pitch, yaw], axis=1), velocity


def _positions(velocity: FloatArray) -> FloatArray:
    """By the trapezoidal rule. The radii are those of a latitude found with the radii at the start."""
    north, east, down = (velocity[1:] + velocity[:-1]).T / (2 * RATE_HZ)
    height = START[2] - _accumulated(down)
    nearly = START[0] + _accumulated(north / (curvature_radii(START[0])[0] + height[:-1]))
    meridian, transverse = curvature_radii(nearly[:-1])
    latitude = START[0] + _accumulated(north / (meridian + height[:-1]))
    longitude = START[1] + _accumulated(east / ((transverse + height[:-1]) * np.cos(latitude[:-1])))
    return np.stack([latitude, longitude, height], axis=1)


def _accumulated(steps: FloatArray) -> FloatArray:
    """Sums of none, the first, the first two, ..."""
    return np.concatenate([[0.0], np.cumsum(steps)])


def _rates(attitude: FloatArray) -> FloatArray:
    """Mean body rates of each step: T^-1 times the change of the angles, T at its middle."""
    roll, pitch, _ = (attitude[1:] + attitude[:-1]).T / 2
    roll_rate, pitch_rate, yaw_rate = np.diff(attitude, axis=0).T * RATE_HZ
    across = np.cos(pitch) * yaw_rate
    rates = [
        roll_rate - np.sin(pitch) * yaw_rate,
        np.cos(roll) * pitch_rate + np.sin(roll) * across,
        np.cos(roll) * across - np.sin(roll) * pitch_rate,
    ]
    return np.stack(rates, axis=1)


def _specific_force(attitude: FloatArray, position: FloatArray, velocity: FloatArray) -> FloatArray:
    """Mean of each step in the body axes of its middle."""
    acceleration = np.diff(velocity, axis=0) * RATE_HZ
    acceleration[:, 2] -= gravity(position[:-1, 0], position[:-1, 2])
    C = np.empty((3, 3, len(acceleration)))
    roll, pitch, yaw = (attitude[1:] + attitude[:-1]).T / 2
    write_body_to_ned(1.0, roll, pitch, yaw, C)
    force: FloatArray = np.einsum("ijt,ti->tj", C, acceleration)
    return force


def _gauss_markov(random: np.random.Generator, steps: int, sigma: float, correlation_s: float) -> FloatArray:
    decay = np.exp(-1 / (RATE_HZ * correlation_s))
    noise = random.normal(0.0, sigma * np.sqrt(1 - decay**2), (steps, 3))
    noise[0] = random.normal(0.0, sigma, 3)
    left = decay ** np.arange(steps)[:, np.newaxis]
    bias: FloatArray = left * np.cumsum(noise / left, axis=0)
    return bias
