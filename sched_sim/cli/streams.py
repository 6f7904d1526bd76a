"""What surrounds every command: its standard streams, the folder it runs in, and how it ends.

Characters that a stream cannot encode are written as escapes. A result that cannot be written, to a full disk or a
closed standard output, is an error: exit code 2. A reader that has seen enough (`sched-sim ... | head`) is none of the
user's mistakes: exit code 1, and nothing said.
"""

from __future__ import annotations

import os
import sys
from io import TextIOBase, TextIOWrapper

from sched_sim.cli.output import say
from sched_sim.errors import InputError

STDOUT_CLOSED = "standard output is closed: open it, or send it to a file or to /dev/null"
NO_FOLDER = "the current folder has been deleted: change to one that exists"


class Closed(TextIOBase):
    """Standard output that is not there."""

    def write(self, _text: str) -> int:
        raise InputError(STDOUT_CLOSED)


def run() -> int:
    """Run the command that `sys.argv` says; its exit code."""
    _open_streams()
    code = _explained()
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        _drop_stdout()
        return 1
    except OSError as error:
        _drop_stdout()
        return _refuse(f"standard output cannot be written: {error.strerror}; make room, or send it elsewhere")
    return code


def _explained() -> int:
    try:
        from sched_sim.cli.app import app

        app(prog_name="sched-sim")
    except SystemExit as stop:
        return int(stop.code or 0)
    except InputError as error:
        return _refuse(str(error))
    except MemoryError:
        return _refuse("memory ran out: give a smaller design, grid, system or file")
    except OSError:
        if not _stdout_fails():
            if not _folder_is_there():
                return _refuse(NO_FOLDER)
            raise
    return 0


def _refuse(message: str) -> int:
    say(f"Error: {message}")
    return 2


def _open_streams() -> None:
    """Each of the three file numbers is taken, so that no file of ours becomes one of them."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # takes the lowest number that is free
    if sys.stdout is None:
        sys.stdout = Closed()
    if sys.stderr is None:
        sys.stderr = open(os.devnull, "w")  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def _drop_stdout() -> None:
    """What is still to be written is written nowhere, and Python does not try again as it ends."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _stdout_fails() -> bool:
    try:
        sys.stdout.flush()
    except OSError:
        return True
    return False


def _folder_is_there() -> bool:
    try:
        return bool(os.getcwd())
    except OSError:
        return False
