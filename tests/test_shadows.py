"""A file in the current folder that has the name of a library does not hide it."""

from __future__ import annotations

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

from studies.measurement.user_function import returned_by


def test_python_m_finds_the_library(tmp_path: Path) -> None:
    for name in ("numba", "simpy", "typer", "numpy"):
        (tmp_path / f"{name}.py").write_text("raise AssertionError('hides a library')")
    command = [sys.executable, "-m", "sched_sim", "simulate", "-N", "4", "-M", "1", "-L", "3", "--speed", "9"]
    run = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (run.returncode, run.stderr) == (0, "")


def test_the_users_module_is_found_first_and_hides_no_library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", list(sys.path))
    for name in ("helper_of_mine", "simpy"):
        (tmp_path / f"{name}.py").write_text("VALUE = 7")
    (tmp_path / "mine.py").write_text("import helper_of_mine\n\ndef seven(): return helper_of_mine.VALUE")
    assert returned_by("mine:seven", "--system", "how").value == 7
    found = find_spec("simpy")
    assert found is not None
    assert not Path(str(found.origin)).is_relative_to(tmp_path)
