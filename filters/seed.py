"""Seeds of random numbers."""

from __future__ import annotations

import numpy as np


def check_seed(seed: object) -> None:
    """Raises ValueError unless it is a whole number, at least 0."""
    if not isinstance(seed, int | np.integer) or seed < 0:
        raise ValueError(f"seed={seed!r:.60} must be a whole number, at least 0: the same draws the same")
