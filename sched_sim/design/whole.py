"""Whole numbers as the closed form computes with them: one of Python's, which needs no numpy, or a whole array.

What operators do not say of both alike is said here. Of arrays it is what numpy's function of that kind does.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias, TypeVar

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

Ints: TypeAlias = "npt.NDArray[np.int64]"
"""An array of integers: int64, or (dtype=object, which types do not tell apart) Python's, which cannot overflow."""

Flags: TypeAlias = "npt.NDArray[np.bool_]"

Whole = TypeVar("Whole", int, "Ints")
"""One number, or an array of them."""


def where(condition: bool | Flags, yes: Whole, no: Whole | int) -> Whole:
    """`yes` where the condition holds, else `no`."""
    if isinstance(yes, int):
        return yes if condition else no
    import numpy as np

    return np.where(condition, yes, no)


def larger(first: Whole, second: Whole | int) -> Whole:
    if isinstance(first, int):
        return first if first >= second else second
    import numpy as np

    return np.maximum(first, second)


def filled(like: Whole, number: int) -> Whole:
    """The number, in the shape of `like`."""
    if isinstance(like, int):
        return number
    import numpy as np

    return np.full(like.shape, number)
