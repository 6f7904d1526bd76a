"""What P processors make of one robust step, solved by Givens rotations."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from filters.arrays import FloatArray
from filters.robust.blocks import RECOMMENDED, assemble, block_sizes, block_starts
from filters.robust.parallel import Pattern, greedy
from filters.robust.parallel_cost import step_flops
from filters.robust.records import Predicted, RobustModel, Weights


def step_pattern(
    model: RobustModel, weights: Weights, c: FloatArray | None = None, order: Sequence[int] = RECOMMENDED
) -> Pattern:
    """Where the step's system [A b] (N, N + n + 1) may differ from zero, for a model as `prepared` leaves it.

    Entries of the model and of c (n,) that are zero are taken to be so in every step; without c, none of it is. P, the
    estimate and the measurement have no zeros. order: of the blocks, in rows and columns.
    """
    n, p = len(model.F), len(model.H)
    sizes = block_sizes(model)
    T = np.empty((sum(sizes), sum(sizes) + n + 1))
    full = Predicted(np.ones(n), np.ones((n, n)))
    assemble(model, weights, full, np.ones(p), np.ones(n) if c is None else c, block_starts(sizes, order), T)
    pattern: Pattern = T != 0.0
    return pattern


def parallel_step_flops(
    model: RobustModel, weights: Weights, processors: Iterable[int], order: Sequence[int] = RECOMMENDED
) -> dict[int, int]:
    """By number of processors: operations in sequence of one robust step by the greedy schedule.

    Raises:
        ValueError: a number of processors is not positive.
    """
    return step_flops(greedy(step_pattern(model, weights, order=order)), len(model.F), processors)
