"""Position and velocity from accelerometers, with their biases: Eqs. (18) to (25) of "Computation of Extended Robust
Kalman Filter for Real-Time Attitude and Position Estimation" (arXiv:1801.04386), whose printed formulas are lost; after
Farrell (2008). Coriolis and transport rate are left out: less than 2e-3 m/s^2 on a road.

State: latitude, longitude (rad), height (m), velocity north, east, down (m/s) and the biases of three accelerometers
(m/s^2), Gauss-Markov processes. Input: the measured specific force in body axes (m/s^2), then roll, pitch, yaw (rad).
Noise: of the accelerometers and of their biases. Measurement: the first six states, by GPS.
"""

from __future__ import annotations

from typing import Any, Literal, NamedTuple, TypeAlias, get_args

import numpy as np

from filters.arrays import FloatArray
from filters.choice import check_choice
from filters.robust.uncertain import Scaling, UncertainSystem, Uncertainty, no_uncertainty
from filters.systems.attitude import wrapped

LATITUDE, LONGITUDE, HEIGHT, NORTH, EAST, DOWN, ACCELEROMETER_BIAS = 0, 1, 2, 3, 4, 5, slice(6, 9)

EQUATOR_RADIUS_M = 6_378_137.0
ECCENTRICITY_SQUARED = 6.69437999014e-3

Number: TypeAlias = float | FloatArray

PositionRows: TypeAlias = Literal["none", "accelerometer", "bias"]
POSITION_ROWS: tuple[PositionRows, ...] = get_args(PositionRows)

POLE = (
    "position: latitude is within 0.006 degrees of a pole, where longitude, north and east are not defined; "
    "work in a local frame there, such as metres from a fixed point"
)


class PositionParameters(NamedTuple):
    """period_s: of one step. decay: exp(-period / correlation time), by which a bias shrinks in one step."""

    period_s: float
    decay: float


def position(
    latitude: float,
    height_m: float,
    period_s: float = 1 / 400,
    correlation_s: float = 300.0,
    accelerometer_sigma: float = 0.02,
    bias_sigma: float = 0.05,
    horizontal_sigma_m: float = 0.5,
    vertical_sigma_m: float = 1.0,
    velocity_sigma: float = 0.05,
) -> UncertainSystem:
    """The model near a latitude (rad) and height, which only turn the metres of a fix into radians.

    accelerometer_sigma, bias_sigma (m/s^2): of one sample, and of the bias as a stationary process. velocity_sigma
    (m/s), horizontal_sigma_m, vertical_sigma_m: of a fix.

    Raises:
        ValueError: a period, correlation time or sigma is not positive, or the latitude is that of a pole.
    """
    sigmas = (accelerometer_sigma, bias_sigma, horizontal_sigma_m, vertical_sigma_m, velocity_sigma)
    if min(period_s, correlation_s, *sigmas) <= 0:
        raise ValueError(
            f"position: period_s={period_s}, correlation_s={correlation_s}, accelerometer_sigma, bias_sigma, "
            f"horizontal_sigma_m, vertical_sigma_m and velocity_sigma={sigmas} must all be positive"
        )
    decay = float(np.exp(-period_s / correlation_s))
    Q = np.diag([accelerometer_sigma**2] * 3 + [bias_sigma**2 * (1 - decay**2)] * 3)
    radians = horizontal_sigma_m * radians_per_metre(latitude, height_m)
    R = np.diag([*radians, vertical_sigma_m] + [velocity_sigma] * 3) ** 2
    return UncertainSystem(_f, _F, _G, _residual, np.eye(6, 9), Q, R, PositionParameters(period_s, decay))


def position_scaling(latitude: float, longitude: float, height_m: float) -> Scaling:
    """Positions in metres from this one, velocities in m/s, biases in tenths of a m/s^2.

    Raises:
        ValueError: the latitude is that of a pole.
    """
    origin = np.array([latitude, longitude, height_m] + [0.0] * 6)
    unit = np.array([*radians_per_metre(latitude, height_m), 1.0, 1.0, 1.0, 1.0, 0.1, 0.1, 0.1])
    return Scaling(origin, unit, unit[:6].copy())


def position_uncertainty(
    rows: PositionRows, scale_error: float = 0.005, period_s: float = 1 / 400, correlation_s: float = 300.0
) -> Uncertainty:
    """`attitude_uncertainty` for the scale of the accelerometers or for their biases; none in the measurement.

    Raises:
        ValueError: rows is unknown.
    """
    check_choice("rows", rows, POSITION_ROWS)
    none, bias_unit = no_uncertainty(9, 6, 6), 0.1
    if rows == "none":
        return none
    E_F, E_G = np.zeros((1, 9)), np.zeros((1, 6))
    if rows == "accelerometer":
        E_F[0, ACCELEROMETER_BIAS] = -scale_error * period_s / 3 * bias_unit
        E_G[0, :3] = -scale_error * period_s / 3
    else:
        E_F[0, ACCELEROMETER_BIAS] = 0.5 * (period_s / correlation_s) / 3
        E_G[0, 3:] = 0.5 / 3 / bias_unit
    return none._replace(E_F=E_F, E_G=E_G, M1=np.full((9, 1), 1 / 3))


def radians_per_metre(latitude: float, height_m: float) -> FloatArray:
    """Those of latitude and of longitude (2,).

    Raises:
        ValueError: the latitude is that of a pole.
    """
    if abs(np.cos(latitude)) < 1e-4:
        raise ValueError(POLE)
    meridian, transverse = curvature_radii(latitude)
    return np.array([1 / (meridian + height_m), 1 / ((transverse + height_m) * np.cos(latitude))])


def curvature_radii(latitude: Number) -> tuple[Any, Any]:
    """R_M along the meridian and R_N across it (m)."""
    flattened = 1.0 - ECCENTRICITY_SQUARED * np.sin(latitude) ** 2
    transverse = EQUATOR_RADIUS_M / np.sqrt(flattened)
    return transverse * (1.0 - ECCENTRICITY_SQUARED) / flattened, transverse


def gravity(latitude: Number, height_m: Number) -> Any:
    """Down, m/s^2: Somigliana's formula for the WGS84 ellipsoid, less 3.086e-6 for each metre of height."""
    squared = np.sin(latitude) ** 2
    normal = 9.7803253359 * (1 + 0.00193185265241 * squared) / np.sqrt(1 - ECCENTRICITY_SQUARED * squared)
    return normal - 3.086e-6 * height_m


def write_body_to_ned(scale: float, roll: Number, pitch: Number, yaw: Number, out: FloatArray) -> None:
    """out = scale C, C (3, 3) from body axes to north, east, down. The paper's R is its transpose.

    For arrays of angles (any,), out is (3, 3, any).
    """
    sr, cr, sp, cp, sy, cy = np.sin(roll), np.cos(roll), np.sin(pitch), np.cos(pitch), np.sin(yaw), np.cos(yaw)
    out[0, 0] = scale * cp * cy
    out[0, 1] = scale * (sr * sp * cy - cr * sy)
    out[0, 2] = scale * (cr * sp * cy + sr * sy)
    out[1, 0] = scale * cp * sy
    out[1, 1] = scale * (sr * sp * sy + cr * cy)
    out[1, 2] = scale * (cr * sp * sy - sr * cy)
    out[2, 0] = -scale * sp
    out[2, 1] = scale * sr * cp
    out[2, 2] = scale * cr * cp


def _f(x: FloatArray, u: FloatArray, parameters: PositionParameters, out: FloatArray) -> None:
    period, height, cosine = parameters.period_s, x[HEIGHT], np.cos(x[LATITUDE])
    if abs(cosine) < 1e-4:
        raise ValueError(POLE)
    meridian, transverse = curvature_radii(x[LATITUDE])
    out[LATITUDE] = x[LATITUDE] + period * x[NORTH] / (meridian + height)
    out[LONGITUDE] = x[LONGITUDE] + period * x[EAST] / ((transverse + height) * cosine)
    out[HEIGHT] = height - period * x[DOWN]
    C = np.empty((3, 3))
    write_body_to_ned(1.0, u[3], u[4], u[5], C)
    for i in range(3):
        total = C[i, 0] * (u[0] - x[6]) + C[i, 1] * (u[1] - x[7]) + C[i, 2] * (u[2] - x[8])
        out[3 + i] = x[3 + i] + period * total
        out[6 + i] = parameters.decay * x[6 + i]
    out[DOWN] += period * gravity(x[LATITUDE], height)


def _F(x: FloatArray, u: FloatArray, parameters: PositionParameters, out: FloatArray) -> None:
    period, height, sine, cosine = parameters.period_s, x[HEIGHT], np.sin(x[LATITUDE]), np.cos(x[LATITUDE])
    meridian, transverse = curvature_radii(x[LATITUDE])
    bent = ECCENTRICITY_SQUARED * sine * cosine / (1.0 - ECCENTRICITY_SQUARED * sine**2)
    to_centre, to_axis = meridian + height, (transverse + height) * cosine
    out[:, :] = 0.0
    for i in range(6):
        out[i, i] = 1.0
        if i >= 3:
            out[3 + i, 3 + i] = parameters.decay
    out[LATITUDE, LATITUDE] -= period * x[NORTH] * 3.0 * meridian * bent / to_centre**2
    out[LATITUDE, HEIGHT] = -period * x[NORTH] / to_centre**2
    out[LATITUDE, NORTH] = period / to_centre
    out[LONGITUDE, LATITUDE] = period * x[EAST] / to_axis * (sine / cosine - transverse * bent / (transverse + height))
    out[LONGITUDE, HEIGHT] = -period * x[EAST] / (to_axis * (transverse + height))
    out[LONGITUDE, EAST] = period / to_axis
    out[HEIGHT, DOWN] = -period
    write_body_to_ned(-period, u[3], u[4], u[5], out[3:6, 6:9])


def _G(_x: FloatArray, u: FloatArray, parameters: PositionParameters, out: FloatArray) -> None:
    out[:, :] = 0.0
    write_body_to_ned(-parameters.period_s, u[3], u[4], u[5], out[3:6, :3])
    for i in range(3, 6):
        out[3 + i, i] = 1.0


def _residual(y: FloatArray, x: FloatArray, out: FloatArray) -> None:
    for i in range(6):
        out[i] = y[i] - x[i]
    out[LONGITUDE] = wrapped(out[LONGITUDE])
