"""How often compiled code asks for memory: a new array takes as long as tens of multiplications, and counts hide it."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

from filters.backends.choose import arguments_for, function_for
from filters.backends.repeat import repeat

MANY = 8


def allocations(function: Callable[..., Any], arguments: tuple[Any, ...]) -> int:
    """New arrays and lists that one call of function(*arguments), compiled, makes, those that it drops again too.

    What numba makes of the arguments at a call from Python is not counted.
    """
    loop = function_for("compiled", repeat)
    job, given = arguments_for("compiled", (function, arguments))

    def asked(times: int) -> int:
        before: int = runtime.memsys_get_stats_mi_alloc()
        loop(job, given, times)
        after: int = runtime.memsys_get_stats_mi_alloc()
        return after - before

    runtime = import_module("numba.core.runtime._nrt_python")
    were_counted = runtime.memsys_stats_enabled()
    loop(job, given, 1)
    runtime.memsys_enable_stats()
    try:
        return (asked(1 + MANY) - asked(1)) // MANY
    finally:
        if not were_counted:
            runtime.memsys_disable_stats()
