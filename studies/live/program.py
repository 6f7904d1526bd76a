"""The program: the files of `sched-sim code`, and live.c around them."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

import numpy as np

from filters.backends.c_compiler import NoCompiler, compiler
from filters.simulation import simulate_truth
from filters.system import System
from sched_sim.errors import InputError, option
from studies.board import dual_rate
from studies.board.steps import Steps
from studies.board.wanted import Filter
from studies.board.write import board_files
from studies.live.design import KINDS, Design
from studies.live.jobs import Ran, parsed
from studies.live.rights import HIGH, LOW

FLAGS = ("-std=gnu11", "-O2", "-ffp-contract=off", "-DFAULT(message)=__builtin_trap()")
SEED = 0
LATER_S = 60
"""That a run may take longer than its periods."""


class Program(NamedTuple):
    """A filter that has been compiled for N and M; path: of the program."""

    path: Path
    wanted: Filter

    def run(self, design: Design, cpu: int, *, swapped: bool = False, once: bool = False) -> Ran:
        """The jobs of all cycles on core `cpu`. swapped: LR has the higher priority, which is wrong; once: each job is
        done once, however long that takes.

        Raises InputError where the kernel refuses, ValueError where the filter fails on its record.
        """
        high, low = (LOW, HIGH) if swapped else (HIGH, LOW)
        wanted = [0] * len(KINDS) if once else design.job_ns.values()
        numbers = (cpu, design.period_ns, design.cycles + 1, high, low, *wanted)
        try:
            done = subprocess.run(
                [self.path, *map(str, numbers)],
                input=_record(self.wanted, design),
                capture_output=True,
                check=False,
                timeout=LATER_S + design.steps * design.period_ns / 1e9,
            )
        except subprocess.TimeoutExpired as error:
            raise InputError(f"core {cpu} is too busy: the run took {error.timeout:.0f} s and was not done") from None
        said = done.stderr.decode(errors="replace").strip()
        if done.returncode == 3:
            raise InputError(f"the kernel gives no SCHED_FIFO thread on core {cpu}: {said}")
        if done.returncode:
            raise ValueError(f"the filter in C failed on its record: {said or f'status {done.returncode}'}")
        return parsed(done.stdout.decode().splitlines())


@contextmanager
def compiled(wanted: Filter) -> Iterator[Program]:
    """The program of the dual rate filter, there within the context.

    Raises:
        Untranslatable: something in a job or the model has nothing in C.
        ValueError: there is no compiler, or it cannot compile this.
    """
    cc = _compiler()
    with TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for name, text in board_files(wanted).items():
            (folder / name).write_text(text, encoding="utf-8")
        path = folder / "live"
        without = () if wanted.system.inputs else ("-DWITHOUT_INPUTS",)
        sources = (str(folder / "filter.c"), str(Path(__file__).with_name("live.c")), f"-I{folder}")
        command = [cc, *FLAGS, *without, *sources, "-lm", "-lpthread", "-o", str(path)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            raise ValueError(f"the C compiler fails: {' '.join(done.stderr.split()):.400}")
        yield Program(path, wanted)


def steps_of(N: int, M: int) -> Steps:
    """Corrections land as soon as they are ready."""
    return Steps(N, M, M + 1)


def check_steps(N: int, M: int) -> None:
    """Raises InputError unless 0 <= M < N: one measurement is on its way at a time."""
    if N > 1 and not 0 <= M < N:
        raise InputError(
            f"{option('M')} {M} must be from 0 to {N - 1}: live runs have one measurement on its way at a time, and "
            f"the next is taken {option('N')} {N} steps later; sched-sim code writes others"
        )
    dual_rate.check_steps(steps_of(N, M))


def check_compiler() -> None:
    """Raises InputError where there is no C compiler."""
    _compiler()


def _compiler() -> str:
    try:
        return compiler()
    except NoCompiler as error:
        raise InputError(f"live runs need a C compiler: {error}") from None


def _record(wanted: Filter, design: Design) -> bytes:
    """Inputs of all steps and measurements of all cycles, as doubles: the record of `sched-sim code`, only longer."""
    system: System = wanted.system
    u = np.random.default_rng(SEED).normal(size=(design.steps, system.inputs))
    truth = simulate_truth(system, design.N, wanted.x0, np.eye(system.states), u, SEED)
    return u.tobytes() + truth.measurements[: design.cycles + 1].tobytes()
