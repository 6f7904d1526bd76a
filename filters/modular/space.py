"""What a list of numbers stands for: plain quantities, angles that come round, attitudes as quaternions.

The error of an estimate is a vector whatever the state is: an attitude has four numbers and an error of three, a
rotation vector. Means, residuals and covariances are of errors; four numbers are never averaged.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.kernels.place import IntArray
from filters.kernels.quaternion import rotation_between, turn

SHORTEST = 1e-200
"""The squared length of a quaternion that is as good as none."""

MOST = 100_000
"""The length of a point of which a covariance is 80 GB."""


class Space(NamedTuple):
    """What the numbers of a state or a measurement stand for; made by `space`.

    numbers: the length of a point; errors: that of an error; attitudes (attitudes,): where their quaternions begin in a
    point, ascending; angles (angles,): which entries of an error are angles of their own, in radians.
    """

    numbers: int
    errors: int
    attitudes: IntArray
    angles: IntArray


NOTHING = Space(0, 0, np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64))
"""What a predictor observes."""


def space(numbers: int, attitudes: Sequence[int] = (), angles: Sequence[int] = ()) -> Space:
    """The space of points with so many numbers.

    attitudes: the index of the first number of each quaternion (scalar first); angles: the indices of angles in
    radians, whose differences come round at pi.

    Raises:
        ValueError: an index is not whole or does not fit, or two share a number.
    """
    if isinstance(numbers, bool) or not isinstance(numbers, int | np.integer) or not 1 <= numbers <= MOST:
        raise ValueError(
            f"space: numbers={numbers!r:.60} must be a whole number from 1 to {MOST}: the length of a point"
        )
    for name, indices in (("attitudes", attitudes), ("angles", angles)):
        if not (isinstance(indices, Iterable) and all(isinstance(i, int | np.integer) for i in indices)):
            raise ValueError(f"space: {name}={indices!r:.60} must be a list of whole numbers, [] if there are none")
    taken = [at + i for at in attitudes for i in range(4)] + list(angles)
    if len(set(taken)) < len(taken) or not all(0 <= i < numbers for i in taken):
        raise ValueError(
            f"space: {numbers} numbers cannot hold attitudes={list(attitudes)} (4 numbers each) and "
            f"angles={list(angles)}; give the index of each one's first number, from 0, without overlap"
        )
    starts = sorted(attitudes)
    of_error = [at - sum(start < at for start in starts) for at in angles]
    return Space(
        int(numbers),
        int(numbers) - len(starts),
        np.array(starts, dtype=np.int64),
        np.array(sorted(of_error), dtype=np.int64),
    )


def as_space(name: str, value: object) -> Space:
    """The space itself. Raises ValueError, naming the argument, unless it is one."""
    if not isinstance(value, Space):
        raise ValueError(f"{name} is {value!r:.60}; give space(numbers, attitudes=[...], angles=[...])")
    return value


def numbers_of_errors(space: Space) -> IntArray:
    """The index, for each entry of an error, of a number of the point that it is about."""
    return np.setdiff1d(np.arange(space.numbers), space.attitudes + 3)


def is_point(space: Space, x: FloatArray) -> bool:
    """Whether all numbers of x (numbers,) are finite and each quaternion has a length, by which it can be divided."""
    for value in x:
        if not np.isfinite(value):
            return False
    for at in space.attitudes:
        squared = x[at] * x[at] + x[at + 1] * x[at + 1] + x[at + 2] * x[at + 2] + x[at + 3] * x[at + 3]
        if not SHORTEST < squared < np.inf:
            return False
    return True


def plus(space: Space, x: FloatArray, error: FloatArray, out: FloatArray) -> None:
    """out = the point x (numbers,), moved by an error (errors,); out may be x."""
    start = 0
    for part in range(len(space.attitudes) + 1):
        end = space.attitudes[part] - part if part < len(space.attitudes) else space.errors
        for e in range(start, end):
            out[e + part] = x[e + part] + error[e]
        if part < len(space.attitudes):
            turn(x, end + part, error, end, out)
        start = end + 3


def minus(space: Space, a: FloatArray, b: FloatArray, out: FloatArray) -> None:
    """out (errors,) = the error that takes the point b to a, both (numbers,)."""
    start = 0
    for part in range(len(space.attitudes) + 1):
        end = space.attitudes[part] - part if part < len(space.attitudes) else space.errors
        for e in range(start, end):
            out[e] = a[e + part] - b[e + part]
        if part < len(space.attitudes):
            rotation_between(a, b, end + part, out, end)
        start = end + 3
    for e in space.angles:
        out[e] = (out[e] + np.pi) % (2.0 * np.pi) - np.pi


def plain(space: Space, x: FloatArray, out: FloatArray) -> None:
    """out (errors,) = the entries of the point x (numbers,), with zeros in place of each attitude."""
    start = 0
    for part in range(len(space.attitudes) + 1):
        end = space.attitudes[part] - part if part < len(space.attitudes) else space.errors
        for e in range(start, end):
            out[e] = x[e + part]
        if part < len(space.attitudes):
            for e in range(end, end + 3):
                out[e] = 0.0
        start = end + 3


def plus_each(space: Space, x: FloatArray, errors: FloatArray, points: FloatArray) -> None:
    """`plus` for each row of errors (2 n + 1, errors) and points (2 n + 1, numbers).

    Faster than one by one: all rows part by part, two at a time.
    """
    start = 0
    for part in range(len(space.attitudes) + 1):
        end = space.attitudes[part] - part if part < len(space.attitudes) else space.errors
        for e in range(start, end):
            points[0, e + part] = x[e + part] + errors[0, e]
        for i in range(1, points.shape[0], 2):
            for e in range(start, end):
                points[i, e + part] = x[e + part] + errors[i, e]
                points[i + 1, e + part] = x[e + part] + errors[i + 1, e]
        if part < len(space.attitudes):
            for i in range(points.shape[0]):
                turn(x, end + part, errors[i], end, points[i])
        start = end + 3


def minus_each(space: Space, points: FloatArray, x: FloatArray, errors: FloatArray) -> None:
    """`minus` of each row of points (2 n + 1, numbers) and x, in the rows of errors (2 n + 1, errors)."""
    start = 0
    for part in range(len(space.attitudes) + 1):
        end = space.attitudes[part] - part if part < len(space.attitudes) else space.errors
        for e in range(start, end):
            errors[0, e] = points[0, e + part] - x[e + part]
        for i in range(1, points.shape[0], 2):
            for e in range(start, end):
                errors[i, e] = points[i, e + part] - x[e + part]
                errors[i + 1, e] = points[i + 1, e + part] - x[e + part]
        if part < len(space.attitudes):
            for i in range(points.shape[0]):
                rotation_between(points[i], x, end + part, errors[i], end)
        start = end + 3
    for e in space.angles:
        for i in range(points.shape[0]):
            errors[i, e] = (errors[i, e] + np.pi) % (2.0 * np.pi) - np.pi
