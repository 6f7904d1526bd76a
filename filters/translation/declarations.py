"""Declarations in C."""

from __future__ import annotations

from collections.abc import Callable

from filters.translation.kinds import Array, Flag, Int, Kind, Nothing, Real, Record


def scalar(kind: Kind) -> str | None:
    """The type in C of what is no array and no record."""
    match kind:
        case Real():
            return "real"
        case Int():
            return "int"
        case Flag():
            return "bool"
        case Nothing():
            return "void"
    return None


def pointer(kind: Array, name: str) -> str:
    """A variable that points to the rows of an array."""
    inner = "".join(f"[{length or 1}]" for length in kind.inner)
    return f"{kind.item} (*{name}){inner}" if inner else f"{kind.item} *{name}"


def parameter(kind: Array, name: str, *, apart: bool) -> str:
    """An array as a parameter. apart: whether it shares no memory with others."""
    lengths = ["" if length is None else str(length or 1) for length in (kind.shape[0], *kind.inner)]
    if apart:
        lengths[0] = f"restrict {lengths[0]}".rstrip()
    return f"{kind.item} {name}" + "".join(f"[{length}]" for length in lengths)


def memory(kind: Array, name: str) -> str:
    """An array itself."""
    return f"{kind.item} {name}" + "".join(f"[{length or 1}]" for length in kind.shape)


def variable(kind: Kind, name: str, record_name: Callable[[Record], str]) -> str:
    """A variable, or a field of a record."""
    match kind:
        case Array():
            return pointer(kind, name)
        case Record():
            return f"{record_name(kind)} {name}"
    return f"{scalar(kind)} {name}"
