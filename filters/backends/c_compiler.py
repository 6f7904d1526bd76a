"""Shared objects from C: compiled by the compiler of the machine, and kept in the user's cache folder.

One is known by the digest of all that it was made from: the source, the flags, the compiler, and the instructions of
this processor, for a home may be shared by machines. What cannot be loaded, or may have been written by another user,
counts as absent; what cannot be kept is made again.
"""

from __future__ import annotations

import ctypes
import hashlib
import os
import shutil
import stat
import subprocess
import tempfile
from contextlib import suppress
from functools import cache
from pathlib import Path

from filters.backends.disk_cache import cache_folder

SHORT_LOOPS = ("--param", "max-completely-peel-times=8")
"""Rows of 9 to 16 numbers stay loops, which gcc turns into vector instructions; else it unrolls them before that."""

FLAGS = ("-std=c99", "-O3", "-march=native", "-ffp-contract=off", "-fno-math-errno", "-fPIC", "-shared", *SHORT_LOOPS)
"""Operations are neither reordered nor fused."""


class NoCompiler(ValueError):  # noqa: N818 - what is missing, as it reads where it is caught
    """There is none on this machine; the message is the remedy."""


def compiler() -> str:
    """The C compiler: $CC, cc, gcc or clang. Raises NoCompiler if there is none."""
    for name in (os.environ.get("CC", ""), "cc", "gcc", "clang"):
        if name and (path := shutil.which(name)):
            return path
    raise NoCompiler("install gcc or clang, or name one in CC")


@cache
def compiler_version() -> str:
    """The first line of what the compiler says of itself."""
    return _said("--version").partition("\n")[0]


@cache
def library(source: str) -> ctypes.CDLL:
    """The C program, loaded.

    Raises:
        NoCompiler: there is none.
        ValueError: it does not take the program.
    """
    try:
        compiler()
    except NoCompiler as error:
        raise NoCompiler(f"backend='c' needs a C compiler: {error}, or choose backend='compiled'") from None
    folder = cache_folder()
    kept = folder.parent / "c" / f"{_digest(source)}.so" if folder else None
    if kept is not None:
        with suppress(OSError):
            _check_ours(kept)
            return ctypes.CDLL(str(kept))
    with tempfile.TemporaryDirectory() as scratch:
        built = _built(source, Path(scratch))
        if kept is not None:
            with suppress(OSError):
                return ctypes.CDLL(str(_moved(built, kept)))
        return ctypes.CDLL(str(built))


def _built(source: str, scratch: Path) -> Path:
    written, built = scratch / "filter.c", scratch / "filter.so"
    written.write_text(source)
    done = subprocess.run(
        [compiler(), *FLAGS, "-o", built, written, "-lm"], capture_output=True, text=True, check=False
    )
    if done.returncode:
        raise ValueError(f"backend='c': {compiler()} cannot compile what was made of the filter: {done.stderr[:400]}")
    return built


def _moved(built: Path, kept: Path) -> Path:
    """The file where it is kept: whole, or an OSError."""
    kept.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    number, name = tempfile.mkstemp(dir=kept.parent, prefix=f"{kept.name}-")
    os.close(number)
    try:
        shutil.copyfile(built, name)
        os.replace(name, kept)
    except BaseException:
        os.unlink(name)
        raise
    return kept


def _check_ours(path: Path) -> None:
    """Raises OSError if there is no such file, or others may have written it."""
    status = path.lstat()
    if not stat.S_ISREG(status.st_mode) or status.st_uid not in (0, os.geteuid()) or status.st_mode & 0o022:
        raise PermissionError(f"{path} may have been written by someone else")


def _digest(source: str) -> str:
    return hashlib.sha256(repr((source, FLAGS, compiler(), _target())).encode()).hexdigest()[:40]


@cache
def _target() -> str:
    """What the compiler makes code for: its version, and the instructions of this processor, as it defines them."""
    return _said("-march=native", "-dM", "-E", "-x", "c", os.devnull)


def _said(*arguments: str) -> str:
    return subprocess.run([compiler(), *arguments], capture_output=True, text=True, check=False).stdout
