"""The explorer's server as it runs: until Ctrl-C."""

from __future__ import annotations

import asyncio
import gc
import signal
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol

from reports.explorer.guard import App

MOST_OPEN = 64
"""Connections on which nothing is being answered: a browser has about six."""

AT_A_TIME = 32
"""Connections that are taken on together, so that these and the open ones are fewer than a process may have files."""


class _Connection(H11Protocol):
    """One more than MOST_OPEN, and the one that has waited longest for a request ends, so that neither browsers that
    went to sleep nor a program that opens connections alone keeps others out."""

    _since = 0.0

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]  # of TCP alone
        super().connection_made(transport)
        self._since = self.loop.time()
        waiting = [of for of in self.connections if isinstance(of, _Connection) and of._waits and of is not self]
        if len(waiting) >= MOST_OPEN:
            min(waiting, key=lambda of: of._since).transport.abort()

    @property
    def _waits(self) -> bool:
        return (self.cycle is None or self.cycle.response_complete) and not self.transport.is_closing()


class _Server(uvicorn.Server):
    """One that Ctrl-C and SIGTERM end without waiting for any answer, and that does not raise them again."""

    @contextmanager
    def capture_signals(self) -> Iterator[None]:
        """A signal that is ignored stays so."""
        wanted = [number for number in (signal.SIGINT, signal.SIGTERM) if signal.getsignal(number) != signal.SIG_IGN]
        before = {number: signal.signal(number, self.handle_exit) for number in wanted}
        try:
            yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)

    def handle_exit(self, _number: int, _frame: FrameType | None) -> None:
        self.should_exit = self.force_exit = True

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Browsers see at once that nobody answers any more."""
        for connection in list(self.server_state.connections):
            connection.transport.abort()
        await super().shutdown(sockets)


def serve(app: App, there: socket.socket) -> None:
    """Answer at the socket until SIGINT or SIGTERM. What is there by then stays: no answer waits while it is looked
    through for what is not used any more."""
    gc.freeze()
    config = uvicorn.Config(
        app,
        http=_Connection,
        backlog=AT_A_TIME,
        ws="none",
        lifespan="off",
        loop="asyncio",
        log_config=None,
        log_level="critical",
        access_log=False,
        proxy_headers=False,
        server_header=False,
        timeout_graceful_shutdown=0,
    )
    _Server(config).run([there])
