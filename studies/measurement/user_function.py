"""What a function of the user's own returns, named on the command line as package.module:function."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from collections.abc import Iterator
from contextlib import chdir, contextmanager, redirect_stdout
from importlib.machinery import PathFinder
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

from sched_sim.errors import InputError
from sched_sim.text import did_you_mean
from studies.measurement.failed_line import failed_line, shown_path


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
    if "/" in module_name or "\\" in module_name:
        dotted = ".".join(Path(module_name.replace("\\", "/").removesuffix(".py")).parts)
        raise InputError(
            f"{said}: {module_name!r} is a path, not the name of a module; in the folder that holds it write "
            f"{dotted.lstrip('./')}:{function_name}"
        )
    with _current_folder_last() as here, chdir(here):
        with explained(f"{said}: module {module_name!r} cannot be imported", f"; {how}"):
            module = _imported(module_name, here)
        function: Any = getattr(module, function_name, None)
        if not callable(function):
            raise InputError(f"{said}: {_no_function(module, function_name)}; {how}")
        with explained(f"{said}: {function_name}() failed"):
            return Returned(function_name, function())


@contextmanager
def _current_folder_last() -> Iterator[Path]:
    """On the path of modules while the user's are imported."""
    here = Path.cwd()
    sys.path.append(str(here))
    try:
        yield here
    finally:
        sys.path.reverse()
        sys.path.remove(str(here))
        sys.path.reverse()


@contextmanager
def explained(what: str, remedy: str = "") -> Iterator[None]:
    """Whatever the user's code raises within, or that it would end the program, becomes an InputError, but Ctrl-C. What
    it prints goes to standard error: standard output is for results."""
    try:
        with redirect_stdout(sys.stderr):
            yield
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        raise InputError(f"{what}: {_said(error)}{remedy}") from error


def _said(error: BaseException) -> str:
    """Its kind, its message on one line, and the line of the user's that it is from; what a check of this project says
    of what the user gave, is said without its kind."""
    line = failed_line(error)
    place = line and f" ({line})"
    if isinstance(error, SystemExit):
        return f"it ends the program, with sys.exit({error.code!r}){place}"
    try:
        message = " ".join(str(error).split())
    except Exception:
        message = ""
    said_by_itself = not line and message and isinstance(error, ValueError | RuntimeError | ImportError)
    kind = "" if said_by_itself else f"{type(error).__name__}{message and ': '}"
    return f"{kind}{message}{place}"


def _no_function(module: ModuleType, name: str) -> str:
    """What there is in place of it, and where."""
    there = [
        other
        for other, value in vars(module).items()
        if not other.startswith("_") and callable(value) and getattr(value, "__module__", None) == module.__name__
    ]
    file = getattr(module, "__file__", None)
    where = f" ({shown_path(Path(file))})" if file else ""
    what = (
        f"it has {', '.join(there[:MOST_NAMED])}{', ...' if len(there) > MOST_NAMED else ''}"
        if there
        else "it has none"
    )
    if hasattr(module, name):
        what = f"{name} is a {type(getattr(module, name)).__name__} there, and {what}"
    return f"module {module.__name__!r}{where} has no function {name!r}: {did_you_mean(name, there)}{what}"


MOST_NAMED = 8
"""Functions of a module."""


def _imported(name: str, here: Path) -> ModuleType:
    """Raises ImportError where a file in the current folder has the name of an installed module."""
    top = name.partition(".")[0]
    own = next((path for path in (here / f"{top}.py", here / top / "__init__.py") if path.is_file()), None)
    if own is not None and getattr(sys.modules.get(top), "__file__", None) != str(own):
        if top in sys.stdlib_module_names or PathFinder.find_spec(top, _installed(here)) is not None:
            raise ImportError(f"{own} has the name of another module that is installed; give it another name")
        for loaded in [module for module in sys.modules if module.partition(".")[0] == top]:  # of another folder
            del sys.modules[loaded]
        _load(top, own)
    return importlib.import_module(name)


def _installed(here: Path) -> list[str]:
    """The path of modules without the current folder."""
    return [entry for entry in sys.path if entry and Path(entry) != here]


def _load(top: str, path: Path) -> None:
    """The import of `top`, from this file."""
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
