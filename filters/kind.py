"""Whether a system or a filter is one: often it is still the function that makes it, or in the tuple it came in."""

from __future__ import annotations

from types import FunctionType
from typing import Any


def check_kind(name: str, value: Any, kind: type, wanted: str) -> None:
    """Raises ValueError, naming the argument, unless the value is of this kind. wanted: how one is made."""
    if isinstance(value, kind):
        return
    if isinstance(value, FunctionType):
        raise ValueError(
            f"{name} is the function {value.__name__}, not what it returns; call it: {name} = {value.__name__}(...)"
        )
    for at, item in enumerate(value) if isinstance(value, tuple | list) else ():
        if isinstance(item, kind):
            rest = ["x0", "P0", "u"][: len(value) - 1]
            remedy = f"unpack it: {', '.join([name, *rest])} = ..." if at == 0 and rest else f"give item {at} of it"
            raise ValueError(f"{name} is a {type(value).__name__} with the {kind.__name__} in it; {remedy}")
    raise ValueError(f"{name} is {value!r:.60}; give {wanted}")
