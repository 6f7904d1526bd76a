"""The rocket's filter as C is the one that runs in Python."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from tests.command_line import Run

COMPILER = shutil.which("cc")


@pytest.mark.exhaust
@pytest.mark.skipif(COMPILER is None, reason="there is no C compiler")
def test_the_rockets_filter_as_c_passes_its_comparison(sched_sim: Run, tmp_path: Path) -> None:
    board = tmp_path / "board"
    made = sched_sim(f"code --filter filters.systems.rocket_filter:rocket_filter -o {board}")
    assert made.code == 0
    flags = ["-std=c99", "-O2", "-ffp-contract=off"]
    subprocess.run([COMPILER, *flags, "filter.c", "steps.c", "test.c", "-lm", "-o", "test"], cwd=board, check=True)
    said = subprocess.run([board / "test"], cwd=board, check=True, capture_output=True, text=True).stdout
    assert said.rstrip().endswith("passed")
