"""A matrix that F or Q returned is still read in the step after it, when those of two steps are made from it.

A model that fills memory of its own in place of making a new matrix each time needs two of each, in turn. With one, the
product would be that of the newer matrix with itself, and nothing but the estimates would tell.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from filters.arrays import FloatArray
from filters.system import System
from filters.systems.trial import UNWRITTEN


def check_turns(system: System, x: FloatArray, u: FloatArray) -> None:
    """Call F and Q in steps 0 and 1, at the state x (n,) with the input u (m,). What one raises comes through.

    Raises:
        ValueError: in step 1 one fills the matrix that it returned in step 0.
    """
    parameters = system.parameters
    steps: tuple[tuple[str, str, Callable[[int], FloatArray]], ...] = (
        ("F", "F(j, x, u, p)", lambda j: system.F(j, x, u, parameters)),
        ("Q", "Q(j, p)", lambda j: system.Q(j, parameters)),
    )
    for name, signature, matrix in steps:
        if _overwritten(matrix):
            raise ValueError(
                f"{signature} fills in step 1 the matrix that it returned in step 0, which filters still read: keep "
                f"two and fill them in turn, such as p.scratch.{name}[j % 2] of shape (2, n, n)"
            )


def _overwritten(matrix: Callable[[int], FloatArray]) -> bool:
    first = matrix(0)
    if first.dtype != np.float64 or not first.flags.writeable:
        return False
    kept = first.copy()
    first.fill(UNWRITTEN)
    try:
        with np.errstate(all="ignore"):
            matrix(1)
        return bool((first != UNWRITTEN).any())
    finally:
        first[...] = kept
