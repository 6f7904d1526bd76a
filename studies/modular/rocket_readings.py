"""What an error of position or orientation is a share of: readings of "residuals < 15 %".

MacCormack and Rubinstein, Implementation of a modular linear and unscented Kalman filter, do not say which they mean.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from filters.arrays import FloatArray
from studies.modular.rocket_flights import Run


def distance(run: Run) -> FloatArray:
    """Error of position over distance from the pad."""
    return share(length(run.errors[:, :3]), length(run.truth[:, :3]))


def altitude(run: Run) -> FloatArray:
    """Error of height over height."""
    return share(run.errors[:, 2], run.truth[:, 2])


def horizontal(run: Run) -> FloatArray:
    """Horizontal error over horizontal distance."""
    return share(length(run.errors[:, :2]), length(run.truth[:, :2]))


def worst_axis(run: Run) -> FloatArray:
    """The worst of east, north, up: each axis' error over its own coordinate."""
    worst: FloatArray = share(run.errors[:, :3], run.truth[:, :3]).max(axis=1)
    return worst


def way_turned(run: Run) -> FloatArray:
    """Angle of the orientation's error over all that the body has turned since ignition, roll too."""
    rate = length(run.truth[:, 9:12])
    steps = (rate[1:] + rate[:-1]) / 2 * np.diff(run.time_s)
    return share(length(run.errors[:, 12:]), np.concatenate([[0.0], np.cumsum(steps)]))


def net_turn(run: Run) -> FloatArray:
    """Angle of the orientation's error over that between the orientation and the one on the pad, at most 180 deg."""
    return share(length(run.errors[:, 12:]), attitude_angle(run.truth[:, 12:], run.truth[0, 12:]))


def nose(run: Run) -> FloatArray:
    """Angle between the nose and where the filter thinks it is, over that between the nose and the rail."""
    true, estimate = _nose(run.truth), _nose(run.x)
    return share(_angle(true, estimate), _angle(true, true[0]))


def quaternion(run: Run) -> FloatArray:
    """Length of the difference of the quaternions, of which each has length 1: 15 % are 17 degrees."""
    return chord(run.truth[:, 12:], run.x[:, 12:])


READINGS: dict[str, Callable[[Run], FloatArray]] = {
    "position / distance from the pad": distance,
    "height / height": altitude,
    "horizontal / horizontal distance": horizontal,
    "worst axis / its coordinate": worst_axis,
    "orientation / all turned": way_turned,
    "orientation / net turn": net_turn,
    "nose / turn of the nose": nose,
    "difference of quaternions": quaternion,
}
"""Each a share over time (steps + 1,), infinite or meaningless before liftoff."""


def share(error: FloatArray, whole: FloatArray) -> FloatArray:
    """The size of the error over that of something else; infinite over nothing."""
    shares: FloatArray = np.divide(np.abs(error), np.abs(whole), out=np.full(error.shape, np.inf), where=whole != 0.0)
    return shares


def length(vectors: FloatArray) -> FloatArray:
    """The length of each row."""
    lengths: FloatArray = np.sqrt(np.sum(vectors**2, axis=-1))
    return lengths


def chord(a: FloatArray, b: FloatArray) -> FloatArray:
    """Length of the difference of unit quaternions (any, 4), of which q and -q are one attitude."""
    return np.minimum(length(a - b), length(a + b))


def attitude_angle(a: FloatArray, b: FloatArray) -> FloatArray:
    """Angle of the rotation between unit quaternions (any, 4): four times that of half their chord."""
    return 4 * np.arcsin(chord(a, b) / 2)


def _nose(states: FloatArray) -> FloatArray:
    """Where the body's x points to (steps + 1, 3): the first column of the rotation matrix."""
    w, x, y, z = states[:, 12:].T
    return np.stack([w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)], axis=1)


def _angle(a: FloatArray, b: FloatArray) -> FloatArray:
    """Between unit vectors, exact for small angles."""
    angles: FloatArray = 2 * np.arcsin(np.minimum(length(a - b) / 2, 1.0))
    return angles
