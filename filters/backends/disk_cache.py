"""Machine code kept on disk: one file for each function and signature, named by a digest of all that it depends on.

numba's own cache looks only at the file of the outermost function, and so goes stale when a constant or a callee in
another file changes; it keeps one index for several signatures, which two processes that write at once confuse; and it
trusts whatever it reads. Here nothing ever goes stale, files are written whole, and what is unreadable, damaged or
might have been written by another user counts as absent. At worst a function is compiled again.
"""

from __future__ import annotations

import hashlib
import os
import pickle
import re
import stat
import sys
import tempfile
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np


class DiskCache:
    """What a numba dispatcher asks of its cache, for the function of this digest."""

    def __init__(self, name: str, digest: str) -> None:
        self._name = re.sub(r"\W", "_", name)[:60]
        self._digest = digest
        self.cache_path = cache_folder()

    def load_overload(self, signature: Any, target_context: Any) -> Any:
        target_context.refresh()
        with suppress(Exception):
            path = self._path(signature, target_context.codegen())
            payload = _read(path)
            return import_module("numba.core.compiler").CompileResult._rebuild(target_context, *pickle.loads(payload))
        return None

    def save_overload(self, signature: Any, result: Any) -> None:
        with suppress(Exception):
            path = self._path(signature, result.library.codegen)
            if not (result.lifted or result.library.has_dynamic_globals):
                _write(path, import_module("numba.core.serialize").dumps(result._reduce()))

    def flush(self) -> None:
        """Nothing to do: what is kept is never out of date."""

    def _path(self, signature: tuple[Any, ...], codegen: Any) -> Path:
        """Raises ValueError if there is no folder, or a type in the signature is of a kind that is not kept."""
        if self.cache_path is None:
            raise ValueError("no cache folder")
        key = repr((self._digest, [_told(item) for item in signature], codegen.magic_tuple(), _settings()))
        return self.cache_path / f"{self._name}-{hashlib.sha256(key.encode()).hexdigest()[:40]}.nbc"


def cache_folder() -> Path | None:
    """$XDG_CACHE_HOME/sched_sim/numba, or that in ~/.cache; None for a user without a home."""
    home = os.environ.get("XDG_CACHE_HOME", "")
    try:
        root = Path(home) if os.path.isabs(home) else Path.home() / ".cache"
    except RuntimeError:
        return None
    return root / "sched_sim" / "numba"


def _told(item: Any) -> Any:
    """A numba type in words that say all of it; raises ValueError for kinds of types that words may not tell apart."""
    types: Any = import_module("numba").types
    if isinstance(item, types.Dispatcher):
        if (digest := getattr(item.dispatcher, "digest", None)) is None:
            raise ValueError(f"{item} is not kept")
        return "function", digest
    if isinstance(item, types.ExternalFunctionPointer):  # its address is an argument
        return "function of C", str(item.sig), str(item.cconv)
    if isinstance(item, types.BaseTuple):
        kind = getattr(item, "instance_class", tuple)
        names = (kind.__module__, kind.__qualname__, *getattr(kind, "_fields", ()))
        return type(item).__name__, names, [_told(part) for part in item]
    if isinstance(item, types.Omitted):
        return "default"
    if isinstance(item, types.Array):
        if not isinstance(item.dtype, types.Number | types.Boolean | types.Record):
            raise ValueError(f"{item} is not kept")
        return "array", str(item)
    if isinstance(item, types.Number | types.Boolean | types.NoneType | types.UnicodeType):
        return type(item).__name__, str(item)
    raise ValueError(f"{item} is not kept")


def _settings() -> str:
    """What else machine code depends on: versions, numba's settings, and the way of compiling."""
    numba: Any = import_module("numba")
    settings = {name: repr(value) for name, value in vars(numba.config).items() if name.isupper()}
    passing = {"CACHE_DIR", "NUMBA_NUM_THREADS", "NUMBA_DEFAULT_NUM_THREADS"}
    here = Path(__file__).parent
    sources = [(here / f"{name}.py").read_bytes() for name in ("compiled", "disk_cache", "rebind")]
    return repr(
        (
            sys.version,
            sys.flags.optimize,
            np.__version__,
            numba.__version__,
            import_module("llvmlite").__version__,
            sorted((name, value) for name, value in settings.items() if name not in passing),
            hashlib.sha256(b"".join(sources)).hexdigest(),
        )
    )


def _read(path: Path) -> bytes:
    """The payload of a file of ours; raises OSError or ValueError if there is none, or it is damaged or not ours."""
    status = path.lstat()
    if not stat.S_ISREG(status.st_mode) or status.st_uid not in (0, os.geteuid()) or status.st_mode & 0o022:
        raise ValueError(f"{path} may have been written by someone else")
    content = path.read_bytes()
    checksum, payload = content[:32], content[32:]
    if checksum != _checksum(path, payload):
        raise ValueError(f"{path} is damaged")
    return payload


def _write(path: Path, payload: bytes) -> None:
    """Write the file whole or not at all, for this user alone."""
    path.parent.mkdir(parents=True, exist_ok=True)
    number, name = tempfile.mkstemp(dir=path.parent, prefix=f"{path.name}-")
    try:
        with open(number, "wb") as file:
            file.write(_checksum(path, payload) + payload)
        os.replace(name, path)
    except BaseException:
        os.unlink(name)
        raise


def _checksum(path: Path, payload: bytes) -> bytes:
    return hashlib.sha256(path.name.encode() + payload).digest()
