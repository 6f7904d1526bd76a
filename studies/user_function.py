"""What a function of the user's own returns, named on the command line as package.module:function."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

from sched_sim.errors import InputError


class Returned(NamedTuple):
    """function: its name in its module; value: what it returned."""

    function: str
    value: Any


def returned_by(name: str, option: str, how: str) -> Returned:
    """Call the function `package.module:function`, without arguments. Its module is looked for in the current folder
    first; the modules that it imports, among the installed ones first, so that a file of the user's, say numba.py, does
    not take the place of a library.

    option: the one that names it, for messages; how: what to give.
    Raises InputError that says what is wrong with the name or the module, or how the function failed.
    """
    said = f"{option} {name!r}"
    module_name, colon, function_name = name.partition(":")
    if not (colon and module_name and function_name):
        raise InputError(f"{said}: {how}")
    with explained(f"{said}: module {module_name!r} cannot be imported", f"; {how}"):
        module = _imported(module_name)
    function: Any = getattr(module, function_name, None)
    if not callable(function):
        raise InputError(f"{said}: module {module_name!r} has no function {function_name!r}; {how}")
    with explained(f"{said}: {function_name}() failed"):
        return Returned(function_name, function())


@contextmanager
def explained(what: str, remedy: str = "") -> Iterator[None]:
    """Whatever the user's code raises within, or that it would end the program, becomes an InputError."""
    try:
        yield
    except (Exception, SystemExit, GeneratorExit) as error:
        raise InputError(f"{what}: {_said(error)}{remedy}") from error


def _said(error: BaseException) -> str:
    """The kind of error and its message, on one line."""
    if isinstance(error, SystemExit):
        return f"it ends the program, with sys.exit({error.code!r})"
    if isinstance(error, InputError):
        return str(error)
    try:
        return " ".join(f"{type(error).__name__}: {error}".split())
    except Exception:
        return type(error).__name__


def _imported(name: str) -> ModuleType:
    here = Path.cwd()
    if str(here) not in sys.path:
        sys.path.append(str(here))
    top = name.partition(".")[0]
    own = next((path for path in (here / f"{top}.py", here / top / "__init__.py") if path.is_file()), None)
    loaded = sys.modules.get(top)
    if own is not None and (loaded is None or getattr(loaded, "__file__", None) != str(own)):
        if loaded is not None or top in sys.stdlib_module_names or _is_installed(top, own):
            raise ImportError(f"{own} has the name of another module that is installed; give it another name")
        _load(top, own)
    return importlib.import_module(name)


def _is_installed(top: str, own: Path) -> bool:
    found = importlib.util.find_spec(top)
    return found is not None and found.origin not in (None, str(own))


def _load(top: str, path: Path) -> None:
    """As `import top` does, from this file."""
    inside = [str(path.parent)] if path.name == "__init__.py" else None
    spec = importlib.util.spec_from_file_location(top, path, submodule_search_locations=inside)
    assert spec is not None
    assert spec.loader is not None
    sys.modules[top] = module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[top]
        raise
