"""Running kernels that hold the user's functions."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from filters.kernels.numba_error import gist, is_numbas


@contextmanager
def running() -> Iterator[None]:
    """Without warnings, for a breakdown is found by what it leaves.

    Raises:
        ValueError: numba cannot compile a function; it says which line and why.
    """
    try:
        with np.errstate(all="ignore"):
            yield
    except Exception as error:
        if is_numbas(error):
            raise ValueError(
                f"backend='compiled': numba cannot compile the filter: {gist(error)}; mend that line, or use "
                f"backend='reference'"
            ) from error
        raise
