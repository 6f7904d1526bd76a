"""Whether a name that is given is one of those that there are."""

from __future__ import annotations

from collections.abc import Iterable


def check_choice(name: str, value: object, choices: Iterable[str]) -> None:
    """Raises ValueError, naming the argument, unless the value is one of the choices."""
    if not (isinstance(value, str) and value in choices):
        raise ValueError(f"{name}={value!r} is unknown; give one of {', '.join(choices)}")
