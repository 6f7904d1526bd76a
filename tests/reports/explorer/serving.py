"""The explorer's application over questions of one's own, and a client of it."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple, TypeVar

import httpx
import pytest

pytest.importorskip("starlette", reason="the extra explore is not installed")

from reports.explorer.answer import Answer, Asked, Question, document
from reports.explorer.guard import App
from reports.explorer.server import application

PORT = 8400
T = TypeVar("T")
HERE = f"http://127.0.0.1:{PORT}"


def run(coroutine: Coroutine[Any, Any, T]) -> T:
    """In a thread of its own: the browser of other tests has a loop in this one."""
    with ThreadPoolExecutor(1) as thread:
        return thread.submit(asyncio.run, coroutine).result()


def echo(query: str) -> Answer:
    return document({"query": query})


class Client(NamedTuple):
    """Asks an application without a network; follows no redirect."""

    app: App
    port: int = PORT

    def request(self, method: str, path: str, headers: Mapping[str, str] = {}) -> httpx.Response:
        async def ask() -> httpx.Response:
            async with httpx.AsyncClient(
                transport=httpx.ASGITransport(self.app), base_url=f"http://127.0.0.1:{self.port}"
            ) as asking:
                return await asking.request(method, path, headers=headers)

        return run(ask())

    def get(self, path: str, headers: Mapping[str, str] = {}) -> httpx.Response:
        return self.request("GET", path, headers)


def client(question: Question = echo, tell: Callable[[str], None] = print) -> Client:
    """Of a server that answers `question` at /view."""
    return Client(application(PORT, {"/view": question}, Asked(tell)))
