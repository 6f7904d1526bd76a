"""All files of a filter for a board, by name."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from filters.delayed.dual_rate import GainTime
from filters.jobs import Job
from filters.registry import ALL_METHODS
from filters.systems.scratch import restored
from filters.translation.kinds import LONG
from sched_sim.errors import InputError, option
from studies.board import dual_rate
from studies.board.assembled import USUAL, Around, assembled, words_of_run
from studies.board.compiled import Compiled, stacks_of
from studies.board.examples import freertos_c, posix_c
from studies.board.in_flight import are_several, check_in_flight, more_jobs, tasks_in_flight
from studies.board.jobs import Jobs, named, translated
from studies.board.memory import jobs_memory, with_own_scratch
from studies.board.readme import about_filter
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


MOST_STEPS, MOST_IN_FLIGHT = 1000, 64
"""From one measurement to the next, for the record that is written with the filter has three of them; and measurements
on their way at once."""


def check_wanted(method: str, sizes: Sequence[int], steps: Steps | None, gain: GainTime = "at-update") -> None:
    """Raises InputError unless the method can have these steps as C. sizes: states, inputs and measurements."""
    for name, size in zip(("states", "inputs", "measurements"), sizes, strict=True):
        if size > LONG:
            raise InputError(f"{option(name)} {size} are too many for a board: as C at most {LONG} are written")
    if steps is not None:
        check_cycle(steps.N)
        if steps.M > MOST_STEPS or max(steps.M, steps.L) > MOST_IN_FLIGHT * steps.N:
            raise InputError(
                f"{option('M')} {steps.M} is too large: give at most {min(MOST_STEPS, MOST_IN_FLIGHT * steps.N)}, for "
                f"memory of {MOST_IN_FLIGHT} measurements on their way"
            )
        if method == "dual-rate" and are_several(steps):
            check_in_flight(steps, gain)
        elif method == "dual-rate":
            dual_rate.check_steps(steps)
        else:
            check_serial(method, steps)


def check_cycle(N: int) -> None:
    """Raises InputError unless there can be so many steps from one measurement to the next."""
    if N < 1:
        raise InputError(f"{option('N')} {N} must be at least 1: it is the HR steps from one measurement to the next")
    if N > MOST_STEPS:
        raise InputError(
            f"{option('N')} {N} is too large: give at most {MOST_STEPS}, for test.c has a record of two cycles "
            f"and more; CYCLE_STEPS, in the header that is written, may be changed"
        )


def board_files(wanted: Filter) -> dict[str, str]:
    """The files of a method: of the dual rate filter with its tasks, of serial ones with steps, of others the jobs.

    Raises:
        Untranslatable: something in a job or the model has nothing in C; its file and line are named.
        InputError: steps or sizes do not fit.
        ValueError: the system cannot be filtered from x0.
    """
    check_wanted(wanted.method, wanted.system[:3], wanted.steps, wanted.gain)
    system = with_own_scratch(wanted.system)  # that of `wanted` stays as it is given, for the board
    jobs, dense = (_jobs(wanted._replace(system=each)) for each in (system, system._replace(structure=None)))
    in_c = translated(jobs, wanted.precision)
    return assembled(about_filter(wanted), dense, in_c, _around(wanted, jobs, in_c))


def array_sizes(wanted: Filter) -> Mapping[str, int]:
    """How many numbers each array of state.h has, the model's not among them. Raises as `board_files`."""
    jobs = _jobs(wanted)
    return _around(wanted, jobs, translated(jobs, wanted.precision)).sizes


def _jobs(wanted: Filter) -> Mapping[str, Job]:
    """The functions that are written."""
    jobs = ALL_METHODS[wanted.method].jobs(wanted.system, wanted.update, 0, wanted.x0)
    if wanted.method == "dual-rate":
        own = {kind: jobs[kind] for kind in dual_rate.kinds(wanted)}
        return named(own | more_jobs(jobs)) if wanted.steps is not None and are_several(wanted.steps) else own
    if wanted.steps is None:
        return jobs
    written = serial(wanted.method, wanted.steps)
    return named({kind: jobs[kind] for kind in written.jobs} | dict(written.more(wanted)))


def _around(wanted: Filter, jobs: Mapping[str, Job], in_c: Jobs) -> Around:
    method, system, steps = wanted.method, wanted.system, wanted.steps
    all_of_them = {kind: kind for kind in jobs}
    if steps is None:
        state, sizes = jobs_memory(system, jobs, in_c)
        words = {"tolerance": USUAL, "sources": "filter.c test.c", "includes": "", "functions": "", "run": ""}
        return Around({"state.h": state}, ["filter.c"], sizes, words, all_of_them)
    with restored(system):
        record = record_h(simulated(wanted, steps), wanted.precision)
    if method == "dual-rate":
        words = {"u": "record_u[j - 1]" if system.inputs else ""}
        several = are_several(steps)
        files, sizes = (tasks_in_flight if several else dual_rate.tasks)(wanted, jobs, in_c, steps)
        files = {**files, "record.h": record, "posix.c": posix_c(system, several), "freertos.c": ""}
        run = words_of_run("tasks", filled("tasks_run_in_flight.c" if several else "tasks_run.c", words))

        def late(on_core: Compiled | None) -> dict[str, str]:
            stacks = stacks_of(files["tasks.c"], in_c.unit.functions(), on_core.frames) if on_core else {}
            return {"freertos.c": freertos_c(system, stacks.values(), several)}

        timed = {kind: kind for kind in dual_rate.kinds(wanted)}
        return Around(files, ["filter.c", "tasks.c"], sizes, run, timed, late)
    written = serial(method, steps)
    files, sizes = steps_files(written, wanted, steps, jobs, in_c)
    run = words_of_run("steps", steps_run(written, wanted))
    timed = {kind: kind for kind in written.jobs} | dict(written.same)
    return Around({**files, "record.h": record}, ["filter.c", "steps.c"], sizes, run, timed)
