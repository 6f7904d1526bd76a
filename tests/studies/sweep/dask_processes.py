"""A real Dask scheduler and real workers: processes of their own, on the loopback."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import sysconfig
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]

PATIENCE_S = 300
"""Longer than any machine needs, however busy."""


class Processes:
    """Those of one scheduler. folder: for their files; options: of all of them, settings: of Dask, by environment."""

    def __init__(self, folder: Path, options: tuple[str, ...], settings: dict[str, str]) -> None:
        self._folder = folder
        self._options = options
        self._environment = os.environ | {"PYTHONDONTWRITEBYTECODE": "1", **settings}
        self._started: list[subprocess.Popen[bytes]] = []
        file = folder / "scheduler.json"
        self.scheduler = self._start("scheduler", "--port", "0", "--scheduler-file", str(file))
        wait_for(lambda: file.exists() and file.read_bytes().endswith(b"}"))
        self.address: str = json.loads(file.read_text())["address"]

    def worker(self, *, nanny: bool = False, stranger: bool = False) -> subprocess.Popen[bytes]:
        """One more, which has registered. With a nanny another one takes its place when it is killed; a stranger has
        Dask and not this project."""
        own = [self.address, "--nthreads", "1", "--nanny" if nanny else "--no-nanny"]
        started = self._start("worker", *own, "--local-directory", str(self._folder), stranger=stranger)
        log = self._folder / f"{len(self._started)}.log"
        wait_for(lambda: b"Registered to" in log.read_bytes())
        return started

    def _start(self, which: str, *options: str, stranger: bool = False) -> subprocess.Popen[bytes]:
        path = sysconfig.get_path("purelib") if stranger else str(ROOT)
        line = [sys.executable, *(["-S"] if stranger else []), "-m", f"distributed.cli.dask_{which}", *options]
        line += ["--host", "127.0.0.1", "--dashboard-address", "127.0.0.1:0", *self._options]
        with (self._folder / f"{len(self._started) + 1}.log").open("wb") as log:
            started = subprocess.Popen(
                line,
                env=self._environment | {"PYTHONPATH": path},
                cwd=self._folder,
                stdout=log,
                stderr=log,
                start_new_session=True,
            )
        self._started.append(started)
        return started

    def close(self) -> None:
        for process in self._started:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()


@contextmanager
def dask_processes(folder: Path, *options: str, **settings: str) -> Iterator[Processes]:
    """A scheduler; none of its processes is left at the end."""
    processes = Processes(folder, options, settings)
    try:
        yield processes
    finally:
        processes.close()


def wait_for(condition: Callable[[], object]) -> None:
    end = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.02)
