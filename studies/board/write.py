"""All files of a filter for a board, by name."""

from __future__ import annotations

from typing import NamedTuple

from filters.arrays import FloatArray
from filters.covariance_forms import CovarianceFormName
from filters.registry import ALL_METHODS
from filters.system import System
from filters.translation.library import Precision
from studies.board import dual_rate
from studies.board.bits import test_c
from studies.board.compiled import compiled
from studies.board.dual_rate import TASKS, Steps, check_steps, tasks
from studies.board.jobs import translated
from studies.board.memory import jobs_memory
from studies.board.readme import readme
from studies.board.record import record_h, simulated
from studies.board.template import filled

NAMES = frozenset(
    (
        "filter.c",
        "filter.h",
        "state.h",
        "tasks.c",
        "tasks.h",
        "record.h",
        "test.c",
        "posix.c",
        "freertos.c",
        "README.md",
    )
)
"""All files that a folder may have."""


class Filter(NamedTuple):
    """What is to be written. x0 (n,): a typical state. steps: of the dual rate filter. said: the command that asks."""

    method: str
    system: System
    x0: FloatArray
    update: CovarianceFormName
    precision: Precision
    steps: Steps | None
    said: str


def board_files(wanted: Filter) -> dict[str, str]:
    """The files of a method; of the dual rate filter with its tasks, of others the jobs.

    Raises:
        Untranslatable: something in a job or the model has nothing in C; its file and line are named.
        InputError: the steps do not fit.
        ValueError: the system cannot be filtered from x0.
    """
    method, system, x0, update, precision, steps, _ = wanted
    jobs = ALL_METHODS[method].jobs(system, update, 0, x0)
    if method == "dual-rate":
        assert steps is not None
        check_steps(steps)
        jobs = {kind: jobs[kind] for kinds in TASKS.values() for kind in kinds}
    in_c = translated(jobs, precision)
    files = {"filter.h": _banner(wanted) + in_c.unit.header("FILTER_H")}
    files["filter.c"] = _banner(wanted) + in_c.unit.source("filter.h")
    more = {"sources": "filter.c test.c", "includes": "", "functions": "", "run": ""}
    sources, sizes = ["filter.c"], {}
    if steps is not None and method == "dual-rate":
        written = tasks(system, jobs, in_c, steps)
        sizes, sources = written.sizes, ["filter.c", "tasks.c"]
        files |= written.files
        files["record.h"] = record_h(simulated(system, x0, update, steps, precision), precision)
        words = {"u": "record_u[j - 1]" if system.inputs else ""}
        files["posix.c"] = filled("posix.c", words)
        more = {
            "sources": "filter.c tasks.c test.c",
            "includes": '\n#include "record.h"\n#include "tasks.h"',
            "functions": filled("run.c", words),
            "run": "\n    tasks_test();",
        }
    else:
        files["state.h"], sizes = jobs_memory(jobs, in_c)
    files["test.c"] = test_c(method, jobs, in_c, more)
    on_core = compiled(files, sources, precision)
    if "tasks.c" in files:
        files["freertos.c"] = dual_rate.freertos_c(system, in_c, on_core)
    files["README.md"] = readme(wanted, in_c, sizes, on_core)
    return files


def _banner(wanted: Filter) -> str:
    n, m, p = wanted.system[:3]
    return (
        f"/* {wanted.method}: {n} states, {m} inputs, {p} measurements, {wanted.update} covariance update, "
        f"{wanted.precision} precision.\n\n"
        f"   Translated from Python by sched_sim, from the functions that are counted, timed and scheduled. Equations\n"
        f"   are those of S. Steffes, Computationally Distributed Real-Time Dual Rate Kalman Filter, 2014, unless a\n"
        f"   function says otherwise. */\n"
    )
