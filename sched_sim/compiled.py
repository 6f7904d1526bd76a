"""Plain functions compiled by numba, each together with all that it calls.

The source stays undecorated, and runs in Python as it is. numba is imported as the first function is compiled. Machine
code is kept in the user's cache folder, under the hash of the sources it rests on: numba's own cache looks only at the
file of the outermost function, and goes stale where one that it calls is changed.

What is called becomes part of its caller, once for all types of literal numbers; and where no array is made, references
to arrays are not counted: the event loop of a simulation is sixty times as fast for it.
"""

from __future__ import annotations

import hashlib
import os
import pickle
import sys
import tempfile
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from importlib import import_module
from pathlib import Path
from types import FunctionType
from typing import Any, TypeVar

F = TypeVar("F", bound=Callable[..., Any])


def compiles() -> bool:
    """Whether numba does: with NUMBA_DISABLE_JIT it gives plain functions."""
    return not import_module("numba").config.DISABLE_JIT


@cache
def compiled(function: F, *, makes_arrays: bool = False) -> F:
    """The numba version, compiled as it is called with arguments of new types.

    It and what it calls are plain functions, named as they were imported (`push`, not `heap.push`), of which none calls
    itself, that work on whole numbers, which have 64 bits, and on arrays; an index out of range is not checked. What
    they name besides is numbers. makes_arrays: whether one of them does; else all come in as arguments.
    """
    reached = _reached(function)
    version = _version(function, makes_arrays, {})
    if hasattr(version, "_cache"):  # it is no plain function
        with suppress(OSError, RuntimeError):  # of a source that cannot be read, and of a user without a home
            version._cache = _Kept(function.__name__, _hash(reached, makes_arrays))
    return version  # type: ignore[no-any-return]  # numba's, of the same signature


def _named(function: Any) -> dict[str, Any]:
    """What the names in a function stand for."""
    return {name: function.__globals__[name] for name in function.__code__.co_names if name in function.__globals__}


def _reached(function: Any) -> list[Any]:
    """The function and all that it calls, at any depth."""
    reached = [function]
    for each in reached:
        reached += [
            value for value in _named(each).values() if isinstance(value, FunctionType) and value not in reached
        ]
    return reached


def _version(function: Any, makes_arrays: bool, made: dict[Any, Any]) -> Any:
    """numba's, of a copy that calls copies. made: those that are there already."""
    if function not in made:
        names = dict(function.__globals__)
        copy = FunctionType(function.__code__, names, function.__name__, function.__defaults__)
        part = {"no_cpython_wrapper": True, "no_cfunc_wrapper": True, "forceinline": True} if made else {}
        numba: Any = import_module("numba")
        made[function] = version = numba.njit(error_model="numpy", _nrt=makes_arrays, **part)(copy)
        if hasattr(version, "get_call_template"):
            template = version.get_call_template
            version.get_call_template = lambda args, named: template(
                [numba.types.unliteral(arg) for arg in args], named
            )
        callees = {name: value for name, value in _named(function).items() if isinstance(value, FunctionType)}
        names.update({name: _version(callee, makes_arrays, made) for name, callee in callees.items()})
    return made[function]


def _hash(functions: list[Any], *options: object) -> str:
    """Of the files that functions are in, of the values that they name, and of what compiles them."""
    files = sorted({function.__code__.co_filename for function in functions} | {__file__})
    values = [
        (function.__qualname__, name, value)
        for function in functions
        for name, value in _named(function).items()
        if isinstance(value, int | float | tuple)
    ]
    versions = [import_module(name).__version__ for name in ("numba", "llvmlite", "numpy")]
    told = repr((sys.version, versions, options, values, [Path(file).read_bytes() for file in files]))
    return hashlib.sha256(told.encode()).hexdigest()


class _Kept:
    """What a numba dispatcher asks of its cache: a file for each signature, written whole, that counts as absent where
    it is damaged or another user's."""

    def __init__(self, name: str, digest: str) -> None:
        home = os.environ.get("XDG_CACHE_HOME", "")
        root = Path(home) if os.path.isabs(home) else Path.home() / ".cache"
        self.name, self.cache_path = name, root / "sched_sim" / "compiled" / digest[:32]

    def _file(self, signature: Any, codegen: Any) -> Path:
        key = hashlib.sha256(repr((signature, codegen.magic_tuple())).encode()).hexdigest()
        return self.cache_path / f"{self.name}-{key[:32]}.nbc"

    def load_overload(self, signature: Any, target_context: Any) -> Any:
        target_context.refresh()
        with suppress(Exception):
            file = self._file(signature, target_context.codegen())
            if file.stat().st_uid not in (0, os.geteuid()) or file.stat().st_mode & 0o022:
                return None
            content = file.read_bytes()
            if hashlib.sha256(content[32:]).digest() == content[:32]:
                result = import_module("numba.core.compiler").CompileResult
                return result._rebuild(target_context, *pickle.loads(content[32:]))
        return None

    def save_overload(self, signature: Any, result: Any) -> None:
        with suppress(Exception):
            code = import_module("numba.core.serialize").dumps(result._reduce())
            self.cache_path.mkdir(parents=True, exist_ok=True)
            number, name = tempfile.mkstemp(dir=self.cache_path)
            try:
                with open(number, "wb") as file:
                    file.write(hashlib.sha256(code).digest() + code)
                os.replace(name, self._file(signature, result.library.codegen))
            finally:
                Path(name).unlink(missing_ok=True)
