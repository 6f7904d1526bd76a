"""What surrounds every command: its standard streams, the folder it runs in, and how it ends.

Characters that a stream cannot encode are written as escapes. A result that cannot be written, to a full disk or a
closed standard output, is an error: exit code 2. A reader that has seen enough (`sched-sim ... | head`) is none of the
user's mistakes: exit code 1, and nothing said.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from io import TextIOBase, TextIOWrapper

from sched_sim.cli.output import say
from sched_sim.cli.spelling import flag_of
from sched_sim.errors import SPELLING, InputError


class Stdout(TextIOWrapper):
    """Standard output; raises InputError where it cannot be written."""

    def write(self, text: str) -> int:
        with _writing():
            return super().write(text)

    def flush(self) -> None:
        with _writing():
            super().flush()


class Closed(TextIOBase):
    """Standard output that is not there."""

    def write(self, _text: str) -> int:
        raise InputError("standard output is closed: open it, or send it to a file or to /dev/null")


def run() -> int:
    """Run the command that `sys.argv` says; its exit code."""
    _open_streams()
    spelling = SPELLING.set(flag_of)
    try:
        code = _command()
        sys.stdout.flush()
    except InputError as error:
        return _refuse(str(error))
    except BrokenPipeError:
        return _end(1)
    except MemoryError:
        return _refuse("memory ran out: give a smaller design, grid, system or file")
    except FileNotFoundError:
        if _folder_is_there():
            raise
        return _refuse("the current folder has been deleted: change to one that exists")
    finally:
        SPELLING.reset(spelling)
    return code


def _command() -> int:
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "1")  # it would search all that is installed for some
    from sched_sim.cli.app import command

    try:
        command()(prog_name="sched-sim")
    except SystemExit as stop:
        return int(stop.code or 0)
    return 0


@contextmanager
def _writing() -> Iterator[None]:
    try:
        yield
    except BrokenPipeError:
        raise
    except OSError as error:
        raise InputError(
            f"standard output cannot be written: {error.strerror}; make room, or send it elsewhere"
        ) from None


def _refuse(message: str) -> int:
    with suppress(OSError):  # nobody reads it
        say(f"Error: {message}")
    return _end(2)


def _end(code: int) -> int:
    """What is still to be written is written nowhere, lest Python try again as it ends."""
    if isinstance(sys.stdout, Stdout):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return code


def _open_streams() -> None:
    """Each of the three file numbers is taken, so that no file of ours becomes one of them."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest number that is free
    if sys.stderr is None:
        sys.stderr = open(os.devnull, "w")  # noqa: SIM115  # open for as long as the process
    if sys.stdout is None:
        sys.stdout = Closed()
    elif sys.stdout is sys.__stdout__ and isinstance(sys.stdout, TextIOWrapper):
        sys.stdout = _checked(sys.stdout)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def _checked(stdout: TextIOWrapper) -> Stdout:
    encoding, by_line, at_once = stdout.encoding, stdout.line_buffering, stdout.write_through
    return Stdout(stdout.detach(), encoding, line_buffering=by_line, write_through=at_once)


def _folder_is_there() -> bool:
    try:
        return bool(os.getcwd())
    except OSError:
        return False
