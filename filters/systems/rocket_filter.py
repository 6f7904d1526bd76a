"""A filter for a rocket's flight that knows neither its mass nor its thrust, nor anything else of the rocket.

Acceleration is taken to be constant but for white jerk, the turn rate but for white angular acceleration; the attitude
is turned by the rate. Five sensors, each with its own rate and delay, linear, extended and unscented. After MacCormack
and Rubinstein, Implementation of a modular linear and unscented Kalman filter: the same state, and their claim.

State: position (m), velocity (m/s), acceleration (m/s^2) in the world, turn rate in the body (rad/s), attitude as a
quaternion, body to world: 16 numbers, of which the error has 15.
"""

from __future__ import annotations

from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from filters.arrays import FloatArray
from filters.kernels.quaternion import rotate_back, turn
from filters.modular import (
    ModularFilter,
    Sensor,
    extended_corrector,
    extended_predictor,
    linear_corrector,
    space,
    unscented_corrector,
    unscented_predictor,
)
from filters.modular.space import plus
from filters.systems.rocket import RATE_HZ
from filters.systems.spring_mass import white_jerk

PredictorName: TypeAlias = Literal["unscented", "extended"]

OF = space(16, attitudes=[12])
ATTITUDE = space(4, attitudes=[0])
GRAVITY = 9.80665
"""What the filter subtracts at any height; that of the simulated flight falls by 0.08 % to 2.6 km."""

GPS, BAROMETER, GYRO, ACCELEROMETER, CAMERA = SENSORS = ("GPS", "barometer", "gyro", "accelerometer", "camera")


class ProcessNoise(NamedTuple):
    """Spectral densities: jerk of each axis of the world, (m/s^3)^2/Hz; angular acceleration about the nose (roll) and
    across it (pitch, yaw), (rad/s^2)^2/Hz."""

    jerk: float
    roll: float
    across: float


TUNED = ProcessNoise(jerk=140.0, roll=0.048, across=0.0082)
"""Those of the flight of `Rocket()` by `densities`, to two digits. It is none of the flights that the study draws."""

BRIDGED_S = 0.1


def densities(states: FloatArray) -> ProcessNoise:
    """The noise with the mean square changes over 0.1 s, of acceleration and turn rate, of a true flight (steps, 16).

    Over the whole flight: thrust onset, burnout, and the long time between and after. Over 0.1 s, for this is how long
    GPS leaves the filter alone. True rates turn back less often than a random walk: changes over one step give a fifth
    of the jerk and a tenth of the rest, and with these the NEES of the turn rate was 9 in powered flight, not 3.
    """
    steps = round(BRIDGED_S * RATE_HZ)
    squared = np.mean((states[steps:, 6:12] - states[:-steps, 6:12]) ** 2, axis=0) / BRIDGED_S
    return ProcessNoise(float(squared[:3].mean()), float(squared[3]), float(squared[4:].mean()))


def process_noise(noise: ProcessNoise, dt: float) -> FloatArray:
    """Q (15, 15) of one step: white jerk, and white angular acceleration where the attitude turns little in a step."""
    Q = np.zeros((15, 15))
    jerk = white_jerk(dt, np.sqrt(noise.jerk))
    angular = [[dt, dt**2 / 2], [dt**2 / 2, dt**3 / 3]]
    for axis, density in enumerate((noise.roll, noise.across, noise.across)):
        Q[axis:9:3, axis:9:3] = jerk
        Q[9 + axis :: 3, 9 + axis :: 3] = density * np.array(angular)
    return Q


def move(x: FloatArray, _u: FloatArray, dt: float, out: FloatArray) -> None:
    """The state a time dt on."""
    for a in range(3):
        out[a] = x[a] + dt * x[3 + a] + 0.5 * dt * dt * x[6 + a]
        out[3 + a] = x[3 + a] + dt * x[6 + a]
        out[6 + a] = x[6 + a]
        out[9 + a] = dt * x[9 + a]  # the rotation in dt, until it is used
    turn(x, 12, out, 9, out)
    for a in range(3):
        out[9 + a] = x[9 + a]


def specific_force(x: FloatArray, out: FloatArray) -> None:
    """What accelerometers feel (3,): acceleration less gravity, in the body."""
    out[0] = x[6]
    out[1] = x[7]
    out[2] = x[8] + GRAVITY
    rotate_back(x, 12, out, 0, out)


def attitude(x: FloatArray, out: FloatArray) -> None:
    """The quaternion (4,)."""
    for a in range(4):
        out[a] = x[12 + a]


def sensors(dropout: float = 0.0) -> tuple[Sensor, ...]:
    """GPS: 10 Hz, 100 ms late. Barometer: 25 Hz, 40 ms. Inertial unit: 100 Hz. Attitude, by camera: 10 Hz, 50 ms.

    dropout: the probability that a measurement is lost, for all sensors.
    """
    position_velocity, height, rate = np.eye(6, 15), np.eye(15)[[2]], np.eye(15)[9:12]
    gps = linear_corrector(position_velocity, np.diag([1.5, 1.5, 3.0, 0.1, 0.1, 0.2]) ** 2)
    barometer = linear_corrector(height, [[2.0**2]])
    gyro = linear_corrector(rate, 0.005**2 * np.eye(3))
    accelerometer = extended_corrector(specific_force, 0.3**2 * np.eye(3))
    camera = unscented_corrector(attitude, np.radians(1.0) ** 2 * np.eye(3), observed=ATTITUDE)
    return (
        Sensor(GPS, gps, every=10, delay=10, dropout=dropout),
        Sensor(BAROMETER, barometer, every=4, delay=4, dropout=dropout),
        Sensor(GYRO, gyro, dropout=dropout),
        Sensor(ACCELEROMETER, accelerometer, dropout=dropout),
        Sensor(CAMERA, camera, every=10, delay=5, dropout=dropout),
    )


def rocket_filter(
    predictor: PredictorName = "unscented", dropout: float = 0.0, noise: ProcessNoise = TUNED
) -> ModularFilter:
    """The filter of all five sensors. dropout: the probability that a measurement of any of them is lost."""
    dt = 1.0 / RATE_HZ
    Q = process_noise(noise, dt)
    predict = unscented_predictor(move, Q) if predictor == "unscented" else extended_predictor(move, Q)
    return ModularFilter(predict, sensors(dropout), dt, OF)


START_SIGMAS = np.concatenate(
    [np.full(3, 2.0), np.full(3, 0.1), np.full(3, 0.1), np.full(3, 0.01), np.full(3, np.radians(2.0))]
)
"""Standard deviations of the errors on the pad."""


def start(truth: FloatArray, seed: int) -> tuple[FloatArray, FloatArray]:
    """An estimate (16,) for a true state (16,), wrong by a draw from the covariance (15, 15) that is returned too."""
    x = np.empty(OF.numbers)
    plus(OF, truth, np.random.default_rng([seed, 2]).normal(0.0, START_SIGMAS), x)
    return x, np.diag(START_SIGMAS**2)
