"""Why nothing can be said of a method, or a scenario, on some parts: their files have no time for an operation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence


def no_time_note(lacking: Mapping[str, Sequence[str]]) -> str:
    """One line for all of these parts; empty if there are none.

    lacking: by the name of a part, the operations that it has no time for.
    """
    parts: dict[str, list[str]] = {}
    for name, operations in lacking.items():
        parts.setdefault(" and ".join(operations), []).append(name)
    named = ", ".join(f"for {operations} on {', '.join(names)}" for operations, names in parts.items())
    return f"no time {named}: add it to a copy of the file, see `reason` in --format json" if parts else ""
