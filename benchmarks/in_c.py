"""Jobs as generated C against the same jobs compiled by numba, and a propagation against C that is written by hand.

9 states, 3 inputs, 3 measurements, form `short`; all with -O3 for this machine, operations neither reordered nor fused.
"""

from __future__ import annotations

import ctypes
import subprocess
import tempfile
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import numpy as np

from benchmarks.timing import REPETITIONS, Result, repeated, seconds
from filters.backends.in_c import FLAGS, compiler, in_c
from filters.covariance_forms import covariance_form
from filters.registry import DELAYED_METHODS
from filters.systems.example import example_system

ROUNDS = 61


def results() -> Iterator[Result]:
    system = example_system(9, 3, 3)
    jobs = DELAYED_METHODS["dual-rate"].jobs(system, "short")
    kinds = ("hr_propagate", "lr_update")
    ours = [partial(in_c(jobs[kind].function).loop(*jobs[kind].arguments(0)), REPETITIONS) for kind in kinds]
    numbas = [repeated(jobs[kind].function, *jobs[kind].arguments(0)) for kind in kinds]
    yield Result("generated C: time beside numba's", _beside(ours, numbas), 1.0, higher=False)
    propagation, at = covariance_form("short").propagation, DELAYED_METHODS["standard"].jobs(system, "short")
    before, work = at["propagate"].arguments(0)[3], at["propagate"].arguments(0)[6]
    Phi, Q, out = system.parameters.Phi[0], system.parameters.Q[0], np.zeros((9, 9))
    loop = partial(in_c(propagation).loop(Phi, before.P, Q, out, work), REPETITIONS)
    yield Result("generated C: time beside C by hand", _beside([loop], [_by_hand(Phi, before.P, Q)]), 1.0, higher=False)


def _beside(ours: list[Callable[[], None]], theirs: list[Callable[[], None]]) -> float:
    """The sum of the least times of ours over that of theirs, in turns."""
    least = {run: float("inf") for run in (*ours, *theirs)}
    for _ in range(ROUNDS):
        for run in least:
            least[run] = min(least[run], seconds(run, 1))
    return sum(least[run] for run in ours) / sum(least[run] for run in theirs)


def _by_hand(Phi: np.ndarray, P: np.ndarray, Q: np.ndarray) -> Callable[[], None]:
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "by_hand.so"
        source = Path(__file__).with_name("by_hand.c")
        subprocess.run([compiler(), *FLAGS, "-o", library, source], check=True)
        repeat = ctypes.CDLL(str(library)).repeat
    kept = [np.ascontiguousarray(each) for each in (Phi, P, Q, np.zeros((9, 9)))]
    arguments = [ctypes.c_void_p(each.ctypes.data) for each in kept]

    def run(_kept: list[np.ndarray] = kept) -> None:
        repeat(*arguments, REPETITIONS)

    return run
