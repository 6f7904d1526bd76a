"""Work shared among processes that outlive nothing and lose nothing.

The workers exit when the process that started them ends, however it ends. A worker that is killed takes the whole
pool with it (so `concurrent.futures` has it): a new one is started, and what was under way is done again.
"""

from __future__ import annotations

import os
import signal
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from multiprocessing import get_context
from multiprocessing.connection import Connection
from threading import Thread
from typing import Generic, NamedTuple, TypeVar

Task = TypeVar("Task")
Result = TypeVar("Result")

PER_WORKER = 2
"""Spans under way for each worker: one that runs, one that waits."""

CHECK_S = 0.1
"""How often to look whether to stop."""

DEATHS = 3
"""So many workers may die on one point, alone in the pool, before it is given up."""


class WorkerDeathError(Exception):
    """Workers die again and again on one point."""

    def __init__(self, point: int) -> None:
        super().__init__(f"worker processes die on point {point}")
        self.point = point


class _Trial(NamedTuple):
    """A span to be computed, and how many workers have died on it while it was alone in the pool."""

    span: range
    deaths: int = 0


def compute(
    work: Callable[[Task], Result],
    spans: Iterator[range],
    task_of: Callable[[range], Task],
    workers: int,
    stopped: Callable[[], bool],
) -> Iterator[Result]:
    """`work(task_of(span))` for each span, in order of completion; `work` runs in `workers` processes.

    Once `stopped()`, what has been computed is handed out and the rest left. When a worker dies, the spans that were
    under way are done again, each alone in the pool, and one that kills it there is cut down to the guilty point.
    With 0 workers, and where none can be started (a /dev/shm that cannot be written has no room for their locks),
    `work` runs here.
    Raises WorkerDeathError with that point, and whatever `work` raises.
    """
    try:
        team = _Team(work, workers) if workers else None
    except OSError:
        team = None
    if team is None:
        yield from (work(task_of(span)) for span in spans if not stopped())
        return
    again: deque[_Trial] = deque()
    try:
        while not stopped():
            if again and not team.under_way:
                trial = again.popleft()
                team.submit(trial, task_of(trial.span))
            while not again and len(team.under_way) < PER_WORKER * workers and (span := next(spans, None)):
                team.submit(_Trial(span), task_of(span))
            if not team.under_way:
                return
            alone = len(team.under_way) == 1
            results, lost = team.collect()
            yield from results
            if lost:
                again.extendleft(reversed(_blame(lost[0]) if alone else lost))
                team.close()
                team = _Team(work, workers)
        yield from team.finished()
    finally:
        team.close()


def _blame(trial: _Trial) -> list[_Trial]:
    """What to try next of a span that killed its worker while nothing else ran."""
    span, deaths = trial
    if len(span) > 1:
        middle = len(span) // 2
        return [_Trial(span[:middle]), _Trial(span[middle:])]
    if deaths + 1 == DEATHS:
        raise WorkerDeathError(span.start)
    return [_Trial(span, deaths + 1)]


class _Team(Generic[Task, Result]):
    """A pool of workers and what they are at."""

    def __init__(self, work: Callable[[Task], Result], workers: int) -> None:
        self.work = work
        self.under_way: dict[Future[Result], _Trial] = {}
        context = get_context("spawn")
        self._watched, self._held = context.Pipe(duplex=False)
        self._pool = ProcessPoolExecutor(workers, context, initializer=_watch, initargs=(self._watched,))

    def submit(self, trial: _Trial, task: Task) -> None:
        """Ctrl-C reaches every process of a terminal: it is blocked where workers start, so that they inherit that."""
        mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        try:
            future = self._pool.submit(self.work, task)
        except BrokenProcessPool as error:  # a worker died while none was busy
            future = Future()
            future.set_exception(error)
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        self.under_way[future] = trial

    def collect(self) -> tuple[list[Result], list[_Trial]]:
        """What has been computed since, and what was lost with a worker; waits for something, but not long."""
        done, _ = wait(self.under_way, CHECK_S, FIRST_COMPLETED)
        if not done and any(process.exitcode is not None for process in self._pool._processes.values()):
            self._abandon()
            done, _ = wait(self.under_way)
        if any(_is_lost(future) for future in done):
            done, _ = wait(self.under_way)
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
