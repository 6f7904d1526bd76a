"""Does the optimal gain stay fairly constant for several consecutive measurements, as the patent says?"""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray

CONSTANT = 0.05
"""A change up to which a gain is called fairly constant."""


def changes(gains: FloatArray, n: int) -> FloatArray:
    """By how much of itself the gain changes in n steps: of each step but the last n, the largest among the states.

    gains (steps + 1, states, measurements). Of a state, the norm of the difference of its row over the norm of the
    later row.
    """
    later = gains[n:]
    change: FloatArray = np.linalg.norm(later - gains[:-n], axis=2) / np.linalg.norm(later, axis=2)
    largest: FloatArray = change.max(axis=1)
    return largest


def constant_from(change: FloatArray, limit: float = CONSTANT) -> int:
    """The step from which on no change is above the limit."""
    return int(np.max(np.flatnonzero(change > limit), initial=-1)) + 1
