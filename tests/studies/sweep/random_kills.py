"""Sweeps that are killed somewhere, many in a short time: each is a fork of this process, which has all imported.

Run in an interpreter of its own (`tests.deaths.call_alone`). Workers are forks too instead of new interpreters; all
else is as `sched-sim sweep` has it.
"""

from __future__ import annotations

import importlib
import os
import random
import signal
import threading
import time
import traceback
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from ctypes import CDLL
from multiprocessing import active_children
from multiprocessing.connection import Connection
from multiprocessing.context import ForkContext, ForkProcess
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import ClassVar

from studies.sweep import run as sweeping
from studies.sweep import workers
from studies.sweep.export import export
from studies.sweep.run import Sweep, run
from studies.sweep.settings import settings
from tests.deaths import killed_at_call

ANALYSED = settings({"N": "5:6", "M": "1:2", "speed": "0.6,0.8,1"}).sweep()
SIMULATED = settings({"N": "4:5", "M": "1:2", "speed": "0.8,1.2", "simulate": True, "cycles": 2}).sweep()

PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER = 1, 36
_libc = CDLL(None)

PATIENCE_S = 600
"""Longer than any machine needs, however busy: what takes that long will never end."""


def kill_many(first: int, number: int) -> None:
    """Trials `first`, `first` + 1, ... until so many were killed, as their seeds draw it; each then goes on to the rows
    of one that was not killed."""
    _prepare()
    whole = {sweep.digest: _uninterrupted(sweep) for sweep in (ANALYSED, SIMULATED)}
    lifetime = _lifetime()
    died: Counter[str] = Counter()
    for seed in range(first, first + 10 * number):
        if died.total() >= number:
            break
        draw = random.Random(seed)
        kind = draw.choice(list(KILLS))
        with TemporaryDirectory() as folder:
            try:
                sweep, was_killed = KILLS[kind](Path(folder, "r.sqlite"), draw, lifetime)
                assert _exported(sweep, Path(folder)) == whole[sweep.digest], "other rows"
            except Exception as error:
                raise AssertionError(f"seed {seed}, {kind}: {error}") from error
            died[kind] += was_killed
    print(dict(died))
    assert died.total() == number, "most ended before they were killed"


def _prepare() -> None:
    sweeping.ANALYSED, sweeping.SIMULATED_STEPS = 5, 60  # many small portions
    workers.get_context = lambda _: _Forks()
    workers._watch = _watch_alone
    _libc.prctl(PR_SET_CHILD_SUBREAPER, 1)
    importlib.import_module("sched_sim.design.simulate")


class _Fork(ForkProcess):
    """Ends at SIGTERM, as a new interpreter does."""

    def start(self) -> None:
        before = signal.signal(signal.SIGTERM, signal.SIG_DFL)
        super().start()
        signal.signal(signal.SIGTERM, before)


class _Forks(ForkContext):
    """Notes the ends of pipes that a new interpreter would not have."""

    Process = _Fork
    held: ClassVar[list[Connection]] = []

    def Pipe(self, duplex: bool = True) -> tuple[Connection, Connection]:
        watched, held = super().Pipe(duplex)
        self.held.append(held)
        return watched, held


def _watch_alone(parent: Connection, watch: Callable[[Connection], None] = workers._watch) -> None:
    for end in _Forks.held:
        end.close()
    watch(parent)


def _kill_parent(path: Path, draw: random.Random, lifetime: float) -> tuple[Sweep, bool]:
    """At any time; its workers end with it."""
    child = _forked(lambda: _life(SIMULATED, path, draw.choice([1, 2])))
    time.sleep(draw.uniform(0, lifetime))
    os.kill(child, signal.SIGKILL)
    _, status = os.waitpid(child, 0)
    _wait_for_orphans()  # forks have the lock too
    return SIMULATED, os.WIFSIGNALED(status)


def _kill_worker(path: Path, draw: random.Random, lifetime: float) -> tuple[Sweep, bool]:
    """At any time; the sweep goes on without a word. Its last words, the kill, are in a file."""
    said = path.with_name("killed")

    def kill() -> None:
        time.sleep(draw.uniform(0, lifetime))
        team = active_children()
        if team:
            os.kill(draw.choice(team).pid or 0, signal.SIGKILL)
            said.touch()

    def work() -> None:
        threading.Thread(target=kill, daemon=True).start()
        _life(SIMULATED, path, draw.choice([1, 2]))

    _, status = os.waitpid(_forked(work), 0)
    assert status == 0, "the sweep did not survive the death of a worker"
    killed = said.exists()
    said.unlink(missing_ok=True)
    return SIMULATED, killed


def _kill_at_call(path: Path, draw: random.Random, _lifetime: float) -> tuple[Sweep, bool]:
    """As it begins any of its system calls, most of them of checkpoints."""
    return ANALYSED, killed_at_call(draw.randrange(1, 500), lambda: _life(ANALYSED, path, 1))


KILLS: dict[str, Callable[[Path, random.Random, float], tuple[Sweep, bool]]] = {
    "parent": _kill_parent,
    "worker": _kill_worker,
    "checkpoint": _kill_at_call,
}


def _life(sweep: Sweep, path: Path, number: int) -> None:
    with sweep.open(path) as store:
        store.query("PRAGMA wal_autocheckpoint = 2")  # pages
        run(sweep, store, workers.processes(number), lambda _: None)


def _exported(sweep: Sweep, folder: Path) -> bytes:
    """After what is missing has been computed; no worker and no other file is left."""

    def resume() -> None:
        with sweep.open(folder / "r.sqlite") as store:
            run(sweep, store, workers.processes(1), lambda _: None)
            export(store, folder / "r.csv")

    _, status = os.waitpid(_forked(resume), 0)
    assert status == 0, "the sweep cannot go on"
    _wait_for_orphans()
    assert sorted(os.listdir(folder)) == ["r.csv", "r.sqlite"]
    return (folder / "r.csv").read_bytes()


def _uninterrupted(sweep: Sweep) -> bytes:
    with TemporaryDirectory() as folder:
        return _exported(sweep, Path(folder))


def _lifetime() -> float:
    """Of a simulated sweep, in seconds."""
    with TemporaryDirectory() as folder:
        start = time.monotonic()
        os.waitpid(_forked(lambda: _life(SIMULATED, Path(folder, "r.sqlite"), 2)), 0)
        return time.monotonic() - start


def _wait_for_orphans() -> None:
    """Until the workers of a parent that was killed have ended: they are children of this process now."""
    end = time.monotonic() + PATIENCE_S
    with suppress(ChildProcessError):
        while True:
            if os.waitpid(-1, os.WNOHANG) == (0, 0):
                assert time.monotonic() < end, "workers outlive their sweep"
                time.sleep(0.002)


def _forked(work: Callable[[], None]) -> int:
    child = os.fork()
    if child == 0:
        code = 1
        _libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
        try:
            work()
            code = 0
        except BaseException:
            traceback.print_exc()
        finally:
            os._exit(code)
    return child
