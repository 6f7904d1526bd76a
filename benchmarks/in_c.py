"""Jobs as generated C against the same jobs compiled by numba, and against a filter in C that is written by hand.

9 states, 3 inputs, 3 measurements, form `short`; all with -O3 for this machine, operations neither reordered nor fused.
By hand, 10 steps and an update are timed: the update alone takes less by hand, where K and S need not be laid out in
full. Then what a user waits for: a run with a model of their own when nothing is kept on disk yet, and a run anew.
"""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.timing import REPETITIONS, Result, repeated, seconds
from filters.backends.c_compiler import FLAGS, SHORT_LOOPS, compiler
from filters.backends.in_c import in_c
from filters.delayed import dual_rate
from filters.jobs import Job
from filters.registry import DELAYED_METHODS
from filters.system import System
from filters.systems.example import example_system

ROUNDS, CYCLE = 61, 10


def results() -> Iterator[Result]:
    system = example_system(9, 3, 3)
    jobs = DELAYED_METHODS["dual-rate"].jobs(system, "short")
    kinds = ("hr_propagate", "lr_update")
    numbas = [repeated(jobs[kind].function, *jobs[kind].arguments(0)) for kind in kinds]
    ours = [_ours(jobs[kind], REPETITIONS) for kind in kinds]
    yield Result("generated C: time beside numba's", _beside(ours, numbas), 1.0, higher=False)
    jobs = DELAYED_METHODS["standard"].jobs(system, "short")
    ours = [_ours(jobs["propagate"], CYCLE * REPETITIONS), _ours(jobs["update"], REPETITIONS)]
    yield Result("generated C: time beside C by hand", _beside(ours, _by_hand(system, jobs)), 1.0, higher=False)
    c, numba = map(_first_run, ("c", "compiled"))
    yield Result("generated C: a model of one's own is ready", c, 2.0, higher=False, unit="s")
    yield Result("generated C: a model of one's own is ready, beside numba", c / numba, 0.2, higher=False)
    runs = [[partial(_run, system, backend)] for backend in ("c", "compiled")]
    yield Result("generated C: a whole run beside numba's", _beside(*runs), 1.0, higher=False)


def _ours(job: Job, times: int) -> Callable[[], None]:
    return partial(in_c(job.function).loop(*job.arguments(0)), times)


def _beside(ours: list[Callable[[], None]], theirs: list[Callable[[], None]]) -> float:
    """The sum of the least times of ours over that of theirs, in turns."""
    least = {run: float("inf") for run in (*ours, *theirs)}
    for _ in range(ROUNDS):
        for run in least:
            least[run] = min(least[run], seconds(run, 1))
    return sum(least[run] for run in ours) / sum(least[run] for run in theirs)


def _by_hand(system: System, jobs: dict[str, Job]) -> list[Callable[[], None]]:
    """Propagation and update by hand with the arguments of the jobs, whose numbers they give but for rounding.

    Compiled without SHORT_LOOPS, with which dot products take longer.
    """
    with tempfile.TemporaryDirectory() as folder:
        built = Path(folder) / "by_hand.so"
        source, flags = Path(__file__).with_name("by_hand.c"), [flag for flag in FLAGS if flag not in SHORT_LOOPS]
        subprocess.run([compiler(), *flags, "-o", built, source, "-lm"], check=True)
        library = ctypes.CDLL(str(built))
    given = {kind: job.arguments(0) for kind, job in jobs.items()}
    for kind, job in jobs.items():
        job.function(*given[kind])
    _, _, j, before, u, after, _ = given["propagate"]
    Phi, B, _, Q, _ = (each[j % len(each)] for each in system.parameters)
    propagate = _often(library.propagate_often, CYCLE * REPETITIONS, Phi, B, Q, before.x, before.P, u, like=after)
    _, _, k, y, before, after, _, _ = given["update"]
    _, _, H, _, R = (each[k % len(each)] for each in system.parameters)
    update = _often(library.update_often, REPETITIONS, H, R, y, before.x, before.P, like=after)
    return [propagate, update]


def _often(function: Any, times: int, *arguments: Any, like: Any) -> Callable[[], None]:
    """Runs of a function whose last two arguments are the estimate that it writes, which must be like this one."""
    kept = [np.ascontiguousarray(each) for each in (*arguments, np.zeros_like(like.x), np.zeros_like(like.P))]
    passed = [ctypes.c_void_p(each.ctypes.data) for each in kept]
    function(*passed, 1)
    for ours, theirs in zip(kept[-2:], like, strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=1e-12, atol=1e-12)

    def run(_kept: Any = kept) -> None:
        function(*passed, times)

    return run


def _first_run(backend: str) -> float:
    """Seconds until a filter has run with a model that nothing is kept of."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "benchmarks.own_model", backend]
        done = subprocess.run(
            command, env={**os.environ, "XDG_CACHE_HOME": folder}, check=True, capture_output=True, text=True
        )
        return float(done.stdout)


def _run(system: System, backend: Any) -> None:
    steps = 200
    data = np.zeros(9), np.eye(9), np.zeros((steps, 3)), np.zeros((steps // 10 + 1, 3))
    dual_rate.run(system, 10, 4, 8, *data, update="short", backend=backend)
