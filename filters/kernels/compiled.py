"""Run kernels compiled by numba: a clone of the function in which everything it calls is compiled into it.

numba is imported when the first function is compiled, for its import costs half a second.

Everything is inlined. Otherwise taking a record of arrays apart at each call costs more in reference counts than the
arithmetic of a 9-state step. Hence the two versions of a function: `compiled`, to be called from Python and kept on
disk, and `inlined`, to be called by compiled code, which is only ever a part of a compiled function. (Machine code
read from the disk cannot be inlined: if the parts were cached too, the speed would depend on what the cache held.)

Most of the time to compile goes into parts that nobody calls, at every level of nesting anew. So a part can be called
from compiled code only, and is not optimised before it is inlined, save for the kernels: LLVM vectorises their loops
only while they stand alone, without which the dense inverse takes half as long again.

Machine code is kept in the user's cache folder. numba's own cache looks only at the file of the outermost function
and so goes stale when a callee in another file changes; here the folder's name carries a hash of the sources of all
functions involved. Functions passed as arguments (those of a system model) are part of a signature, and numba finds
them again in another process by an identity that is derived from the same hash.
"""

from __future__ import annotations

import hashlib
import inspect
import os
import uuid
from importlib import import_module
from pathlib import Path
from types import FunctionType
from typing import Any

import numpy as np

from filters.kernels.disk_cache import keep_on_disk
from filters.kernels.rebind import callees, named_values, rebind

# Functions in these modules neither allocate nor return arrays. numba need not count references in them, which it would
# do for every array taken out of a record, and LLVM would not remove all of it: half the time of a short update.
_PARTS = ("kernels", "covariance_forms", "factored", "robust", "modular")
_ALLOCATION_FREE = tuple(f"filters.{part}." for part in _PARTS)

_COMPILED: dict[FunctionType, Any] = {}
_INLINED: dict[FunctionType, Any] = {}


def compiled(function: FunctionType) -> Any:
    """The numba version of a plain function for callers in Python; compiled when called with arguments of new types.

    Functions in its arguments must be the `inlined` versions. Same function in, same object out, so that nothing is
    compiled twice. Floating-point operations are neither reordered nor fused, so that results agree with the plain
    function to the last bits; division by zero gives inf.
    """
    if function not in _COMPILED:
        parts = {callee: inlined(callee) for callee in callees(function).values() if callee is not function}
        _COMPILED[function] = rebind(function, _kept_on_disk, parts)
    return _COMPILED[function]


def inlined(function: FunctionType) -> Any:
    """The numba version of a plain function for callers in compiled code, such as a job given to a timing loop."""
    return rebind(function, _inlined, _INLINED)


def source_hash(function: FunctionType) -> str:
    """A hash of the source of a function and of all that it calls, in whatever file, and of the constants they name.

    numba writes constants of a module or a closure, arrays too, into the machine code.
    """
    digest = hashlib.sha256(Path(__file__).read_bytes())  # the way of compiling counts too
    for item in _with_callees(function, {}):
        digest.update(f"{item.__module__}.{item.__qualname__}\n{_source(item)}\n".encode())
        for name, value in named_values(item).items():
            if isinstance(value, np.ndarray):
                digest.update(f"{name} {value.dtype} {value.shape}".encode() + value.tobytes())
            elif isinstance(value, int | float | complex | str | tuple):
                digest.update(f"{name} {value!r}".encode())
    return digest.hexdigest()[:24]


def cache_folder(function: FunctionType) -> Path:
    """Where the machine code of a function is kept: $XDG_CACHE_HOME/sched_sim/numba/NAME-HASH."""
    home = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(home) / "sched_sim" / "numba" / f"{function.__name__}-{source_hash(function)}"


def _kept_on_disk(clone: FunctionType, original: FunctionType) -> Any:
    dispatcher = _jit(clone)
    keep_on_disk(dispatcher, cache_folder(original))
    return dispatcher


def _inlined(clone: FunctionType, original: FunctionType) -> Any:
    module = original.__module__
    options = {} if module.startswith("filters.kernels.") else {"pipeline_class": _compiler_without_optimiser}
    dispatcher = _jit(
        clone,
        forceinline=True,
        no_cpython_wrapper=True,
        no_cfunc_wrapper=True,
        _nrt=not module.startswith(_ALLOCATION_FREE),
        **options,
    )
    identity = uuid.uuid5(uuid.NAMESPACE_URL, f"sched_sim:{original.__qualname__}:{source_hash(original)}")
    dispatcher._set_uuid(str(identity))
    return dispatcher


def _compiler_without_optimiser(typing: Any, target: Any, _library: None, *rest: Any) -> Any:
    library = target.codegen().create_library("part")
    library._optimize_final_module = lambda: None
    return import_module("numba.core.compiler").Compiler(typing, target, library, *rest)


def _jit(clone: FunctionType, **options: Any) -> Any:
    njit: Any = import_module("numba").njit
    return njit(error_model="numpy", **options)(clone)


def _with_callees(function: FunctionType, found: dict[FunctionType, None]) -> dict[FunctionType, None]:
    if function not in found:
        found[function] = None
        for callee in callees(function).values():
            _with_callees(callee, found)
    return found


def _source(function: FunctionType) -> str:
    """The function's source, or its byte code where it was made without a file."""
    try:
        return inspect.getsource(function)
    except OSError:
        return f"{function.__code__.co_code.hex()} {function.__code__.co_consts!r}"
