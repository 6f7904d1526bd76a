"""Attitude from rate gyros, with their biases: Eqs. (11) to (17) of "Computation of Extended Robust Kalman Filter for
Real-Time Attitude and Position Estimation" (arXiv:1801.04386), whose printed formulas are lost; after Farrell (2008).

State: roll, pitch, yaw (rad, the ZYX sequence) and the biases of three gyros (rad/s), Gauss-Markov processes. Input:
the measured turn rates (rad/s). Noise: of the gyros and of their biases. Measurement: roll, pitch and yaw (rad), the
last one corrected by what GPS said of it.
"""

from __future__ import annotations

from typing import Literal, NamedTuple, TypeAlias, get_args

import numpy as np

from filters.arrays import FloatArray
from filters.choice import check_choice
from filters.robust.uncertain import Scaling, UncertainSystem, Uncertainty, no_uncertainty

ROLL, PITCH, YAW, GYRO_BIAS = 0, 1, 2, slice(3, 6)

AttitudeRows: TypeAlias = Literal["none", "gyro", "bias", "all"]
ATTITUDE_ROWS: tuple[AttitudeRows, ...] = get_args(AttitudeRows)

GIMBAL_LOCK = (
    "attitude: pitch is within 0.06 degrees of 90 degrees, where roll and yaw are not defined; "
    "keep the vehicle below that, or choose body axes so that it is never reached"
)


class AttitudeParameters(NamedTuple):
    """period_s: of one step. decay: exp(-period / correlation time), by which a bias shrinks in one step."""

    period_s: float
    decay: float


def attitude(
    period_s: float = 1 / 400,
    correlation_s: float = 200.0,
    gyro_sigma: float = 0.0025,
    bias_sigma: float = 0.005,
    tilt_sigma: float = 0.005,
    yaw_sigma: float = 0.03,
) -> UncertainSystem:
    """The model. gyro_sigma, bias_sigma (rad/s): of one sample, and of the bias as a stationary process.

    tilt_sigma, yaw_sigma (rad): of one measurement. A GPS yaw that is held for 40 samples needs sqrt(40) times its own.

    Raises:
        ValueError: a period, correlation time or sigma is not positive.
    """
    if min(period_s, correlation_s, gyro_sigma, bias_sigma, tilt_sigma, yaw_sigma) <= 0:
        raise ValueError(
            f"attitude: period_s={period_s}, correlation_s={correlation_s}, gyro_sigma={gyro_sigma}, "
            f"bias_sigma={bias_sigma}, tilt_sigma={tilt_sigma} and yaw_sigma={yaw_sigma} must all be positive"
        )
    decay = float(np.exp(-period_s / correlation_s))
    Q = np.diag([gyro_sigma**2] * 3 + [bias_sigma**2 * (1 - decay**2)] * 3)
    R = np.diag([tilt_sigma, tilt_sigma, yaw_sigma]) ** 2
    return UncertainSystem(_f, _F, _G, _residual, np.eye(3, 6), Q, R, AttitudeParameters(period_s, decay))


def attitude_scaling(unit: float = 0.01) -> Scaling:
    """Angles in hundredths of a radian, biases in hundredths of a rad/s."""
    return Scaling(np.zeros(6), np.full(6, unit), np.full(3, unit))


def attitude_uncertainty(
    rows: AttitudeRows, scale_error: float = 0.02, period_s: float = 1 / 400, correlation_s: float = 200.0
) -> Uncertainty:
    """A reading of Eq. (26), which is lost: each entry the mean, over rows, of its column's uncertain entries.

    "gyro": the scale of the gyros, known to +-scale_error. "bias": half of what the biases lose in one step, and half
    of their noise. "all": "bias", and a thousandth of the yaw in the measurement with half of its noise. The uncertain
    scale also multiplies the measured turn rate, an input, for which the paper's equations have no place.

    Raises:
        ValueError: rows is unknown.
    """
    check_choice("rows", rows, ATTITUDE_ROWS)
    none, unit = no_uncertainty(6, 6, 3), attitude_scaling().unit[0]
    if rows == "none":
        return none
    E_F, E_G, E_H, E_D = np.zeros((1, 6)), np.zeros((1, 6)), np.zeros((1, 6)), np.zeros((1, 3))
    if rows == "gyro":
        E_F[0, GYRO_BIAS] = -scale_error * period_s / 3
        E_G[0, :3] = -scale_error * period_s / 3 / unit
    else:
        E_F[0, GYRO_BIAS] = 0.5 * (period_s / correlation_s) / 3
        E_G[0, 3:] = 0.5 / 3 / unit
    if rows == "all":
        E_H[0, YAW] = 1e-3
        E_D[0, YAW] = 0.5
    M1, M2 = np.full((6, 1), 6**-0.5), np.full((3, 1), 3**-0.5)
    return Uncertainty(E_F, E_G, E_H, E_D, M1, M2)


def write_rate_matrix(scale: float, roll: float, pitch: float, out: FloatArray) -> None:
    """out = scale T, T (3, 3) the matrix from body rates to the rates of roll, pitch and yaw, Eq. (17)."""
    sine, cosine = np.sin(roll), np.cos(roll)
    tangent, cosine_pitch = np.tan(pitch), np.cos(pitch)
    out[0, 0] = scale
    out[0, 1] = scale * sine * tangent
    out[0, 2] = scale * cosine * tangent
    out[1, 0] = 0.0
    out[1, 1] = scale * cosine
    out[1, 2] = -scale * sine
    out[2, 0] = 0.0
    out[2, 1] = scale * sine / cosine_pitch
    out[2, 2] = scale * cosine / cosine_pitch


def wrapped(angle: float) -> float:
    """The same angle in (-pi, pi]."""
    turned: float = np.pi - (np.pi - angle) % (2 * np.pi)
    return turned


def _f(x: FloatArray, u: FloatArray, parameters: AttitudeParameters, out: FloatArray) -> None:
    period, sine, cosine, cosine_pitch = parameters.period_s, np.sin(x[ROLL]), np.cos(x[ROLL]), np.cos(x[PITCH])
    if abs(cosine_pitch) < 1e-3:
        raise ValueError(GIMBAL_LOCK)
    q, r = u[1] - x[4], u[2] - x[5]
    swing = sine * q + cosine * r
    out[ROLL] = x[ROLL] + period * (u[0] - x[3] + swing * np.tan(x[PITCH]))
    out[PITCH] = x[PITCH] + period * (cosine * q - sine * r)
    out[YAW] = x[YAW] + period * swing / cosine_pitch
    for i in range(3, 6):
        out[i] = parameters.decay * x[i]


def _F(x: FloatArray, u: FloatArray, parameters: AttitudeParameters, out: FloatArray) -> None:
    period, sine, cosine = parameters.period_s, np.sin(x[ROLL]), np.cos(x[ROLL])
    tangent, cosine_pitch = np.tan(x[PITCH]), np.cos(x[PITCH])
    q, r = u[1] - x[4], u[2] - x[5]
    swing, across = sine * q + cosine * r, cosine * q - sine * r
    out[:, :] = 0.0
    out[ROLL, ROLL] = 1.0 + period * across * tangent
    out[ROLL, PITCH] = period * swing / cosine_pitch**2
    out[PITCH, ROLL] = -period * swing
    out[PITCH, PITCH] = 1.0
    out[YAW, ROLL] = period * across / cosine_pitch
    out[YAW, PITCH] = period * swing * tangent / cosine_pitch
    out[YAW, YAW] = 1.0
    write_rate_matrix(-period, x[ROLL], x[PITCH], out[:3, 3:])
    for i in range(3, 6):
        out[i, i] = parameters.decay


def _G(x: FloatArray, _u: FloatArray, parameters: AttitudeParameters, out: FloatArray) -> None:
    out[:, :] = 0.0
    write_rate_matrix(-parameters.period_s, x[ROLL], x[PITCH], out[:3, :3])
    for i in range(3, 6):
        out[i, i] = 1.0


def _residual(y: FloatArray, x: FloatArray, out: FloatArray) -> None:
    for i in range(3):
        out[i] = wrapped(y[i] - x[i])
