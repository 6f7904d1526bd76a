"""What a list of numbers stands for: plain quantities, angles that come round, attitudes as quaternions.

The error of an estimate is a vector whatever the state is: an attitude has four numbers and an error of three, a
rotation vector. Means, residuals and covariances are of errors; four numbers are never averaged.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.kernels.place import IntArray
from filters.kernels.quaternion import rotation_between, turn


class Space(NamedTuple):
    """numbers, errors: the lengths of a point and of an error; attitudes: where their quaternions begin in a point,
    ascending; angles: which entries of an error are angles of their own."""

    numbers: int
    errors: int
    attitudes: IntArray
    angles: IntArray


def space(numbers: int, attitudes: Sequence[int] = (), angles: Sequence[int] = ()) -> Space:
    """The space of points with so many numbers.

    attitudes: the index of the first number of each quaternion (scalar first); angles: the indices of angles in
    radians, whose differences come round at pi.

    Raises:
        ValueError: an index does not fit, or two share a number.
    """
    taken = [at + i for at in attitudes for i in range(4)] + list(angles)
    if numbers < 0 or len(set(taken)) < len(taken) or not all(0 <= i < numbers for i in taken):
        raise ValueError(
            f"space: {numbers} numbers cannot hold attitudes={list(attitudes)} (4 numbers each) and "
            f"angles={list(angles)}; give the index of each one's first number, from 0, without overlap"
        )
    starts = sorted(attitudes)
    of_error = [at - sum(start < at for start in starts) for at in angles]
    return Space(
        numbers, numbers - len(starts), np.array(starts, dtype=np.int64), np.array(sorted(of_error), dtype=np.int64)
    )


def plus(of: Space, x: FloatArray, error: FloatArray, out: FloatArray) -> None:
    """out = the point x (numbers,), moved by an error (errors,); out may be x."""
    i = e = 0
    for a in range(len(of.attitudes) + 1):
        end = of.attitudes[a] if a < len(of.attitudes) else of.numbers
        while i < end:
            out[i] = x[i] + error[e]
            i += 1
            e += 1
        if a < len(of.attitudes):
            turn(x, i, error, e, out)
            i += 4
            e += 3


def minus(of: Space, a: FloatArray, b: FloatArray, out: FloatArray) -> None:
    """out (errors,) = the error that takes the point b to a, both (numbers,)."""
    i = e = 0
    for part in range(len(of.attitudes) + 1):
        end = of.attitudes[part] if part < len(of.attitudes) else of.numbers
        while i < end:
            out[e] = a[i] - b[i]
            i += 1
            e += 1
        if part < len(of.attitudes):
            rotation_between(a, b, i, out, e)
            i += 4
            e += 3
    for e in of.angles:
        out[e] = (out[e] + np.pi) % (2.0 * np.pi) - np.pi


def plain(of: Space, x: FloatArray, out: FloatArray) -> None:
    """out (errors,) = the entries of the point x (numbers,), with zeros in place of each attitude."""
    i = e = 0
    for part in range(len(of.attitudes) + 1):
        end = of.attitudes[part] if part < len(of.attitudes) else of.numbers
        while i < end:
            out[e] = x[i]
            i += 1
            e += 1
        if part < len(of.attitudes):
            for a in range(3):
                out[e + a] = 0.0
            i += 4
            e += 3
