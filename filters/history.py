"""What a run of a filter leaves behind."""

from __future__ import annotations

from typing import NamedTuple

from filters.arrays import FloatArray


class History(NamedTuple):
    """The results of a filter run over steps 0 .. steps.

    x (steps + 1, n): the whole-state estimate at the end of every step.
    P_reference (cycles, n, n): P_{k^-} at k = 0, N, 2N, ...
    innovations (updates, p), gains (updates, n, p): z and K of each measurement that arrived within the run.
    """

    x: FloatArray
    P_reference: FloatArray
    innovations: FloatArray
    gains: FloatArray
