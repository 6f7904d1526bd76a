"""What a robust step reads and writes."""

from __future__ import annotations

from typing import NamedTuple

from filters.arrays import FloatArray


class Predicted(NamedTuple):
    """The estimate x_{i|i-1} (n,) and its weighting matrix P_{i|i-1} (n, n), which is no covariance of its error."""

    x: FloatArray
    P: FloatArray
