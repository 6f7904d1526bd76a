"""A server of the page for tests: views that are made up, as slow, refused or gone as a test wants them."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from reports.explorer.module import module, stylesheet
from reports.explorer.pages import DESIGNS
from tests.reports.explorer.made_view import RefusedError, made_view

POLL_S = 0.01
"""How soon it sees that it is to end: a test waits for that."""

POLICY = "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data:"


class SmallServer:
    """asked: the queries of views, in order; view: makes them; `open` while it may answer; port: 0 until it runs."""

    def __init__(self, view: Callable[[str], dict[str, Any]] = made_view) -> None:
        self.view = view
        self.asked: list[str] = []
        self.open = threading.Event()
        self.open.set()
        self.port = 0

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.port}/"

    def answer(self, path: str) -> tuple[int, str, str]:
        """Status, type and text."""
        name, _, query = path.partition("?")
        texts = {
            "/": ("text/html", DESIGNS.html),
            "/explorer.js": ("text/javascript", lambda: module("page")),
            "/explorer.css": ("text/css", stylesheet),
        }
        if name in texts:
            kind, text = texts[name]
            return 200, kind, text()
        if name != "/view":
            return 404, "text/plain", "nothing here"
        self.asked.append(query)
        self.open.wait(20)
        try:
            return 200, "application/json", json.dumps(self.view(query))
        except RefusedError as error:
            return 422, "application/json", json.dumps({"error": str(error)})

    @contextmanager
    def running(self) -> Iterator[SmallServer]:
        """It runs inside; again at the same port when it has run before."""
        answer = self.answer

        class Handler(BaseHTTPRequestHandler):
            def do_GET(self) -> None:
                status, kind, text = answer(self.path)
                try:
                    self.send_response(status)
                    self.send_header("Content-Type", f"{kind}; charset=utf-8")
                    self.send_header("Content-Length", str(len(text.encode())))
                    self.send_header("Content-Security-Policy", POLICY)
                    self.end_headers()
                    self.wfile.write(text.encode())
                except OSError:
                    pass  # the browser has stopped waiting

            def log_message(self, *said: object) -> None:
                pass

        class Server(ThreadingHTTPServer):
            request_queue_size = 64

        server = Server(("127.0.0.1", self.port), Handler)
        self.port = server.server_address[1]
        thread = threading.Thread(target=server.serve_forever, args=(POLL_S,), daemon=True)
        thread.start()
        try:
            yield self
        finally:
            server.shutdown()
            server.server_close()
            thread.join()
