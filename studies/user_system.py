"""The user's own system, named on the command line as package.module:function."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from typing import Any

from filters.systems.system import System
from sched_sim.errors import InputError

HOW = (
    "name a function without arguments that returns a filters.systems.System, as in --system mymodule:my_system "
    "for a file mymodule.py in this folder"
)


def load_system(name: str) -> System:
    """The system that the function `package.module:function` returns; the current folder is searched first.

    Raises InputError that says what is wrong with the name, the module or what the function returned.
    """
    module_name, colon, function_name = name.partition(":")
    if not (colon and module_name and function_name):
        raise InputError(f"--system {name!r}: {HOW}")
    sys.path.insert(0, str(Path.cwd()))
    try:
        module = importlib.import_module(module_name)
    except ImportError as error:
        raise InputError(f"--system {name!r}: module {module_name!r} cannot be imported ({error}); {HOW}") from None
    function: Any = getattr(module, function_name, None)
    if not callable(function):
        raise InputError(f"--system {name!r}: module {module_name!r} has no function {function_name!r}; {HOW}")
    try:
        system = function()
    except (TypeError, ValueError) as error:
        raise InputError(f"--system {name!r}: {function_name}() failed: {error}") from error
    if not isinstance(system, System):
        raise InputError(f"--system {name!r}: {function_name}() returned a {type(system).__name__}; {HOW}")
    return system
