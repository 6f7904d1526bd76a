"""Attitudes as unit quaternions (scalar first), and the small rotations between them.

A rotation vector is angle times axis, in the frame of the body: q turned by it is q * exp(vector). Markley, Attitude
estimation or quaternion estimation?, Flight Mechanics Symposium 2003.
"""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray

SMALL = 1e-8
"""Below this squared angle the first terms of the series are exact to rounding."""


def turn(x: FloatArray, at: int, rotation: FloatArray, start: int, out: FloatArray) -> None:
    """out[at : at + 4] = the quaternion at x[at], turned by the rotation vector at rotation[start]; out may be x.

    The result has unit length whatever that of x: rounding does not add up.
    """
    a, b, c = rotation[start], rotation[start + 1], rotation[start + 2]
    squared = a * a + b * b + c * c
    if squared < SMALL:
        real = 1.0 - 0.125 * squared
        scale = 0.5 - squared / 48.0
    else:
        angle = np.sqrt(squared)
        real = np.cos(0.5 * angle)
        scale = np.sin(0.5 * angle) / angle
    i, j, k = scale * a, scale * b, scale * c
    w, x1, x2, x3 = x[at], x[at + 1], x[at + 2], x[at + 3]
    q0 = w * real - x1 * i - x2 * j - x3 * k
    q1 = w * i + x1 * real + x2 * k - x3 * j
    q2 = w * j - x1 * k + x2 * real + x3 * i
    q3 = w * k + x1 * j - x2 * i + x3 * real
    shrink = 1.0 / np.sqrt(q0 * q0 + q1 * q1 + q2 * q2 + q3 * q3)
    out[at] = shrink * q0
    out[at + 1] = shrink * q1
    out[at + 2] = shrink * q2
    out[at + 3] = shrink * q3


def rotation_between(a: FloatArray, b: FloatArray, at: int, out: FloatArray, start: int) -> None:
    """out[start : start + 3] = the rotation vector that turns the quaternion at b[at] into that at a[at].

    The shorter way round, so at most pi long: q and -q are one attitude.
    """
    a0, a1, a2, a3 = a[at], a[at + 1], a[at + 2], a[at + 3]
    b0, b1, b2, b3 = b[at], b[at + 1], b[at + 2], b[at + 3]
    real = b0 * a0 + b1 * a1 + b2 * a2 + b3 * a3
    i = b0 * a1 - b1 * a0 - b2 * a3 + b3 * a2
    j = b0 * a2 + b1 * a3 - b2 * a0 - b3 * a1
    k = b0 * a3 - b1 * a2 + b2 * a1 - b3 * a0
    if real < 0.0:
        real, i, j, k = -real, -i, -j, -k
    squared = i * i + j * j + k * k
    if squared < SMALL * real * real:
        scale = (2.0 - squared / (1.5 * real * real)) / real
    else:
        length = np.sqrt(squared)
        scale = 2.0 * np.arctan2(length, real) / length
    out[start] = scale * i
    out[start + 1] = scale * j
    out[start + 2] = scale * k


def rotate(q: FloatArray, at: int, v: FloatArray, start: int, out: FloatArray) -> None:
    """out (3,) = the vector v[start : start + 3] of the body in the frame to which the quaternion at q[at] refers.

    out may be v.
    """
    _rotate_by(q[at], q[at + 1], q[at + 2], q[at + 3], v, start, out)


def rotate_back(q: FloatArray, at: int, v: FloatArray, start: int, out: FloatArray) -> None:
    """out (3,) = the vector v[start : start + 3] in the frame of the body: the inverse of `rotate`; out may be v."""
    _rotate_by(q[at], -q[at + 1], -q[at + 2], -q[at + 3], v, start, out)


def _rotate_by(w: float, x: float, y: float, z: float, v: FloatArray, start: int, out: FloatArray) -> None:
    a, b, c = v[start], v[start + 1], v[start + 2]
    i = 2.0 * (y * c - z * b)
    j = 2.0 * (z * a - x * c)
    k = 2.0 * (x * b - y * a)
    out[0] = a + w * i + (y * k - z * j)
    out[1] = b + w * j + (z * i - x * k)
    out[2] = c + w * k + (x * j - y * i)
