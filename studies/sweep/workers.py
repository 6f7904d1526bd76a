"""Processes that share the work of a sweep, outlive nothing and lose nothing.

The workers exit when the process that started them ends, however it ends. A worker that is killed takes the whole
pool with it (so `concurrent.futures` has it): a new one is started, and what was under way is done again.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing, suppress
from multiprocessing import get_context
from multiprocessing.connection import Connection
from threading import Thread
from typing import Generic

from studies.sweep.dispatch import CHECK_S, PER_WORKER, Compute, Result, Task, Trial, dispatch


def processes(number: int) -> Compute:
    """So many processes.

    With none, and where none can be started (a /dev/shm that cannot be written has no room for their locks), the work
    is done here.
    """

    def compute(
        work: Callable[[Task], Result],
        spans: Iterator[range],
        task_of: Callable[[range], Task],
        stopped: Callable[[], bool],
    ) -> Iterator[Result]:
        try:
            team = _Team(work, number) if number else None
        except OSError:
            team = None
        if team is None:
            yield from (work(task_of(span)) for span in spans if not stopped())
            return
        with closing(team):
            yield from dispatch(team, spans, task_of, stopped)

    return compute


class _Team(Generic[Task, Result]):
    """A pool of workers and what they are at."""

    def __init__(self, work: Callable[[Task], Result], workers: int) -> None:
        self.work = work
        self.workers = workers
        self.room = PER_WORKER * workers
        self.under_way: dict[Future[Result], Trial] = {}
        self._start()

    def _start(self) -> None:
        context = get_context("spawn")
        self._watched, self._held = context.Pipe(duplex=False)
        self._pool = ProcessPoolExecutor(self.workers, context, initializer=_watch, initargs=(self._watched,))
        self._is_broken = False

    def submit(self, trial: Trial, task: Task) -> None:
        """Ctrl-C reaches every process of a terminal: it is blocked where workers start, so that they inherit that."""
        if self._is_broken:
            self.close()
            self._start()
        mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            future = self._pool.submit(self.work, task)
        except BrokenProcessPool as error:  # a worker died while none was busy
            future = Future()
            future.set_exception(error)
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        self.under_way[future] = trial

    def collect(self) -> tuple[list[Result], list[Trial]]:
        """What has been computed since, and what was lost with a worker; waits for something, but not long."""
        done, _ = wait(self.under_way, CHECK_S, FIRST_COMPLETED)
        if not done and any(process.exitcode is not None for process in self._pool._processes.values()):
            self._abandon()
            done, _ = wait(self.under_way)
        if any(_is_lost(future) for future in done):
            done, _ = wait(self.under_way)
            self._is_broken = True
        trials = [(future, self.under_way.pop(future)) for future in list(self.under_way) if future in done]
        lost = [trial for future, trial in trials if _is_lost(future)]
        return [future.result() for future, _ in trials if not _is_lost(future)], lost

    def finished(self) -> list[Result]:
        """What has been computed by now."""
        return [future.result() for future in self.under_way if future.done() and not future.exception()]

    def _abandon(self) -> None:
        """End the workers, and the wait for what one may have half sent.

        To ask the pool for it may be in vain: one that was killed may have locked the queue by which they would hear.
        """
        self._held.close()
        self._pool._result_queue._writer.close()  # type: ignore[attr-defined]  # the pool has no public way

    def close(self) -> None:
        """No process is left when this returns; what is under way is dropped."""
        self._abandon()
        self._pool.shutdown(wait=True, cancel_futures=True)
        self._watched.close()


def _is_lost(future: Future[Result]) -> bool:
    return isinstance(future.exception(), BrokenProcessPool)


def _watch(parent: Connection) -> None:
    """In a worker: end with the parent. Its end of the pipe is closed when it says so, and when it dies."""
    Thread(target=_end_with, args=(parent,), daemon=True).start()


def _end_with(parent: Connection) -> None:
    with suppress(EOFError, OSError):
        parent.recv_bytes()
    os._exit(1)
