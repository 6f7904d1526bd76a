"""One computation at a time, and none for a browser that has gone before its turn."""

from __future__ import annotations

import asyncio
from collections.abc import MutableMapping
from threading import Event
from typing import Any

import pytest

pytest.importorskip("starlette", reason="the extra explore is not installed")

from reports.explorer.answer import Answer
from reports.explorer.guard import App
from reports.explorer.server import MOST_WAITING
from reports.explorer.worker import Worker
from tests.reports.explorer.serving import PORT, client, run

STATUS = "http.response.start"


class Browser:
    """One request to an application, and the end of its connection."""

    def __init__(self, app: App, query: str) -> None:
        self._closed = asyncio.Event()
        self._asked = False
        self.status: list[int] = []
        scope = {
            "type": "http",
            "method": "GET",
            "path": "/view",
            "query_string": query.encode(),
            "headers": [(b"host", f"127.0.0.1:{PORT}".encode())],
        }
        self.done = asyncio.create_task(app(scope, self._receive, self._send))

    async def _receive(self) -> MutableMapping[str, Any]:
        if self._asked:
            await self._closed.wait()
            return {"type": "http.disconnect"}
        self._asked = True
        return {"type": "http.request", "body": b"", "more_body": False}

    async def _send(self, message: MutableMapping[str, Any]) -> None:
        if message["type"] == STATUS:
            self.status.append(message["status"])

    async def leave(self) -> None:
        self._closed.set()
        await self.done


class Slow:
    """A question that is answered when it is let; begun: the queries of which computing has begun."""

    def __init__(self) -> None:
        self.begun: list[str] = []
        self.let, self._has_begun = Event(), Event()

    def __call__(self, query: str) -> Answer:
        self.begun.append(query)
        self._has_begun.set()
        assert self.let.wait(60)
        return Answer(b"")

    async def has_begun(self) -> None:
        await asyncio.to_thread(self._has_begun.wait, 60)


def test_what_has_not_begun_is_not_computed_for_a_browser_that_has_gone() -> None:
    slow = Slow()

    async def ask() -> list[int]:
        app = client(slow).app
        first = Browser(app, "first")
        await slow.has_begun()
        second, third = Browser(app, "second"), Browser(app, "third")
        await asyncio.sleep(0)
        await second.leave()
        slow.let.set()
        await asyncio.gather(first.done, third.done)
        return first.status + third.status

    assert run(ask()) == [200, 200]
    assert slow.begun == ["first", "third"]


def test_who_goes_while_it_is_computed_is_let_go_at_once() -> None:
    slow = Slow()

    async def ask() -> list[int]:
        app = client(slow).app
        first = Browser(app, "first")
        await slow.has_begun()
        await first.leave()
        slow.let.set()
        second = Browser(app, "second")
        await second.done
        return second.status

    assert run(ask()) == [200]


def test_only_so_many_wait() -> None:
    slow = Slow()

    async def ask() -> list[int]:
        app = client(slow).app
        waiting = [Browser(app, str(number)) for number in range(MOST_WAITING)]
        await slow.has_begun()
        await asyncio.sleep(0)
        more = Browser(app, "one more")
        await more.done
        slow.let.set()
        await asyncio.gather(*(browser.done for browser in waiting))
        return more.status

    assert run(ask()) == [503]
    assert "one more" not in slow.begun


def test_a_worker_gives_what_is_returned_and_raised() -> None:
    def fail() -> None:
        raise ZeroDivisionError

    async def ask() -> None:
        worker = Worker()
        assert await worker.compute(lambda: 7) == 7
        try:
            await worker.compute(fail)
        except ZeroDivisionError:
            assert await worker.compute(lambda: 8) == 8
        else:
            raise AssertionError("nothing was raised")

    run(ask())
