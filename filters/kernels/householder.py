"""Triangularisation by Householder reflections, without touching what is zero."""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray


def reflect(T: FloatArray, j: int) -> None:
    """Column j of T (N, width) vanishes below the diagonal by a reflection of the rows from j on.

    The reflection is I - 2 v v^T / v^T v. Rows in which v is zero keep what they have, and so do columns that are
    orthogonal to v, as those without a common entry are.
    """
    N, width = T.shape
    below = 0.0
    for i in range(j + 1, N):
        if T[i, j] != 0.0:
            below += T[i, j] * T[i, j]
    if below != 0.0:
        r = np.sqrt(T[j, j] * T[j, j] + below)
        if T[j, j] > 0.0:
            r = -r
        first = T[j, j] - r  # of v; the others are column j as it is
        scale = 1.0 / (first * r)  # -2 / v^T v
        for k in range(j + 1, width):
            product = 0.0
            if T[j, k] != 0.0:
                product = first * T[j, k]
            for i in range(j + 1, N):
                if T[i, j] != 0.0 and T[i, k] != 0.0:
                    product += T[i, j] * T[i, k]
            if product != 0.0:
                product *= scale
                T[j, k] += product * first
                for i in range(j + 1, N):
                    if T[i, j] != 0.0:
                        T[i, k] += product * T[i, j]
        T[j, j] = r
        for i in range(j + 1, N):
            T[i, j] = 0.0


def triangularise_by_reflections(T: FloatArray) -> None:
    """The first N columns of T (N, N + r) become upper triangular by one reflection each; T = [A b] gives Q^T [A b]."""
    for j in range(len(T) - 1):
        reflect(T, j)
