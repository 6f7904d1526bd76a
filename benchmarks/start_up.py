"""How long the command takes to start."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator

from benchmarks.timing import Result, seconds


def results() -> Iterator[Result]:
    for line, target in (("--help", 0.4), ("minimum -N 10 -M 4 -L 8", 0.6)):
        command = [sys.executable, "-m", "sched_sim", *line.split()]
        took = seconds(lambda command=command: subprocess.run(command, check=True, capture_output=True))
        yield Result(f"start-up: sched-sim {line}", took, target, higher=False, unit="s")
