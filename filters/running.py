"""A run of a filter that holds functions of the user's."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Literal

import numpy as np

from filters.backends.numba_error import gist, is_numbas
from filters.systems.shaped import misshapen
from filters.systems.structured import unstructured


@contextmanager
def running(what: Literal["filter", "system"]) -> Iterator[None]:
    """Without warnings, for a breakdown is found by what it leaves. what: whose functions they are.

    Raises:
        ValueError: numba cannot compile a function, and it says which line and why; or a `shaped` system gives a matrix
            of another shape, or a `checked` one an entry that it should not have.
    """
    try:
        with np.errstate(all="ignore"), misshapen(), unstructured():
            yield
    except Exception as error:
        if is_numbas(error):
            raise ValueError(
                f"backend='compiled': numba cannot compile the {what}: {gist(error)}; mend that line, or use "
                f"backend='reference'"
            ) from error
        raise
