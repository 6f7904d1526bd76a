"""A real Dask scheduler and real workers: processes of their own, on the loopback."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]

PATIENCE_S = 300
"""Longer than any machine needs, however busy."""

END_WITH_THE_TESTS = f"""
import os, threading, time
def end():
    while os.getppid() == {os.getpid()}:
        time.sleep(1)
    os.killpg(0, 9)
threading.Thread(target=end, daemon=True).start()
"""
"""What the interpreter of each does first: one whose tests were killed would stay."""


class Processes:
    """Those of one scheduler. folder: for their files; settings: of Dask, in their environment."""

    def __init__(self, folder: Path, settings: dict[str, str]) -> None:
        self._folder = folder
        self._environment = os.environ | {"PYTHONPATH": str(ROOT), "PYTHONDONTWRITEBYTECODE": "1", **settings}
        self._started: list[subprocess.Popen[bytes]] = []
        file = folder / "scheduler.json"
        self.scheduler = self._start("scheduler", "--port", "0", "--scheduler-file", str(file))
        wait_for(lambda: file.exists() and file.read_bytes().endswith(b"}"))
        self.address: str = json.loads(file.read_text())["address"]

    def worker(self, *, nanny: bool = False, before: str = "pass") -> subprocess.Popen[bytes]:
        """One more, which has registered. With a nanny another one takes its place when it is killed. before: what its
        interpreter does first."""
        own = [self.address, "--nthreads", "1", "--nanny" if nanny else "--no-nanny"]
        started = self._start("worker", *own, "--local-directory", str(self._folder), before=before)
        log = self._folder / f"{len(self._started)}.log"
        wait_for(lambda: b"Registered to" in log.read_bytes())
        return started

    def _start(self, which: str, *options: str, before: str = "pass") -> subprocess.Popen[bytes]:
        code = f"{END_WITH_THE_TESTS}\n{before}\nfrom distributed.cli.dask_{which} import main\nmain()"
        line = [sys.executable, "-c", code, "--host", "127.0.0.1", "--dashboard-address", "127.0.0.1:0", *options]
        with (self._folder / f"{len(self._started) + 1}.log").open("wb") as log:
            started = subprocess.Popen(
                line,
                env=self._environment,
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
def dask_processes(folder: Path, **settings: str) -> Iterator[Processes]:
    """A scheduler; none of its processes is left at the end."""
    processes = Processes(folder, settings)
    try:
        yield processes
    finally:
        processes.close()


def wait_for(condition: Callable[[], object]) -> None:
    end = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.02)
