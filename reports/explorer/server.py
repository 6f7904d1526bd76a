"""The explorer's web application: pages, and what they ask."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from contextlib import suppress
from functools import cache, partial

from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route

from reports.explorer.answer import Answer, Asked, Question, document
from reports.explorer.compact import compact
from reports.explorer.guard import App, guarded
from reports.explorer.module import module, stylesheet
from reports.explorer.pages import DESIGNS, SCENARIO
from reports.explorer.worker import Worker

MOST_WAITING = 16
"""Questions at a time: a page asks one."""

BUSY = "The explorer is busy with what other pages have asked: close some of them, or wait"

GONE = 499
"""The status of an answer that nobody waits for; it is not sent."""


def application(port: int, questions: Mapping[str, Question], asked: Asked) -> App:
    """port: where it will listen; questions: by path, with the page of a scenario if some are below its."""
    worker = Worker()
    waiting: set[asyncio.Task[Answer]] = set()

    async def ask(request: Request) -> Response:
        """One computation at a time; none for a browser that has gone before its turn."""
        path = request.url.path
        if len(waiting) >= MOST_WAITING:
            return _response(document({"error": BUSY}, 503))
        what = partial(asked.answer, path, questions[path], request.scope["query_string"].decode("latin-1"))
        task = asyncio.create_task(worker.compute(what))
        waiting.add(task)
        gone = asyncio.create_task(_gone(request))
        try:
            await asyncio.wait({task, gone}, return_when=asyncio.FIRST_COMPLETED)
            return _response(task.result()) if task.done() else Response(status_code=GONE)
        finally:
            waiting.discard(task)
            for pending in (task, gone):
                pending.cancel()
                with suppress(asyncio.CancelledError):
                    await pending

    pages = [page for page in (DESIGNS, SCENARIO) if any(map(page.is_asked_by, questions))]
    routes = [
        *(Route(page.path, _text(page.html, "text/html")) for page in pages),
        *(Route(page.script, _text(partial(_script, page.entry), "text/javascript")) for page in pages),
        Route("/explorer.css", _text(_style, "text/css")),
        Route("/favicon.ico", _no_icon),
        *(Route(path, ask) for path in questions),
    ]
    app = Starlette(routes=routes, exception_handlers={404: _not_there})
    return guarded(app, port, frozenset(page.path for page in pages))


@cache
def _script(entry: str) -> str:
    return compact(module(entry))


@cache
def _style() -> str:
    return compact(stylesheet())


async def _gone(request: Request) -> None:
    """Returns when the browser has closed the connection."""
    while (await request.receive())["type"] != "http.disconnect":
        pass


def _response(answer: Answer) -> Response:
    headers = {} if answer.file is None else {"Content-Disposition": f'attachment; filename="{answer.file}"'}
    return Response(answer.content, answer.status, headers, answer.media)


def _text(content: Callable[[], str], media: str) -> Callable[[Request], Awaitable[Response]]:
    async def text(_request: Request) -> Response:
        return Response(content(), media_type=media)

    return text


async def _no_icon(_request: Request) -> Response:
    return Response(status_code=204)


async def _not_there(_request: Request, _error: Exception) -> Response:
    return PlainTextResponse("There is nothing here: the explorer is at /\n", 404)
