"""Compiled code computes with the constants that are there now, however they are named, from the disk or not."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

CONSTANTS = """
import enum
from typing import NamedTuple
import numpy as np

DT = VALUE
TABLE = np.array([0.0, VALUE])
PAIR = (1.0, VALUE)

class Mode(enum.Enum):
    GAIN = VALUE

def scale(x):
    return DT * x

class Settings(NamedTuple):
    dt: float
    scale: object

SETTINGS = Settings(VALUE, scale)
"""

MODEL = """
import constants
import package.inner
from constants import DT, SETTINGS, Mode, scale
from numpy import eye

def number(x): return DT * x
def of_a_module(x): return constants.DT * x
def of_a_module_by_another_name(x):
    module = constants
    return module.DT * x
def by_getattr(x): return getattr(constants, "DT") * x
def of_a_module_in_a_module(x): return package.inner.constants.DT * x
def array(x): return constants.TABLE[1] * x
def pair(x): return constants.PAIR[1] * x
def record(x): return constants.SETTINGS.dt * x
def member(x): return Mode.GAIN.value * x
def member_of_a_module(x): return constants.Mode.GAIN.value * x
def function(x): return scale(x)
def function_of_a_module(x): return constants.scale(x)
def function_of_a_record(x): return constants.SETTINGS.scale(x)
def function_of_a_module_in_a_module(x): return package.inner.twice(x)
def default(x, dt=constants.DT): return dt * x
def default_function(x, call=constants.scale): return call(x)
def nested(x):
    def inner(y): return constants.DT * y
    return inner(x)
def library(x): return eye(2)[1, 1] * constants.DT * x
def closing_over(dt):
    def closure(x): return dt * x
    return closure
closure = closing_over(constants.DT)
by_lambda = lambda x: constants.DT * x
exec("def by_exec(x): return constants.DT * x")
"""

INNER = """
import constants

def twice(x):
    return 2.0 * constants.scale(x)
"""

PROGRAM = """
import importlib, sys
from pathlib import Path
from types import FunctionType
from filters.backends.choose import function_for
import constants, model

kinds = [value for value in vars(model).values() if isinstance(value, FunctionType)]
kinds = [kind for kind in kinds if kind.__name__ not in ("eye", "closing_over")]

def wrong(backend):
    found = [kind.__name__ for kind in kinds if function_for(backend, kind)(3.0) != kind(3.0)]
    if backend == "compiled":
        hits.append(sum(sum(function_for(backend, kind).stats.cache_hits.values()) for kind in kinds))
    return found

hits = []
print("wrong:", *wrong("compiled"), *wrong("numpy"))
print("found:", hits[0] if hits[0] < len(kinds) else "all")
if "reload" in sys.argv:
    file = Path(constants.__file__)
    file.write_text(file.read_text().replace("VALUE =", "VALUE = 1.0 +"))
    importlib.reload(constants)
    print("wrong when reloaded:", *wrong("compiled"), *wrong("numpy"))
"""


def run(folder: Path, *arguments: str) -> list[str]:
    environment = {
        **os.environ,
        "XDG_CACHE_HOME": str(folder / "cache"),
        "PYTHONPATH": os.pathsep.join([str(folder), os.getcwd()]),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    command = [sys.executable, str(folder / "program.py"), *arguments]
    return subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout.splitlines()


@pytest.mark.exhaust
def test_a_constant_that_changes_is_never_stale(tmp_path: Path) -> None:
    (tmp_path / "package").mkdir()
    (tmp_path / "package" / "__init__.py").write_text("")
    (tmp_path / "package" / "inner.py").write_text(INNER)
    (tmp_path / "model.py").write_text(MODEL)
    (tmp_path / "program.py").write_text(PROGRAM)

    def run_with(value: str, *arguments: str) -> list[str]:
        (tmp_path / "constants.py").write_text(f"VALUE = {value}" + CONSTANTS)
        return run(tmp_path, *arguments)

    assert run_with("2.0", "reload") == ["wrong:", "found: 0", "wrong when reloaded:"]
    assert run_with("4.0") == ["wrong:", "found: 0"]
    assert run_with("4.0") == ["wrong:", "found: all"]
