"""The one error that is the user's to mend, and how its message names what they gave."""

from __future__ import annotations

from collections.abc import Callable
from contextvars import ContextVar


class InputError(ValueError):
    """Something the user gave cannot be used: the message names it, its value and the remedy."""


SPELLING: ContextVar[Callable[[str], str]] = ContextVar("SPELLING", default=str)
"""How messages spell the name of an argument: as it is, or within the command line as its flag."""


def option(name: str) -> str:
    """An argument's name, for a message."""
    return SPELLING.get()(name)
