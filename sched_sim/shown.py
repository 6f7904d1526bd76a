"""What a notebook shows of a value: more than its table, where a package that can draw it is installed."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from importlib.metadata import entry_points

GROUP = "sched_sim.shown"
"""Of the entry points: functions that make HTML of a value and of its table, by the name of the value's class."""


@cache
def drawing(name: str) -> Callable[[object, str], str] | None:
    """Of values of the class with this name."""
    found = [*entry_points(group=GROUP, name=name)]
    drawn: Callable[[object, str], str] | None = found[0].load() if found else None
    return drawn
