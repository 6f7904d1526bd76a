"""Values that are equal where what is in them is, so that what was computed of one can be kept for the other."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

import numpy as np

Value = TypeVar("Value")


@dataclass(frozen=True, slots=True, eq=False)
class Same(Generic[Value]):
    """A value, and what it is known by."""

    value: Value
    contents: Hashable

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Same) and self.contents == other.contents

    def __hash__(self) -> int:
        return hash(self.contents)


def contents(value: Any) -> Hashable:
    """Of an array its numbers, of a tuple the contents of each; anything else itself."""
    if isinstance(value, np.ndarray):
        return value.shape, value.tobytes()
    return tuple(map(contents, value)) if isinstance(value, tuple) else value


def itself(value: Value) -> Same[Value]:
    """Known by being that very object, which is kept as long as what was computed of it."""
    return Same(value, id(value))
