"""What stands before the explorer's server: whom it answers, and what each answer tells the browser it may do.

The server listens on this machine alone, but every page that a browser here has open can send requests to it. Only the
page that the server itself serves gets an answer: one of another site, or of a name that is made to point here, neither
reads anything nor has anything computed.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable, MutableMapping
from typing import Any

from studies.explorer.query import LONGEST

Scope = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[MutableMapping[str, Any]]]
Send = Callable[[MutableMapping[str, Any]], Awaitable[None]]
App = Callable[[Scope, Receive, Send], Awaitable[None]]

HEADERS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
    "img-src 'self' data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}
"""Of every answer."""


def guarded(app: App, port: int, pages: frozenset[str]) -> App:
    """`app`, asked only what is refused for no reason, and its answers with `HEADERS`.

    port: where it listens; pages: the paths that a link of another site may lead to, which compute nothing.
    """

    async def answer(scope: Scope, receive: Receive, send: Send) -> None:
        async def send_with_headers(message: MutableMapping[str, Any]) -> None:
            if message["type"] == "http.response.start":
                more = [(name.lower().encode(), value.encode()) for name, value in HEADERS.items()]
                message = {**message, "headers": [*message.get("headers", ()), *more]}
            await send(message)

        if scope["type"] != "http":
            await app(scope, receive, send)
            return
        status, why = refusal(scope, port, pages)
        if not status:
            await app(scope, receive, send_with_headers)
            return
        content = b"" if scope["method"] == "HEAD" else f"{why}\n".encode()
        headers = [(b"content-type", b"text/plain; charset=utf-8"), (b"content-length", str(len(content)).encode())]
        if status == 405:
            headers.append((b"allow", b"GET, HEAD"))
        await send_with_headers({"type": "http.response.start", "status": status, "headers": headers})
        await send({"type": "http.response.body", "body": content})

    return answer


def refusal(scope: Scope, port: int, pages: frozenset[str]) -> tuple[int, str]:
    """Status and reason; 0 for a request that is answered."""
    headers = {name: value.decode("latin-1") for name, value in scope["headers"]}
    names = own_names(port)
    if headers.get(b"host", "").lower() not in names:
        return 400, f"This server answers as {' and '.join(names)} alone; forward the same port: {forwarding(port)}"
    if scope["method"] not in ("GET", "HEAD"):
        return 405, "This server is only asked: GET or HEAD"
    if len(scope["query_string"]) > LONGEST:
        return 414, f"This link is too long: {len(scope['query_string'])} characters, of at most {LONGEST}"
    if scope["path"] not in pages and _foreign(headers, names):
        return 403, "This is answered to the explorer's own page alone: open that first"
    return 0, ""


def own_names(port: int) -> tuple[str, ...]:
    """As a browser's Host has them, which leaves a port of 80 out."""
    return tuple(name if port == 80 else f"{name}:{port}" for name in ("127.0.0.1", "localhost"))


def forwarding(port: int) -> str:
    """The command that makes the server be on another machine, too."""
    return f"ssh -L {port}:127.0.0.1:{port}"


def _foreign(headers: dict[bytes, str], names: tuple[str, ...]) -> bool:
    """Whether the browser says that another site asks."""
    if headers.get(b"sec-fetch-site", "none") not in ("none", "same-origin"):
        return True
    return headers.get(b"origin", f"http://{names[0]}") not in [f"http://{name}" for name in names]
