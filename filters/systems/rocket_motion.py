"""Forces and moments on a rocket, and their integration: plain loops, so that numba can compile them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.kernels.quaternion import rotate, rotate_back


class Airframe(NamedTuple):
    """SI units. Coefficients are for the cross-section `area`, per radian where they multiply an angle.

    margin: from the centre of mass back to that of pressure. damping: of pitch and yaw, in m^2 (normal force of the
    fins, per radian, times their distance squared); roll_damping likewise. cant: the roll rate that the fins give per
    speed, rad/m. inertia, roll_inertia: when full, in proportion to mass. rail: its length. gravity, density: on the
    ground.
    """

    area: float = 0.0177
    drag: float = 0.45
    normal_force: float = 10.0
    margin: float = 0.3
    damping: float = 15.0
    roll_damping: float = 0.03
    cant: float = 0.023
    inertia: float = 13.7
    roll_inertia: float = 0.08
    rail: float = 6.0
    gravity: float = 9.80665
    density: float = 1.225


EARTH_RADIUS_M = 6.371e6
WIND_HEIGHT_M = 10.0


def integrate(
    frame: Airframe,
    fine_s: float,
    thrust: FloatArray,
    mass: FloatArray,
    wind: FloatArray,
    y: FloatArray,
    acceleration: FloatArray,
) -> int:
    """Fills y and acceleration up to apogee, and returns its step; or the last step, if it is not reached.

    y (steps + 1, 13): position, velocity, turn rate, attitude; row 0 is given. acceleration (steps + 1, 3). wind (steps
    + 1, 4). thrust, mass (2 n steps + 1,): at half the fine steps of RK4, of which there are n in a step.
    """
    steps: int = y.shape[0] - 1
    fine = (thrust.shape[0] - 1) // (2 * steps)
    now, at, air = np.empty(13), np.empty(13), np.empty(4)
    k1, k2, k3, k4, body = np.empty(13), np.empty(13), np.empty(13), np.empty(13), np.empty((3, 3))
    now[:] = y[0]
    for j in range(steps):
        air[:] = wind[j]
        for i in range(fine):
            half = 2 * (fine * j + i)
            derivative(frame, now, thrust[half], mass[half], mass[0], air, body, k1)
            if i == 0:
                acceleration[j] = k1[3:6]
            for e in range(13):
                at[e] = now[e] + 0.5 * fine_s * k1[e]
            derivative(frame, at, thrust[half + 1], mass[half + 1], mass[0], air, body, k2)
            for e in range(13):
                at[e] = now[e] + 0.5 * fine_s * k2[e]
            derivative(frame, at, thrust[half + 1], mass[half + 1], mass[0], air, body, k3)
            for e in range(13):
                at[e] = now[e] + fine_s * k3[e]
            derivative(frame, at, thrust[half + 2], mass[half + 2], mass[0], air, body, k4)
            for e in range(13):
                now[e] += fine_s / 6.0 * (k1[e] + 2.0 * k2[e] + 2.0 * k3[e] + k4[e])
            length = np.sqrt(now[9] ** 2 + now[10] ** 2 + now[11] ** 2 + now[12] ** 2)
            for e in range(9, 13):
                now[e] /= length
        y[j + 1] = now
        falling = now[5] < 0.0
        if falling or j + 1 == steps:
            last = 2 * fine * (j + 1)
            derivative(frame, now, thrust[last], mass[last], mass[0], wind[j + 1], body, k1)
            acceleration[j + 1] = k1[3:6]
            if falling:
                return j + 1
    return steps


def derivative(
    frame: Airframe,
    y: FloatArray,
    thrust: float,
    mass: float,
    full_mass: float,
    wind: FloatArray,
    body: FloatArray,
    out: FloatArray,
) -> None:
    """out (13,) = the time derivative of y (13,). wind (4,): mean wind at 10 m and gust, each east and north.

    body (3, 3): scratch. On the rail the rocket moves along its nose only, and not backwards.
    """
    up = max(y[2], 0.0)
    growth = (max(up, WIND_HEIGHT_M) / WIND_HEIGHT_M) ** (1.0 / 7.0)
    body[0, 0] = y[3] - growth * wind[0] - wind[2]
    body[0, 1] = y[4] - growth * wind[1] - wind[3]
    body[0, 2] = y[5]
    rotate_back(y, 9, body[0], 0, body[1])  # speed in the air, seen from the body
    speed = np.sqrt(body[0, 0] ** 2 + body[0, 1] ** 2 + body[0, 2] ** 2)
    density = frame.density * (1.0 - 2.25577e-5 * up) ** 4.25588  # International Standard Atmosphere, below 11 km
    flow = 0.5 * density * speed * frame.area

    lift_y = -flow * frame.normal_force * body[1, 1]
    lift_z = -flow * frame.normal_force * body[1, 2]
    body[2, 0] = (thrust - flow * frame.drag * body[1, 0]) / mass
    body[2, 1] = (lift_y - flow * frame.drag * body[1, 1]) / mass
    body[2, 2] = (lift_z - flow * frame.drag * body[1, 2]) / mass
    rotate(y, 9, body[2], 0, out[3:6])
    gravity = frame.gravity * (EARTH_RADIUS_M / (EARTH_RADIUS_M + up)) ** 2
    out[5] -= gravity

    share = mass / full_mass
    inertia, roll_inertia = frame.inertia * share, frame.roll_inertia * share
    out[6] = flow * frame.roll_damping * (frame.cant * speed - y[6]) / roll_inertia
    out[7] = (frame.margin * lift_z - flow * frame.damping * y[7] + (inertia - roll_inertia) * y[8] * y[6]) / inertia
    out[8] = (-frame.margin * lift_y - flow * frame.damping * y[8] - (inertia - roll_inertia) * y[6] * y[7]) / inertia

    if y[0] ** 2 + y[1] ** 2 + y[2] ** 2 < frame.rail**2:
        body[0, 0], body[0, 1], body[0, 2] = 1.0, 0.0, 0.0
        rotate(y, 9, body[0], 0, body[1])  # the nose
        along = body[2, 0] - gravity * body[1, 2]
        if along < 0.0 and y[5] <= 0.0:
            along = 0.0
        for a in range(3):
            out[3 + a] = along * body[1, a]
            out[6 + a] = 0.0

    for a in range(3):
        out[a] = y[3 + a]
    out[9] = 0.5 * (-y[10] * y[6] - y[11] * y[7] - y[12] * y[8])
    out[10] = 0.5 * (y[9] * y[6] + y[11] * y[8] - y[12] * y[7])
    out[11] = 0.5 * (y[9] * y[7] - y[10] * y[8] + y[12] * y[6])
    out[12] = 0.5 * (y[9] * y[8] + y[10] * y[7] - y[11] * y[6])
