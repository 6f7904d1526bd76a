"""A process that is killed at one of its system calls, whichever is wanted."""

from __future__ import annotations

import ctypes
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

TRACEME, SYSCALL, SETOPTIONS, EXITKILL = 0, 24, 0x4200, 0x100000
"""Of ptrace(2), the same on every Linux."""

_libc = ctypes.CDLL(None, use_errno=True)


@cache
def traceable() -> bool:
    """Whether a process may trace its children here."""
    return sys.platform == "linux" and call_alone("tests.deaths", "_try").returncode == 0


def _try() -> None:
    assert killed_at_call(1, lambda: os.stat("."))
    assert not killed_at_call(1000, lambda: os.stat("."))


def call_alone(module: str, function: str, *arguments: object) -> subprocess.CompletedProcess[str]:
    """Call a function in a new interpreter, where no thread of the tests' is in the way of `os.fork`."""
    code = f"from {module} import {function} as f; f(*{arguments!r})"
    return subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)


def killed_at_call(number: int, work: Callable[[], object]) -> bool:
    """Whether `work`, in a process of its own, was killed as it began its system call of this number; else it ended.

    Raises AssertionError if it failed.
    """
    child = os.fork()
    if child == 0:
        _work_traced(work)
    os.waitpid(child, 0)
    _ptrace(SETOPTIONS, child, EXITKILL)
    stops, sent = 0, 0
    while True:
        _ptrace(SYSCALL, child, sent)
        _, status = os.waitpid(child, 0)
        if os.WIFEXITED(status):
            assert os.WEXITSTATUS(status) == 0, "the work failed"
            return False
        assert os.WIFSTOPPED(status), f"killed by something else: {status}"
        stopped_by = os.WSTOPSIG(status)
        sent = 0 if stopped_by == signal.SIGTRAP else stopped_by
        stops += stopped_by == signal.SIGTRAP
        if stops == 2 * number - 1:  # each call stops twice, as it begins and as it ends
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)
            return True


def _work_traced(work: Callable[[], object]) -> None:
    code = 1
    try:
        _ptrace(TRACEME, 0, 0)
        os.kill(os.getpid(), signal.SIGSTOP)
        work()
        code = 0
    finally:
        os._exit(code)


def _ptrace(request: int, pid: int, data: int) -> None:
    if _libc.ptrace(request, pid, None, ctypes.c_void_p(data)) < 0:
        raise OSError(ctypes.get_errno(), "ptrace")
