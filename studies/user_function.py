"""What a function of the user's own returns, named on the command line as package.module:function."""

from __future__ import annotations

import importlib
import sys
from importlib.machinery import PathFinder
from importlib.util import module_from_spec
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

from sched_sim.errors import InputError


class Returned(NamedTuple):
    """function: its name in its module; value: what it returned."""

    function: str
    value: Any


def returned_by(name: str, option: str, how: str) -> Returned:
    """Call the function `package.module:function`, without arguments. The current folder is searched first for the
    module, and last for what that imports in turn: a file there hides no library.

    option: the one that names it, for messages; how: what to give.
    Raises InputError that says what is wrong with the name or the module, or how the function failed.
    """
    said = f"{option} {name!r}"
    module_name, colon, function_name = name.partition(":")
    if not (colon and module_name and function_name):
        raise InputError(f"{said}: {how}")
    try:
        module = _imported(module_name, str(Path.cwd()))
    except Exception as error:
        raise InputError(f"{said}: module {module_name!r} cannot be imported ({error}); {how}") from error
    function: Any = getattr(module, function_name, None)
    if not callable(function):
        raise InputError(f"{said}: module {module_name!r} has no function {function_name!r}; {how}")
    try:
        return Returned(function_name, function())
    except Exception as error:
        raise InputError(f"{said}: {function_name}() failed: {error}") from error


def _imported(name: str, folder: str) -> ModuleType:
    sys.path.append(folder)
    root = name.partition(".")[0]
    spec = PathFinder.find_spec(root, [folder])
    if root not in sys.modules and spec is not None and spec.loader is not None:
        sys.modules[root] = module = module_from_spec(spec)
        try:
            spec.loader.exec_module(module)
        except BaseException:
            del sys.modules[root]
            raise
    return importlib.import_module(name)
