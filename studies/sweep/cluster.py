"""The workers of a Dask scheduler, which is there already, share the work of a sweep; nothing is lost when they go.

Tasks and results travel as bytes that are made here: Dask would look into each cell of each row. What a worker was at
that is killed, Dask gives to another, until several have died on it.
"""

from __future__ import annotations

import asyncio
import pickle
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Future, wait
from time import monotonic
from typing import TYPE_CHECKING, Generic

from sched_sim.errors import InputError
from studies.sweep.dispatch import CHECK_S, PER_WORKER, Compute, Result, Task, Trial, dispatch
from studies.sweep.versions import refusal, versions

if TYPE_CHECKING:
    import distributed

COUNT_S = 1.0
"""How often workers are counted."""

ANSWER_S = 5.0
"""How long that may take."""

WORKERLESS_S = 60.0
"""How long there may be none before the sweep gives up."""


def workers_of(client: distributed.Client, where: str) -> Compute:
    """Those of the scheduler that `client` is connected to; `where` is what messages call it.

    The computation raises InputError when the scheduler is lost, when it has had no worker for long, and where one has
    other versions than this process.
    """

    def compute(
        work: Callable[[Task], Result],
        spans: Iterator[range],
        task_of: Callable[[range], Task],
        stopped: Callable[[], bool],
    ) -> Iterator[Result]:
        return dispatch(_Team(client, where, work), spans, task_of, stopped)

    return compute


class _Team(Generic[Task, Result]):
    """The workers that the scheduler has at the time, and what they are at: results as bytes, None where they die."""

    def __init__(self, client: distributed.Client, where: str, work: Callable[[Task], Result]) -> None:
        self.work = work
        self.under_way: dict[Future[bytes | None], Trial] = {}
        self._client = client
        self._where = where
        self._has_failed = False
        self._threads = 1
        self._counted = -COUNT_S
        self._last_seen = monotonic()

    @property
    def room(self) -> int:
        """None any more once something has failed."""
        return 0 if self._has_failed else PER_WORKER * self._threads

    def submit(self, trial: Trial, task: Task) -> None:
        future: Future[bytes | None]
        if self._client.status == "running":
            promise = self._client.submit(_computed, pickle.dumps((self.work, task)), versions(), pure=False)
            loop = self._client.loop.asyncio_loop
            future = asyncio.run_coroutine_threadsafe(_outcome(promise, self._where), loop)
        else:
            future = Future()
            future.set_exception(lost(self._where))
        self.under_way[future] = trial

    def collect(self) -> tuple[list[Result], list[Trial]]:
        """What has been computed since, and what workers die on; waits for something, but not long.

        Raises what a span failed with once there is nothing else to hand out.
        """
        self._count()
        done, _ = wait(self.under_way, CHECK_S, FIRST_COMPLETED)
        failed = {future for future in done if future.exception()}
        for future in failed if failed == done else ():
            future.result()
        self._has_failed = bool(failed)
        trials = [(future.result(), self.under_way.pop(future)) for future in done - failed]
        return (
            [pickle.loads(found) for found, _ in trials if found is not None],
            [trial for found, trial in trials if found is None],
        )

    def finished(self) -> list[Result]:
        """What has been computed by now."""
        well = (future.result() for future in self.under_way if future.done() and not future.exception())
        return [pickle.loads(found) for found in well if found is not None]

    def _count(self) -> None:
        """The threads of all workers; workers come and go."""
        now = monotonic()
        if now - self._counted < COUNT_S or self._client.status != "running":
            return
        self._counted = now
        try:
            threads = sum(self._client.nthreads(callback_timeout=ANSWER_S).values())
        except OSError:  # if the scheduler is lost, what is under way tells
            return
        if threads:
            self._threads, self._last_seen = threads, now
        elif now - self._last_seen > WORKERLESS_S:
            raise InputError(
                f"{self._where}: the scheduler has had no worker for {WORKERLESS_S:g} s: start some; all finished "
                f"points are kept, and the same command goes on"
            )


def lost(where: str) -> InputError:
    """What to say when the connection to the scheduler has ended."""
    return InputError(
        f"{where}: the scheduler is gone: start it again; all finished points are kept, and the same command goes on"
    )


async def _outcome(promise: distributed.Future[bytes], where: str) -> bytes | None:
    """The result, None if workers die on it; when the scheduler is lost, Dask cancels what it has promised."""
    from distributed import KilledWorker

    try:
        result: bytes = await promise
        return result
    except KilledWorker:
        return None
    except Exception:
        if promise.status == "error":
            raise
        raise lost(where) from None


def _computed(task: bytes, ours: Mapping[str, str]) -> bytes:
    """In a worker: a task's result."""
    from distributed import get_worker

    if difference := refusal(versions(), ours):
        raise InputError(f"worker {get_worker().address} {difference}")
    work, given = pickle.loads(task)
    return pickle.dumps(work(given))
