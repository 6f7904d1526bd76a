"""Files that the user names for results: each is written under another name, then given its own, so never half there.

The other name is `.sched-sim-<16 hexadecimal digits>.unfinished`, in the same folder, locked by its writer. One that
nobody has locked was left by a process that was killed: the next to write a file in that folder removes it.
"""

from __future__ import annotations

import errno
import fcntl
import io
import os
import re
import stat
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO, Any

from sched_sim.errors import InputError

_UNFINISHED = re.compile(r"\.sched-sim-[0-9a-f]{16}\.unfinished")

_NO_ROOM = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}


def check_writable(path: Path, what: str) -> None:
    """Raises InputError unless a file can be written at `path`, before the work that fills it; changes nothing.
    what: the option or thing the path is for."""
    with _explained(path, what):
        there = _status(path)
        if there is None:
            usable = _takes_files(path)
        elif stat.S_ISREG(there.st_mode):
            usable = os.access(path, os.W_OK) and _takes_files(path)
        else:
            usable = os.access(path, os.W_OK) and not stat.S_ISDIR(there.st_mode)
    if not usable:
        raise InputError(
            f"{what} {str(path)!r} cannot be written: give a file in a folder that exists and is yours to write"
        )


def write(path: Path, content: bytes, what: str) -> None:
    """Make `content` what is in `path`; see `writing`."""
    with writing(path, what) as file:
        file.write(content)


@contextmanager
def writing(path: Path, what: str) -> Iterator[IO[bytes]]:
    """A file that becomes `path` once it is complete; if it fails, what was there before stays as it was.

    Permissions are those of the file that was there, else those of any new file. A symbolic link stays, and the file
    that it points to is replaced. What is no regular file (a device, a pipe), and standard output under another name,
    is written to directly. what: the option or thing the path is for. Raises InputError that names it.
    """
    check_writable(path, what)
    with _explained(path, what):
        there = _status(path)
        descriptor = None if there is None else _open_directly(path, there)
    if descriptor is not None:
        with io.BufferedWriter(_Explained(descriptor, path, what)) as file:
            yield file
        return
    target = Path(os.path.realpath(path))
    with _explained(path, what):
        _remove_abandoned(target.parent)
        descriptor, new = _create(target.parent)
    try:
        with io.BufferedWriter(_Explained(descriptor, path, what)) as file:
            if there is not None:
                _take_permissions(descriptor, there)
            yield file
            file.flush()
            with _explained(path, what):
                os.fsync(descriptor)
                new.replace(target)
    finally:
        with suppress(OSError):  # it has its own name by now, if all went well
            new.unlink()


class _Explained(io.FileIO):
    """Its errors name the file as the user did, whoever else's errors pass by while it is open."""

    def __init__(self, descriptor: int, path: Path, what: str) -> None:
        super().__init__(descriptor, "wb")
        self._said = path, what

    def write(self, data: Any) -> int:
        with _explained(*self._said):
            return super().write(data)


@contextmanager
def _explained(path: Path, what: str) -> Iterator[None]:
    """Turns errors of the file system into one that names the file; a reader that has left a pipe is no error of it."""
    try:
        yield
    except BrokenPipeError:
        raise
    except OSError as error:
        remedy = "make room there, or give another file" if error.errno in _NO_ROOM else "give another file"
        raise InputError(f"{what} {str(path)!r} cannot be written: {error.strerror}; {remedy}") from error


def _takes_files(path: Path) -> bool:
    """Whether files can be made and renamed beside what `path` means, which is to be replaced."""
    return os.access(os.path.dirname(os.path.realpath(path)), os.W_OK | os.X_OK)


def _status(path: Path) -> os.stat_result | None:
    """Status of what is there, links followed; None if nothing is."""
    try:
        return path.stat()
    except FileNotFoundError:
        return None


def _stream(there: os.stat_result) -> int | None:
    """The descriptor of standard output or standard error, if that is what is there."""
    for stream in (1, 2):
        with suppress(OSError):  # it is closed
            if os.path.samestat(there, os.fstat(stream)):
                return stream
    return None


def _open_directly(path: Path, there: os.stat_result) -> int | None:
    """A descriptor to write to what is there already, None if it is a file to be replaced."""
    if stream := _stream(there):
        if sys.stdout is not None:
            sys.stdout.flush()
        return os.dup(stream)
    return None if stat.S_ISREG(there.st_mode) else os.open(path, os.O_WRONLY)


def _create(folder: Path) -> tuple[int, Path]:
    """A new file and its descriptor, which holds its lock."""
    while True:
        new = folder / f".sched-sim-{os.urandom(8).hex()}.unfinished"
        descriptor = os.open(new, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
        with suppress(OSError):  # where files cannot be locked, abandoned ones stay
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        if new.exists():  # nobody took it for abandoned before it was locked
            return descriptor, new
        os.close(descriptor)


def _take_permissions(descriptor: int, there: os.stat_result) -> None:
    with suppress(PermissionError):  # only root can give files away
        os.fchown(descriptor, there.st_uid, there.st_gid)
    os.fchmod(descriptor, stat.S_IMODE(there.st_mode))


def _remove_abandoned(folder: Path) -> None:
    with suppress(OSError):
        for name in filter(_UNFINISHED.fullmatch, os.listdir(folder)):
            with suppress(OSError):
                _remove_unless_locked(folder / name)


def _remove_unless_locked(path: Path) -> None:
    descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        path.unlink()
    finally:
        os.close(descriptor)
