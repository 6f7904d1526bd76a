"""The server in a process of its own, and how it ends."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager, suppress
from http.client import HTTPConnection

import pytest

from tests.reports.explorer.started import started

pytest.importorskip("uvicorn", reason="the extra explore is not installed")

SERVER = """
import sys
from reports.explorer.answer import Answer, Asked
from reports.explorer.port import listening
from reports.explorer.serve import serve
from reports.explorer.server import application

def question(query):
    if query == "forever":
        say("computing")
        while True: pass
    if query == "bad": raise ZeroDivisionError
    return Answer(query.encode())

def say(words): print(words, file=sys.stderr, flush=True)

there = listening(0)
port = there.getsockname()[1]
say(port)
serve(application(port, {"/view": question}, Asked(say)), there)
say("ended")
"""


class Server:
    """What it says on standard error comes line by line."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self.process = process
        self.port = int(self.line())

    def line(self) -> str:
        assert self.process.stderr is not None
        return self.process.stderr.readline().rstrip("\n")

    def asked(self, query: str) -> HTTPConnection:
        connection = HTTPConnection("127.0.0.1", self.port, timeout=60)
        connection.request("GET", f"/view?{query}")
        return connection

    def get(self, query: str) -> tuple[int, bytes]:
        with closing(self.asked(query)) as connection:
            answer = connection.getresponse()
            return answer.status, answer.read()

    def refused(self) -> int:
        """The status of what needs no computing."""
        with closing(HTTPConnection("127.0.0.1", self.port, timeout=60)) as connection:
            connection.request("GET", "/nothing")
            return connection.getresponse().status

    def end(self, number: int) -> tuple[int, str, str]:
        """A signal to all of its session, as the keyboard sends it; exit code and what is said then."""
        os.killpg(self.process.pid, number)
        out, err = self.process.communicate(timeout=60)
        return self.process.returncode, out, err


@contextmanager
def running(ignoring: str = "") -> Iterator[Server]:
    code = f"import signal\n{ignoring}\n{SERVER}"
    with started("-c", code) as process:
        yield Server(process)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_it_quietly_while_it_computes_and_browsers_are_connected(number: int) -> None:
    with running() as server:
        assert server.get("one") == (200, b"one")
        with closing(server.asked("two")) as idle, closing(server.asked("forever")) as computing:
            assert idle.getresponse().read() == b"two"
            assert server.line() == "computing"
            with closing(server.asked("three")):
                assert server.end(number) == (0, "", "ended\n")
            with pytest.raises(ConnectionError):  # so that its page says that nobody answers any more
                computing.getresponse()


def test_nothing_is_left_of_its_session() -> None:
    with running() as server:
        server.end(signal.SIGINT)
        with pytest.raises(ProcessLookupError):
            os.killpg(server.process.pid, 0)
        with socket.socket() as there:
            assert there.connect_ex(("127.0.0.1", server.port)) != 0


def test_a_signal_that_is_ignored_stays_so() -> None:
    with running("signal.signal(signal.SIGINT, signal.SIG_IGN)") as server:
        os.killpg(server.process.pid, signal.SIGINT)
        assert server.get("one") == (200, b"one")
        assert server.end(signal.SIGTERM)[0] == 0


def test_connections_that_ask_nothing_keep_nobody_out() -> None:
    """More than the process may have files: the first ones are ended, one that is answered is not."""
    few = "import resource\nresource.setrlimit(resource.RLIMIT_NOFILE, (256, 256))"
    with running(few) as server, ExitStack() as open_ones, closing(server.asked("forever")) as computing:
        assert server.line() == "computing"
        here = ("127.0.0.1", server.port)
        opened = []
        for _ in range(12):
            opened += [open_ones.enter_context(socket.create_connection(here)) for _ in range(25)]
            opened[-1].sendall(b"GET / HTTP/1.1\r\nHost:")
            assert server.refused() == 404
        assert opened[0].recv(1, socket.MSG_DONTWAIT) == b""
        with pytest.raises(BlockingIOError):
            opened[-1].recv(1, socket.MSG_DONTWAIT)
        assert server.end(signal.SIGINT)[2] == "ended\n"
        with pytest.raises(ConnectionError):
            computing.getresponse()


def test_it_goes_on_after_a_browser_that_has_gone_and_an_error() -> None:
    with running() as server:
        server.asked("one").close()
        assert server.get("bad")[0] == 500
        assert server.line() == "Unexpected, at /view?bad:"
        assert server.get("two") == (200, b"two")


def test_it_goes_on_after_what_is_no_request() -> None:
    with running() as server:
        for sent in (b"\x16\x03\x01 hello", b"GET / HTTP/1.1\r\n\r\n", b"GET /\r\n\r\n", b"X" * 100_000):
            with socket.create_connection(("127.0.0.1", server.port), timeout=60) as there, suppress(ConnectionError):
                there.sendall(sent)
                there.shutdown(socket.SHUT_WR)
                assert there.makefile("rb").readline() in (b"", b"HTTP/1.1 400 Bad Request\r\n")
            assert server.get("two") == (200, b"two"), sent
        assert server.end(signal.SIGINT) == (0, "", "ended\n")
