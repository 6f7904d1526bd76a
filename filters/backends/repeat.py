"""Run a job many times within one compiled call."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


def repeat(job: Callable[..., Any], arguments: tuple[Any, ...], times: int) -> None:
    """job(*arguments), many times; to be run as `function_for("compiled", repeat)`, into which the job is inlined.

    Rotate the arguments between calls, not within: picking one of several records inside the loop costs as much in
    reference counts as the job itself.
    """
    for _ in range(times):
        job(*arguments)
