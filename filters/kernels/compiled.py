"""Run kernels compiled by numba: a clone of the function in which everything it calls is compiled too.

numba is imported when the first function is compiled, for its import costs half a second.

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
from pathlib import Path
from types import FunctionType
from typing import Any

from filters.kernels.rebind import callees, rebind


_VERSIONS: dict[FunctionType, Any] = {}


def compiled(function: FunctionType) -> Any:
    """The numba version of a plain function; it is compiled when first called with arguments of new types.

    Same function in, same object out, so that nothing is compiled twice. Floating-point operations are neither
    reordered nor fused, so that results agree with the plain function to the last bits; division by zero gives inf.
    """
    return rebind(function, _jit, _VERSIONS)


def source_hash(function: FunctionType) -> str:
    """A hash of the source of a function and of all plain functions that it calls, in whatever file."""
    digest = hashlib.sha256()
    for item in _with_callees(function, {}):
        digest.update(f"{item.__module__}.{item.__qualname__}\n{_source(item)}\n".encode())
    return digest.hexdigest()[:24]


def cache_folder(function: FunctionType) -> Path:
    """Where the machine code of a function is kept: $XDG_CACHE_HOME/sched_sim/numba/NAME-HASH."""
    home = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(home) / "sched_sim" / "numba" / f"{function.__name__}-{source_hash(function)}"


def _jit(clone: FunctionType, original: FunctionType) -> Any:
    import numba

    from filters.kernels.disk_cache import keep_on_disk

    # Without inlining, taking a record apart costs more in reference counts than the arithmetic of a 9-state step.
    dispatcher = numba.njit(error_model="numpy", forceinline=True)(clone)
    keep_on_disk(dispatcher, cache_folder(original))
    identity = uuid.uuid5(uuid.NAMESPACE_URL, f"sched_sim:{original.__qualname__}:{source_hash(original)}")
    dispatcher._set_uuid(str(identity))
    return dispatcher


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
