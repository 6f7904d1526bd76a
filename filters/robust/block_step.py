"""The step by way of the block system, given a kernel for its last unknowns."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.kernels.dense import copy
from filters.kernels.place import IntArray
from filters.robust.blocks import block_sizes, block_starts, place_blocks, template
from filters.robust.records import Predicted, RobustModel, Weights


class BlockWorkspace(NamedTuple):
    """Scratch arrays for N unknowns, of which the last n are wanted, and n + 1 right-hand sides.

    Two exceptions: starts and constant, those of `blocks`, are never written.
    """

    starts: IntArray  # (11,)
    constant: FloatArray  # (N, N + n + 1)
    T: FloatArray  # (N, N + n + 1)
    last: FloatArray  # (n, n + 1)
    square: FloatArray  # (N, N)
    result: FloatArray  # (N, N)
    single: FloatArray  # (N, N + 1)
    column: FloatArray  # (N, 1)
    last_column: FloatArray  # (n, 1)
    swaps: IntArray  # (N,)


def new_block_workspace(model: RobustModel, order: Sequence[int]) -> BlockWorkspace:
    """Scratch memory for a step by way of the block system, with its blocks in this order."""
    sizes, n = block_sizes(model), len(model.F)
    N, starts = sum(sizes), block_starts(sizes, order)
    return BlockWorkspace(
        starts=starts,
        constant=template(model, starts),
        T=np.zeros((N, N + n + 1)),
        last=np.zeros((n, n + 1)),
        square=np.zeros((N, N)),
        result=np.zeros((N, N)),
        single=np.zeros((N, N + 1)),
        column=np.zeros((N, 1)),
        last_column=np.zeros((n, 1)),
        swaps=np.zeros(N, dtype=np.int64),
    )


def block_step(solve_last: Callable[[BlockWorkspace], None]) -> Callable[..., None]:
    """A step made of a kernel that writes the last n unknowns of work.T = [A b] into work.last; T may be destroyed."""

    def step(
        model: RobustModel,
        weights: Weights,
        before: Predicted,
        y: FloatArray,
        c: FloatArray,
        after: Predicted,
        work: BlockWorkspace,
    ) -> None:
        """Job: x_{i|i-1} and P_{i|i-1} become x_{i+1|i} and P_{i+1|i}, for y (p,) and c (n,); P is made symmetric."""
        copy(work.constant, work.T)
        place_blocks(model, weights, before, y, c, work.starts, work.T)
        solve_last(work)
        for i in range(len(after.x)):
            after.x[i] = work.last[i, 0]
            after.P[i, i] = work.last[i, 1 + i]
            for j in range(i):
                mean = 0.5 * (work.last[i, 1 + j] + work.last[j, 1 + i])
                after.P[i, j] = mean
                after.P[j, i] = mean

    return step
