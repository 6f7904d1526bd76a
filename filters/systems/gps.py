"""Satellite navigation with eight states, four process-noise sources and four satellites: the patent's example.

State: position east, north, up of a fixed point on the ground (m), velocity (m/s), clock bias (m) and clock drift
(m/s). White noise drives the three accelerations and the clock drift. Measurement: four pseudoranges, each less the
range from the fixed point (m), linear in the state to within |position|^2 / 40,000 km. Satellites move on circular
orbits, so H changes with time; it is computed outside the filter. There are no inputs. Products are dense unless its
structure is stated: the zeros of Phi and H are multiplied too, as the patent's operation counts assume.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.kernels.dense import matvec
from filters.simulation import Truth, simulate_truth
from filters.sparse.structure import Structure
from filters.system import System
from filters.systems.coarse import CoarseNoise

POSITION, VELOCITY, CLOCK_BIAS, CLOCK_DRIFT = slice(0, 3), slice(3, 6), 6, 7

STRUCTURE = Structure(
    F=("100*0000", "0100*000", "00100*00", "00010000", "00001000", "00000100", "0000001*", "00000001"),
    H=("***00010",) * 4,
    Q=("*00*0000", "0*00*000", "00*00*00", "*00*0000", "0*00*000", "00*00*00", "000000**", "000000**"),
    R=("*000", "0*00", "00*0", "000*"),
)
"""Of the receiver's model, to be stated where its zeros are to be left out: gps()._replace(structure=STRUCTURE)."""

ORBIT_RADIUS_M = 26_560e3
EARTH_RADIUS_M = 6_371e3
SIDEREAL_DAY_S = 86_164.1
INCLINATION = np.radians(55.0)
LATITUDE = np.radians(45.0)
NODES_AND_ARGUMENTS = np.radians([[215.0, 111.0], [35.0, 66.0], [155.0, 96.0], [155.0, 186.0]])
"""Longitude of the ascending node, from the fixed point's, and argument of latitude of each satellite at step 0.

From 24 satellites in 6 planes, the four that stay above 10 degrees for half an hour with the least dilution of
precision (PDOP): one at 70 degrees elevation, three around it at 14 to 24 degrees.
"""


class GpsParameters(NamedTuple):
    """Phi (8, 8) and Q (8, 8) of one step, R (4, 4).

    H (steps + 1, 4, 8) and satellites_m (steps + 1, 4, 3), their places as seen from the fixed point: of every
    measurement, first index its step, modulo their number.
    """

    Phi: FloatArray
    Q: FloatArray
    H: FloatArray
    R: FloatArray
    satellites_m: FloatArray


class Flight(NamedTuple):
    """A simulated flight. x0 (8,), P0 (8, 8): what the filter starts from. inputs (steps, 0)."""

    system: System
    x0: FloatArray
    P0: FloatArray
    inputs: FloatArray
    truth: Truth


def gps(
    period_s: float = 1.0,
    steps: int = 600,
    acceleration_noise: float = 0.05,
    clock_noise: float = 0.05,
    range_sigma_m: float = 5.0,
) -> System:
    """The receiver's model, four pseudoranges every `period_s`.

    acceleration_noise, clock_noise (m/s^2/sqrt(Hz)): white noise of each acceleration, and of the clock drift's rate.

    Raises:
        ValueError: the period or sigma is not positive, or steps is less than 0.
    """
    if period_s <= 0 or range_sigma_m <= 0 or steps < 0:
        raise ValueError(
            f"gps: period_s={period_s} and range_sigma_m={range_sigma_m} must be positive, steps={steps} at least 0"
        )
    Phi, Q = _process(period_s, acceleration_noise, clock_noise)
    satellites_m = _satellites(np.arange(steps + 1.0) * period_s)
    H = np.zeros((steps + 1, 4, 8))
    H[:, :, POSITION] = -satellites_m / _norm(satellites_m)[..., np.newaxis]
    H[:, :, CLOCK_BIAS] = 1.0
    return System(8, 0, 4, _f, _F, _Q, _h, _H, _R, GpsParameters(Phi, Q, H, range_sigma_m**2 * np.eye(4), satellites_m))


def gps_coarse(
    n: int,
    period_s: float = 1.0,
    steps: int = 600,
    acceleration_noise: float = 0.05,
    clock_noise: float = 0.05,
    range_sigma_m: float = 5.0,
    noise: CoarseNoise = "averaged",
) -> System:
    """The model of `gps` over n periods, for covariances that are computed every n-th step. H is that of each step.

    noise: whether a measurement stands for the mean of n ("averaged": R / n) or is one of them ("sampled": R); see
        `coarse.over`.

    Raises:
        ValueError: n is less than 1, or as in `gps`.
    """
    if n < 1:
        raise ValueError(f"gps_coarse: n={n} must be at least 1: it is the number of periods in a step of this model")
    fine = gps(period_s, steps, acceleration_noise, clock_noise, range_sigma_m)
    Phi, Q = _process(n * period_s, acceleration_noise, clock_noise)
    R = fine.parameters.R / n if noise == "averaged" else fine.parameters.R
    return fine._replace(parameters=fine.parameters._replace(Phi=Phi, Q=Q, R=R))


def gps_start() -> FloatArray:
    """P0 (8, 8) of a receiver that was told where it is: 100 m, 10 m/s, 300 m (a microsecond) and 10 m/s."""
    return np.diag([100.0] * 3 + [10.0] * 3 + [300.0, 10.0]) ** 2


def simulate_flight(system: System, steps: int, seed: int) -> Flight:
    """A flight from rest with measurements from true ranges, not from the linear model; `system` is a `gps`."""
    x0, P0, inputs = np.zeros(8), gps_start(), np.zeros((steps, 0))
    truth = simulate_truth(system, 1, x0, P0, inputs, seed)
    for k, (x, y) in enumerate(zip(truth.x, truth.measurements, strict=True)):
        linear = np.empty(4)
        system.h(k, x, system.parameters, linear)
        y += pseudoranges(system, k, x) - linear
    return Flight(system, x0, P0, inputs, truth)


def pseudoranges(system: System, k: int, x: FloatArray) -> FloatArray:
    """The four pseudoranges (m) of step k at the state x (8,), each less the range from the fixed point, no noise."""
    satellites_m = system.parameters.satellites_m[k % len(system.parameters.satellites_m)]
    ranges_m: FloatArray = _norm(satellites_m - x[POSITION]) - _norm(satellites_m) + x[CLOCK_BIAS]
    return ranges_m


def motion(acceleration_noise: float = 0.05, clock_noise: float = 0.05) -> tuple[FloatArray, FloatArray]:
    """dx/dt = A x + w: A (8, 8), and the spectral density (8, 8) of the white noise w. Arguments as of `gps`."""
    A, Gamma = np.zeros((8, 8)), np.zeros((8, 4))
    A[POSITION, VELOCITY] = Gamma[VELOCITY, :3] = np.eye(3)
    A[CLOCK_BIAS, CLOCK_DRIFT] = Gamma[CLOCK_DRIFT, 3] = 1.0
    return A, Gamma @ np.diag([acceleration_noise**2] * 3 + [clock_noise**2]) @ Gamma.T


def _process(interval_s: float, acceleration_noise: float, clock_noise: float) -> tuple[FloatArray, FloatArray]:
    """Phi and Q of `motion` over an interval, exactly: A^2 = 0, so exp(A t) = I + A t."""
    A, density = motion(acceleration_noise, clock_noise)
    T = interval_s
    Q = density * T + (A @ density + density @ A.T) * (T**2 / 2) + A @ density @ A.T * (T**3 / 3)
    return np.eye(8) + A * T, Q


def _satellites(time_s: FloatArray) -> FloatArray:
    """Places (times, 4, 3) east, north, up of the fixed point, m."""
    nodes, arguments = NODES_AND_ARGUMENTS.T
    angle = arguments + (4 * np.pi / SIDEREAL_DAY_S) * time_s[:, np.newaxis]
    longitude = nodes - (2 * np.pi / SIDEREAL_DAY_S) * time_s[:, np.newaxis]
    along, across = np.cos(angle), np.sin(angle) * np.cos(INCLINATION)
    places = ORBIT_RADIUS_M * np.stack(
        [
            np.cos(longitude) * along - np.sin(longitude) * across,
            np.sin(longitude) * along + np.cos(longitude) * across,
            np.sin(angle) * np.sin(INCLINATION),
        ],
        axis=-1,
    )
    sine, cosine = np.sin(LATITUDE), np.cos(LATITUDE)
    east_north_up = np.array([[0.0, 1.0, 0.0], [-sine, 0.0, cosine], [cosine, 0.0, sine]])
    seen: FloatArray = places @ east_north_up.T - np.array([0.0, 0.0, EARTH_RADIUS_M])
    return seen


def _norm(vectors: FloatArray) -> FloatArray:
    length: FloatArray = np.sqrt(np.sum(vectors**2, axis=-1))
    return length


def _f(_j: int, x: FloatArray, _u: FloatArray, parameters: GpsParameters, out: FloatArray) -> None:
    matvec(parameters.Phi, x, out)


def _F(_j: int, _x: FloatArray, _u: FloatArray, parameters: GpsParameters) -> FloatArray:
    return parameters.Phi


def _Q(_j: int, parameters: GpsParameters) -> FloatArray:
    return parameters.Q


def _h(k: int, x: FloatArray, parameters: GpsParameters, out: FloatArray) -> None:
    matvec(parameters.H[k % len(parameters.H)], x, out)


def _H(k: int, _x: FloatArray, parameters: GpsParameters) -> FloatArray:
    H: FloatArray = parameters.H[k % len(parameters.H)]
    return H


def _R(_k: int, parameters: GpsParameters) -> FloatArray:
    return parameters.R
