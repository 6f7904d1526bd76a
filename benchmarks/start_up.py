"""How long the library and the command take to start."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator

from benchmarks.timing import Result, seconds


def results() -> Iterator[Result]:
    imported = _took("-c", "import sched_sim") - _took("-c", "pass")
    yield Result("start-up: import sched_sim, beside that of Python", imported, 0.05, higher=False, unit="s")
    for line, target in (("--help", 0.2), ("minimum -N 10 -M 4 -L 8", 0.3)):
        yield Result(f"start-up: sched-sim {line}", _took("-m", "sched_sim", *line.split()), target, False, "s")


def _took(*arguments: str) -> float:
    """The seconds that Python takes for it, with the byte code of its modules kept, as where it is installed."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return seconds(lambda: subprocess.run([sys.executable, *arguments], env=kept, check=True, capture_output=True))
