"""All files of a filter for a board, by name."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from filters.jobs import Job
from filters.registry import ALL_METHODS
from filters.translation.kinds import LONG
from filters.translation.prototype import wrapped
from sched_sim.errors import InputError, option
from studies.board import dual_rate
from studies.board.bits import test_c
from studies.board.compiled import compiled
from studies.board.jobs import Jobs, translated
from studies.board.memory import jobs_memory
from studies.board.readme import readme
from studies.board.record import record_h, simulated
from studies.board.serial.files import steps_files, steps_run
from studies.board.serial.methods import check_serial, serial
from studies.board.steps import Steps
from studies.board.template import filled
from studies.board.wanted import Filter

OF_TASKS = ("tasks.h", "tasks.c", "posix.c", "freertos.c")
NAMES = frozenset(
    ("filter.h", "filter.c", "state.h", "steps.h", "steps.c", "record.h", "test.c", "README.md", *OF_TASKS)
)
"""All files that a folder may have."""


MOST_STEPS = 1000
"""From one measurement to the next: the record that is written with the filter has three of them."""


def check_wanted(method: str, sizes: Sequence[int], steps: Steps | None) -> None:
    """Raises InputError unless the method can have these steps as C. sizes: states, inputs and measurements."""
    for name, size in zip(("states", "inputs", "measurements"), sizes, strict=True):
        if size > LONG:
            raise InputError(f"{option(name)} {size} are too many for a board: as C at most {LONG} are written")
    if steps is not None and steps.N > MOST_STEPS:
        raise InputError(
            f"{option('N')} {steps.N} is too large: give at most {MOST_STEPS}, for test.c has a record of two cycles "
            f"and more; CYCLE_STEPS, in the header that is written, may be changed"
        )
    if steps is not None:
        if max(steps) > MOST_STEPS:
            raise InputError(f"{option('M')} {steps.M} is too large: give at most {MOST_STEPS}")
        if method == "dual-rate":
            dual_rate.check_steps(steps)
        else:
            check_serial(method, steps)


def board_files(wanted: Filter) -> dict[str, str]:
    """The files of a method: of the dual rate filter with its tasks, of serial ones with steps, of others the jobs.

    Raises:
        Untranslatable: something in a job or the model has nothing in C; its file and line are named.
        InputError: steps or sizes do not fit.
        ValueError: the system cannot be filtered from x0.
    """
    method, system, x0, update, precision, _, _ = wanted
    check_wanted(method, system[:3], wanted.steps)
    jobs = _jobs(wanted, ALL_METHODS[method].jobs(system, update, 0, x0))
    in_c = translated(jobs, precision)
    files = {
        "filter.h": _banner(wanted) + in_c.unit.header("FILTER_H"),
        "filter.c": _banner(wanted) + in_c.unit.source("filter.h"),
    }
    around = _around(wanted, jobs, in_c)
    files |= around.files
    files["test.c"] = test_c(method, jobs, _timed(wanted, jobs), in_c, around.tested)
    on_core = compiled(files, around.sources, precision)
    if method == "dual-rate":
        files["freertos.c"] = dual_rate.freertos_c(system, in_c, on_core)
    files["README.md"] = readme(wanted, in_c, around.sizes, around.sources, on_core)
    return {name: _readable(text) if name.endswith((".c", ".h")) else text for name, text in files.items()}


def _readable(text: str) -> str:
    """With no line that is too long."""
    return "\n".join(map(wrapped, text.splitlines())) + "\n"


class Around(NamedTuple):
    """What is around the jobs. sources: what is compiled for a board. sizes: of the arrays in RAM. tested: words of
    test.c."""

    files: dict[str, str]
    sources: Sequence[str]
    sizes: Mapping[str, int]
    tested: Mapping[str, str]


def _jobs(wanted: Filter, jobs: Mapping[str, Job]) -> Mapping[str, Job]:
    """The functions that are written."""
    if wanted.method == "dual-rate":
        return {kind: jobs[kind] for kinds in dual_rate.TASKS.values() for kind in kinds}
    if wanted.steps is None:
        return jobs
    written = serial(wanted.method, wanted.steps)
    return {kind: jobs[kind] for kind in written.jobs} | dict(written.more(wanted))


def _timed(wanted: Filter, jobs: Mapping[str, Job]) -> Mapping[str, str]:
    """Kinds of the cost table, and the written job that each is."""
    if wanted.steps is None or wanted.method == "dual-rate":
        return {kind: kind for kind in jobs}
    written = serial(wanted.method, wanted.steps)
    return {kind: kind for kind in written.jobs} | dict(written.same)


def _around(wanted: Filter, jobs: Mapping[str, Job], in_c: Jobs) -> Around:
    method, system, steps = wanted.method, wanted.system, wanted.steps
    if steps is None:
        state, sizes = jobs_memory(jobs, in_c)
        tested = {"sources": "filter.c test.c", "includes": "", "functions": "", "run": ""}
        return Around({"state.h": state}, ["filter.c"], sizes, tested)
    record = record_h(simulated(wanted, steps), wanted.precision)
    words = {"u": "record_u[j - 1]" if system.inputs else ""}
    if method == "dual-rate":
        files, sizes = dual_rate.tasks(system, jobs, in_c, steps)
        files = {**files, "record.h": record, "posix.c": filled("posix.c", words)}
        return Around(files, ["filter.c", "tasks.c"], sizes, _tested("tasks", filled("tasks_run.c", words)))
    written = serial(method, steps)
    files, sizes = steps_files(written, wanted, steps, jobs, in_c)
    tested = _tested("steps", steps_run(written, wanted))
    return Around({**files, "record.h": record}, ["filter.c", "steps.c"], sizes, tested)


def _tested(name: str, functions: str) -> dict[str, str]:
    """Words of test.c for what is run on the record, in `name`.c."""
    return {
        "sources": f"filter.c {name}.c test.c",
        "includes": f'\n#include "record.h"\n#include "{name}.h"',
        "functions": functions,
        "run": f"\n    {name}_test();",
    }


def _banner(wanted: Filter) -> str:
    n, m, p = wanted.system[:3]
    return (
        f"/* {wanted.method}: {n} states, {m} inputs, {p} measurements, {wanted.update} covariance update, "
        f"{wanted.precision} precision.\n\n"
        f"   Translated from Python by sched_sim, from the functions that are counted, timed and scheduled. Equations\n"
        f"   are those of S. Steffes, Computationally Distributed Real-Time Dual Rate Kalman Filter, 2014, unless a\n"
        f"   function says otherwise. */\n"
    )
