"""Run kernels compiled by numba: a clone of the function in which everything it calls is compiled into it.

numba is imported when the first function is compiled, for its import costs half a second.

Everything is inlined. Otherwise taking a record of arrays apart at each call costs more in reference counts than the
arithmetic of a 9-state step. Hence the two versions of a function: `compiled`, to be called from Python and kept on
disk, and `inlined`, to be called by compiled code, which is only ever a part of a compiled function. (Machine code
read from the disk cannot be inlined: if the parts were cached too, the speed would depend on what the cache held.)

Most of the time to compile goes into parts that nobody calls, at every level of nesting anew. So a part can be called
from compiled code only, and is not optimised before it is inlined, save for the kernels: LLVM vectorises their loops
only while they stand alone, without which the dense inverse takes half as long again.

Machine code is kept in the user's cache folder (`disk_cache`) under the digest of all that it depends on. Functions
passed as arguments (those of a system model) are part of a signature, and known in another process by their digests.
"""

from __future__ import annotations

from importlib import import_module
from types import FunctionType
from typing import Any
from uuid import NAMESPACE_URL, uuid5

from filters.backends.dependencies import Dependencies
from filters.backends.disk_cache import DiskCache
from filters.backends.rebind import Versions
from filters.backends.said import says


def compiled(function: FunctionType) -> Any:
    """The numba version of a plain function for callers in Python; compiled when called with arguments of new types.

    Functions in its arguments must be the `inlined` versions. As long as nothing changes that the function depends on,
    the same object comes out, so that nothing is compiled twice. Floating-point operations are neither reordered nor
    fused, so that results agree with the plain function to the last bits; division by zero gives inf.
    """
    return _COMPILED.of(function)


def machine_code(function: FunctionType, *arguments: Any) -> Any:
    """What `compiled` calls for arguments of these types: to be called with such, and with no others. To find out types
    anew, which it leaves out, takes 200 us for the records of a filter, and drives them out of the caches."""
    version = compiled(function)
    if isinstance(version, FunctionType):  # with NUMBA_DISABLE_JIT
        return version
    typeof: Any = import_module("numba").typeof
    return version.compile(tuple(map(typeof, arguments)))


def inlined(function: FunctionType) -> Any:
    """The numba version of a plain function for callers in compiled code, such as a job given to a timing loop."""
    return _INLINED.of(function)


def _kept_on_disk(clone: FunctionType, _original: FunctionType, known: Dependencies) -> Any:
    version = _jit(clone)
    if not known.opaque:
        version._cache = DiskCache(clone.__name__, known.digest)
    return version


def _inlined(clone: FunctionType, _original: FunctionType, known: Dependencies) -> Any:
    alone = says(clone.__module__, "OPTIMISED_ALONE")
    options = {} if alone else {"pipeline_class": _compiler_without_optimiser}
    version = _jit(
        clone,
        forceinline=True,
        no_cpython_wrapper=True,
        no_cfunc_wrapper=True,
        _nrt=not says(clone.__module__, "ALLOCATION_FREE"),
        **options,
    )
    if not (known.opaque or isinstance(version, FunctionType)):  # with NUMBA_DISABLE_JIT, numba gives a plain function
        version.digest = known.digest
        version._set_uuid(str(uuid5(NAMESPACE_URL, f"sched_sim:{known.digest}")))
    return version


_INLINED = Versions(_inlined)
_COMPILED = Versions(_kept_on_disk, parts=_INLINED)


def _compiler_without_optimiser(typing: Any, target: Any, _library: None, *rest: Any) -> Any:
    library = target.codegen().create_library("part")
    library._optimize_final_module = lambda: None
    return import_module("numba.core.compiler").Compiler(typing, target, library, *rest)


def _jit(clone: FunctionType, **options: Any) -> Any:
    njit: Any = import_module("numba").njit
    return njit(error_model="numpy", **options)(clone)
