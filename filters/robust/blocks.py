"""The robust step as a linear system A y = b of 11 blocks: the optimality conditions of its min-max problem.

Blocks 0 to 6 are multipliers, of the equations for x_i, w_i, v_i, the state, the measurement, and the E rows of both;
7 to 10 are x_i, w_i, v_i and x_{i+1} (Inoue, Terra and Cerri 2016; Ishihara, Terra and Cerri 2015). The last n rows of
the solution are [x_{i+1|i} P_{i+1|i}].
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from filters.arrays import FloatArray
from filters.kernels.dense import copy
from filters.kernels.place import IntArray, place, place_both_ways, place_diagonal
from filters.robust.records import Predicted, RobustModel, Weights

NATURAL = (0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10)
RECOMMENDED = (1, 2, 9, 4, 6, 8, 0, 7, 5, 3, 10)
"""An order of rows and columns in which little fills up when they are eliminated; x_{i+1} stays last."""


def block_sizes(model: RobustModel) -> tuple[int, ...]:
    """How many unknowns each block has, in natural order; their sum N is 4n + 2m + 2q + p + t1 + t2."""
    n, m, p, q = len(model.F), model.G.shape[1], len(model.H), model.D.shape[1]
    return n, m, q, n, p, len(model.E_F), len(model.E_H), n, m, q, n


def block_starts(sizes: Sequence[int], order: Sequence[int]) -> IntArray:
    """Where each block begins (11,), indexed by its number, when they follow one another in this order."""
    starts = np.zeros(len(sizes), dtype=np.int64)
    for earlier, block in pairwise(order):
        starts[block] = starts[earlier] + sizes[earlier]
    return starts


def template(model: RobustModel, starts: IntArray) -> FloatArray:
    """What of [A b] (N, N + n + 1) is the same for all models of these sizes: zeros and identities."""
    sizes = block_sizes(model)
    n, m, q, N = sizes[0], sizes[1], sizes[2], sum(sizes)
    T = np.zeros((N, N + n + 1))
    place_both_ways(np.eye(n), starts[0], starts[7], T)
    place_both_ways(np.eye(m), starts[1], starts[8], T)
    place_both_ways(np.eye(q), starts[2], starts[9], T)
    place_both_ways(-np.eye(n), starts[3], starts[10], T)
    place(-np.eye(n), starts[10], N + 1, T)
    return T


def assemble(
    model: RobustModel,
    weights: Weights,
    before: Predicted,
    y: FloatArray,
    c: FloatArray,
    starts: IntArray,
    T: FloatArray,
) -> None:
    """T = [A b], for T (N, N + n + 1) and starts from `block_starts`.

    The first column of b is for x_{i+1|i}, the others for P_{i+1|i}.
    """
    copy(template(model, starts), T)
    place_blocks(model, weights, before, y, c, starts, T)


def place_blocks(
    model: RobustModel,
    weights: Weights,
    before: Predicted,
    y: FloatArray,
    c: FloatArray,
    starts: IntArray,
    T: FloatArray,
) -> None:
    """`assemble` for a T that holds the `template` already."""
    N = len(T)
    place(before.P, starts[0], starts[0], T)
    place(model.Q, starts[1], starts[1], T)
    place(model.R, starts[2], starts[2], T)
    place(weights.Phi1, starts[3], starts[3], T)
    place(weights.Phi2, starts[4], starts[4], T)
    place_diagonal(weights.inverse_lambda, len(model.E_F), starts[5], starts[5], T)
    place_diagonal(weights.inverse_lambda, len(model.E_H), starts[6], starts[6], T)
    place_both_ways(model.F, starts[3], starts[7], T)
    place_both_ways(model.G, starts[3], starts[8], T)
    place_both_ways(model.H, starts[4], starts[7], T)
    place_both_ways(model.D, starts[4], starts[9], T)
    place_both_ways(model.E_F, starts[5], starts[7], T)
    place_both_ways(model.E_G, starts[5], starts[8], T)
    place_both_ways(model.E_H, starts[6], starts[7], T)
    place_both_ways(model.E_D, starts[6], starts[9], T)
    for i in range(len(before.x)):
        T[starts[0] + i, N] = before.x[i]
        T[starts[3] + i, N] = -c[i]
    for i in range(len(y)):
        T[starts[4] + i, N] = y[i]
