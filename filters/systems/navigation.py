"""A small nonlinear example: a vehicle in the plane with gyro, accelerometer and a delayed position fix.

State: position east and north (m), heading (rad, from east to north), speed (m/s), gyro bias (rad/s), accelerometer
bias (m/s^2). Inputs at the high rate: measured turn rate (rad/s) and forward acceleration (m/s^2). Measurement at the
low rate: position east and north (m). The speed must not be near zero for long: heading is seen only in motion.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.simulation import Truth, simulate_truth
from filters.sparse.structure import Structure
from filters.system import System

EAST, NORTH, HEADING, SPEED, GYRO_BIAS, ACCELEROMETER_BIAS = range(6)

STRUCTURE = Structure(
    F=("10**00", "01**00", "0010*0", "00010*", "000010", "000001"),
    H=("100000", "010000"),
    Q=("000000", "000000", "00*000", "000*00", "0000*0", "00000*"),
    R=("*0", "0*"),
)
"""Of the vehicle's model, to be stated where its zeros are to be left out: vehicle()._replace(structure=STRUCTURE)."""


class VehicleParameters(NamedTuple):
    """period_s: the high-rate period. Q (6, 6): process noise of one period. H (2, 6), R (2, 2): of the fix."""

    period_s: float
    Q: FloatArray
    H: FloatArray
    R: FloatArray


class Drive(NamedTuple):
    """A simulated drive. x0 (6,), P0 (6, 6): what the filter starts from. inputs (steps, 2): what sensors said."""

    system: System
    x0: FloatArray
    P0: FloatArray
    inputs: FloatArray
    truth: Truth


def vehicle(
    period_s: float = 0.01,
    gyro_noise: float = 1e-3,
    accelerometer_noise: float = 0.02,
    gyro_drift: float = 1e-5,
    accelerometer_drift: float = 1e-4,
    fix_sigma_m: float = 1.0,
) -> System:
    """The vehicle's model.

    gyro_noise (rad/s/sqrt(Hz)), accelerometer_noise (m/s^2/sqrt(Hz)): white noise of the inputs.
    gyro_drift (rad/s^2/sqrt(Hz)), accelerometer_drift (m/s^3/sqrt(Hz)): random walks of the biases.
    """
    densities = np.array([0.0, 0.0, gyro_noise, accelerometer_noise, gyro_drift, accelerometer_drift])
    H = np.zeros((2, 6))
    H[0, EAST] = H[1, NORTH] = 1.0
    parameters = VehicleParameters(period_s, np.diag(densities**2 * period_s), H, fix_sigma_m**2 * np.eye(2))
    return System(6, 2, 2, _f, _F, _Q, _h, _H, _R, parameters)


def simulate_drive(steps: int, N: int, seed: int, system: System | None = None) -> Drive:
    """A winding drive at about 15 m/s with a fix every N steps; `system` is a `vehicle`, the default one if None."""
    system = system or vehicle()
    time_s = np.arange(steps) * system.parameters.period_s
    inputs = np.column_stack([0.3 * np.sin(0.4 * time_s), 0.8 * np.cos(0.25 * time_s)])
    x0 = np.array([0.0, 0.0, 0.5, 15.0, 0.0, 0.0])
    P0 = np.diag([2.0, 2.0, 0.05, 0.5, 0.005, 0.05]) ** 2
    return Drive(system, x0, P0, inputs, simulate_truth(system, N, x0, P0, inputs, seed))


def _f(_j: int, x: FloatArray, u: FloatArray, parameters: VehicleParameters, out: FloatArray) -> None:
    period = parameters.period_s
    out[EAST] = x[EAST] + period * x[SPEED] * np.cos(x[HEADING])
    out[NORTH] = x[NORTH] + period * x[SPEED] * np.sin(x[HEADING])
    out[HEADING] = x[HEADING] + period * (u[0] - x[GYRO_BIAS])
    out[SPEED] = x[SPEED] + period * (u[1] - x[ACCELEROMETER_BIAS])
    out[GYRO_BIAS] = x[GYRO_BIAS]
    out[ACCELEROMETER_BIAS] = x[ACCELEROMETER_BIAS]


def _F(_j: int, x: FloatArray, _u: FloatArray, parameters: VehicleParameters) -> FloatArray:
    period, cosine, sine = parameters.period_s, np.cos(x[HEADING]), np.sin(x[HEADING])
    Phi = np.eye(6)
    Phi[EAST, HEADING] = -period * x[SPEED] * sine
    Phi[EAST, SPEED] = period * cosine
    Phi[NORTH, HEADING] = period * x[SPEED] * cosine
    Phi[NORTH, SPEED] = period * sine
    Phi[HEADING, GYRO_BIAS] = -period
    Phi[SPEED, ACCELEROMETER_BIAS] = -period
    return Phi


def _Q(_j: int, parameters: VehicleParameters) -> FloatArray:
    return parameters.Q


def _h(_k: int, x: FloatArray, _parameters: VehicleParameters, out: FloatArray) -> None:
    out[0] = x[EAST]
    out[1] = x[NORTH]


def _H(_k: int, _x: FloatArray, parameters: VehicleParameters) -> FloatArray:
    return parameters.H


def _R(_k: int, parameters: VehicleParameters) -> FloatArray:
    return parameters.R
