"""Blocks of a matrix that is put together from them."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from filters.arrays import FloatArray

IntArray: TypeAlias = NDArray[np.int64]


def clear(T: FloatArray) -> None:
    """T = 0, for a matrix."""
    for i in range(T.shape[0]):
        for j in range(T.shape[1]):
            T[i, j] = 0.0


def place(block: FloatArray, row: int, column: int, T: FloatArray) -> None:
    """The block of T whose first entry is at (row, column) becomes this one."""
    for i in range(block.shape[0]):
        for j in range(block.shape[1]):
            T[row + i, column + j] = block[i, j]


def place_both_ways(block: FloatArray, row: int, column: int, T: FloatArray) -> None:
    """The block at (row, column) becomes this one, and that at (column, row) its transpose."""
    for i in range(block.shape[0]):
        for j in range(block.shape[1]):
            T[row + i, column + j] = block[i, j]
            T[column + j, row + i] = block[i, j]


def place_diagonal(value: float, size: int, row: int, column: int, T: FloatArray) -> None:
    """The diagonal of the block (size, size) at (row, column) becomes this value throughout."""
    for i in range(size):
        T[row + i, column + i] = value
