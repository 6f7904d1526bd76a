"""Machine code is found again by another process, and not when any source it came from has changed."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

PROGRAM = """
import numpy as np
from filters.high_rate import hr_restart
from filters.kernels.backends import arguments_for, function_for
import model
from filters.systems.system import System

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


def run(folder: Path, model: str = "model", **helper: str) -> str:
    """Cache hits, cache misses and the result, in a process of its own."""
    (folder / "program.py").write_text(PROGRAM.replace("import model", f"import {model} as model"))
    (folder / f"{model}.py").write_text(MODEL)
    (folder / "helper.py").write_text(HELPER.format(**helper))
    environment = {
        **os.environ,
        "XDG_CACHE_HOME": str(folder / "cache"),
        "PYTHONPATH": os.pathsep.join([str(folder), os.getcwd()]),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    command = [sys.executable, str(folder / "program.py")]
    return subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout.strip()


def test_another_process_finds_the_machine_code_unless_a_callee_or_constant_changed(tmp_path: Path) -> None:
    assert run(tmp_path, sign="+", step="10.0") == "0 1 12.0"
    assert run(tmp_path, sign="+", step="10.0") == "1 0 12.0"
    assert run(tmp_path, sign="-", step="10.0") == "0 1 -8.0"
    assert run(tmp_path, sign="-", step="20.0") == "0 1 -18.0"
    assert list((tmp_path / "cache" / "sched_sim" / "numba").glob("hr_restart-*/*/*.nbi"))


def test_without_a_folder_that_can_be_written_nothing_is_kept(tmp_path: Path) -> None:
    (tmp_path / "cache").write_text("a file, not a folder")
    for _ in range(2):
        assert run(tmp_path, sign="+", step="10.0") == "0 1 12.0"


def test_an_entry_of_a_model_that_is_gone_is_no_error(tmp_path: Path) -> None:
    run(tmp_path, sign="+", step="10.0")
    (tmp_path / "model.py").unlink()
    assert run(tmp_path, model="other_model", sign="+", step="10.0") == "0 1 12.0"
    assert run(tmp_path, model="other_model", sign="+", step="10.0") == "1 0 12.0"
