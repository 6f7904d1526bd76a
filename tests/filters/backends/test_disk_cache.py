"""Machine code is found again by another process, and only where it is whole, ours, and of the same sources."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import FunctionType
from typing import Any, NamedTuple

import numpy as np
import pytest
from numba import njit

from filters.backends.compiled import compiled, inlined
from filters.backends.dependencies import dependencies
from filters.backends.disk_cache import DiskCache

PROGRAM = """
import numpy as np
from filters.delayed.high_rate import hr_restart
from filters.backends.choose import arguments_for, function_for
import model
from filters.system import System

def unused():
    raise AssertionError

system = System(1, 1, 1, model.f, model.F, model.Q, unused, unused, unused, model.Parameters(2.0))
x_next = np.zeros(1)
job = function_for("compiled", hr_restart)
job(*arguments_for("compiled", (system, 0, np.ones(1), np.ones(1), x_next)))
print(sum(job.stats.cache_hits.values()), sum(job.stats.cache_misses.values()), x_next[0])
"""

MODEL = """
from typing import NamedTuple
import numpy as np
from helper import increment

class Parameters(NamedTuple):
    gain: float

def f(j, x, u, parameters, out):
    out[0] = parameters.gain * x[0] + increment(u)

def F(j, x, u, parameters):
    return np.eye(1)

def Q(j, parameters):
    return np.eye(1)
"""

HELPER = """
STEP = {step}

def increment(u):
    return {sign}u[0] * STEP
"""


def write(folder: Path, **helper: str) -> None:
    (folder / "program.py").write_text(PROGRAM)
    (folder / "model.py").write_text(MODEL)
    (folder / "helper.py").write_text(HELPER.format(**helper))


def started(folder: Path) -> subprocess.Popen[str]:
    """A process that prints cache hits, cache misses and the result."""
    environment = {
        **os.environ,
        "XDG_CACHE_HOME": str(folder / "cache"),
        "PYTHONPATH": os.pathsep.join([str(folder), os.getcwd()]),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    return subprocess.Popen(
        [sys.executable, str(folder / "program.py")], env=environment, stdout=subprocess.PIPE, text=True
    )


def run(folder: Path, **helper: str) -> str:
    write(folder, **helper)
    return started(folder).communicate()[0].strip()


@pytest.mark.exhaust
def test_another_process_finds_the_machine_code_unless_a_callee_changed(tmp_path: Path) -> None:
    assert run(tmp_path, sign="+", step="10.0") == "0 1 12.0"
    assert run(tmp_path, sign="+", step="10.0") == "1 0 12.0"
    assert run(tmp_path, sign="-", step="10.0") == "0 1 -8.0"


@pytest.mark.exhaust
def test_processes_that_compile_the_same_at_once_leave_one_whole_file(tmp_path: Path) -> None:
    write(tmp_path, sign="+", step="10.0")
    processes = [started(tmp_path) for _ in range(8)]
    assert {process.communicate()[0].split()[-1] for process in processes} == {"12.0"}
    assert len(list((tmp_path / "cache" / "sched_sim" / "numba").iterdir())) == 1
    assert run(tmp_path, sign="+", step="10.0") == "1 0 12.0"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return tmp_path / "sched_sim" / "numba"


class Found(NamedTuple):
    """Whether the code was on the disk, and what it gave."""

    on_disk: bool
    result: Any


class Record(NamedTuple):
    x: float


def twice(x: float) -> float:
    return 2 * x


def thrice(x: float) -> float:
    return 3 * x


def found(function: FunctionType, argument: Any = 1.0) -> Found:
    """Compiled, or found on the disk, by a dispatcher of its own."""
    dispatcher = njit(function)
    dispatcher._cache = DiskCache(function.__name__, dependencies(function).digest)
    result = dispatcher(argument)
    return Found(bool(sum(dispatcher.stats.cache_hits.values())), result)


def test_each_signature_is_kept(folder: Path) -> None:
    array = np.array([1.5, 2.5])
    for argument in (1, 1.0, array, Record(1.0), (1.0, 2)):

        def first(x: Any) -> Any:
            return x

        assert not found(first, argument).on_disk
        assert found(first, argument).on_disk
    assert len(list(folder.iterdir())) == 5


@pytest.mark.parametrize(
    "damage", [lambda code: code[:0], lambda code: code[:-1], lambda code: code[:-100] + bytes(100)]
)
def test_a_damaged_file_is_written_anew(folder: Path, damage: Callable[[bytes], bytes]) -> None:
    found(twice)
    (file,) = folder.iterdir()
    whole = file.read_bytes()
    file.write_bytes(damage(whole))
    assert found(twice) == (False, 2.0)
    assert found(twice) == (True, 2.0)


def test_the_file_of_another_function_is_not_taken_for_it(folder: Path) -> None:
    found(twice)
    (file,) = folder.iterdir()
    code = file.read_bytes()
    file.unlink()
    found(thrice)
    (file,) = folder.iterdir()
    file.write_bytes(code)
    assert found(thrice) == (False, 3.0)


def test_a_file_that_others_could_have_written_is_not_read(folder: Path) -> None:
    found(twice)
    (file,) = folder.iterdir()
    assert file.stat().st_mode & 0o777 == 0o600
    file.chmod(0o666)
    assert found(twice) == (False, 2.0)
    assert found(twice) == (True, 2.0)


def test_a_pipe_in_place_of_a_file_is_replaced(folder: Path) -> None:
    found(twice)
    (file,) = folder.iterdir()
    file.unlink()
    os.mkfifo(file)
    assert found(twice) == (False, 2.0)
    assert found(twice) == (True, 2.0)


def test_without_a_folder_that_can_be_written_nothing_is_kept(folder: Path) -> None:
    folder.parent.parent.joinpath("sched_sim").write_text("a file, not a folder")
    for _ in range(2):
        assert found(twice) == (False, 2.0)


def test_without_a_home_nothing_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    def unknown() -> Path:
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr(Path, "home", unknown)
    assert found(twice) == (False, 2.0)


def test_what_is_interrupted_leaves_no_half_file(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise OSError("No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", full)
        assert found(twice) == (False, 2.0)
    assert list(folder.iterdir()) == []


def test_what_depends_on_an_object_of_unknown_content_is_not_kept(folder: Path) -> None:
    function_of_the_users_own = njit(twice)

    def use(x: float) -> float:
        return float(function_of_the_users_own(x))

    assert compiled(use)(1.0) == 2.0
    assert not folder.exists()


def test_a_signature_with_a_function_of_the_users_own_is_not_kept(folder: Path) -> None:
    unheard_of = time.monotonic_ns()

    def call(function: Any, x: float) -> Any:
        return function(x) + 0 * unheard_of

    assert compiled(call)(njit(twice), 1.0) == 2.0
    assert not folder.exists()
    assert compiled(call)(inlined(thrice), 1.0) == 3.0
    assert len(list(folder.iterdir())) == 1
