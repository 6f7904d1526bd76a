"""One thread that computes for an event loop, one thing after the other."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from concurrent.futures import Future
from queue import SimpleQueue
from threading import Thread
from typing import Any, TypeVar

Result = TypeVar("Result")


class Worker:
    """Pages that ask at once wait for one another. What is cancelled before its turn is never begun; what has begun
    goes on to its end, as a thread cannot be stopped, but keeps no process from ending."""

    def __init__(self) -> None:
        self._asked: SimpleQueue[tuple[Callable[[], Any], Future[Any]]] = SimpleQueue()
        self._thread: Thread | None = None

    async def compute(self, what: Callable[[], Result]) -> Result:
        """What `what` returns or raises."""
        if self._thread is None:
            self._thread = Thread(target=self._run, name="explorer", daemon=True)
            self._thread.start()
        future: Future[Result] = Future()
        self._asked.put((what, future))
        return await asyncio.wrap_future(future)

    def _run(self) -> None:
        while True:
            what, future = self._asked.get()
            if future.set_running_or_notify_cancel():
                try:
                    result = what()
                except Exception as error:
                    future.set_exception(error)
                else:
                    future.set_result(result)
