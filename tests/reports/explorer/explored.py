"""`sched-sim explore` in a process of its own, and its page in a browser: the whole, from a control to a picture."""

from __future__ import annotations

import json
import os
import signal
import subprocess
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any
from urllib.error import HTTPError
from urllib.parse import urlsplit
from urllib.request import urlopen

from playwright.sync_api import Page

from tests.browser import Visit
from tests.reports.explorer.started import started


class Explorer:
    """first: the address that the command says."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process
        assert process.stdout is not None
        self.first = process.stdout.readline().split()[-1]
        address = urlsplit(self.first)
        self.base = f"{address.scheme}://{address.netloc}/"
        self.port = address.port

    def view(self, query: str, path: str = "view") -> Any:
        """Raises AssertionError, with what is said, for a query that is refused."""
        try:
            with urlopen(f"{self.base}{path}?{query}") as answer:
                return json.load(answer)
        except HTTPError as error:
            raise AssertionError(f"{query}: {error.read().decode()}") from None

    def end(self) -> str:
        """By Ctrl-C; what is said on standard error."""
        os.killpg(self._process.pid, signal.SIGINT)
        return self._process.communicate(timeout=60)[1]

    def kill(self) -> None:
        self._process.kill()
        self._process.wait()

    def pause(self) -> None:
        """Nothing is answered until it goes on."""
        self._process.send_signal(signal.SIGSTOP)

    def go_on(self) -> None:
        self._process.send_signal(signal.SIGCONT)


@contextmanager
def exploring(*options: str) -> Iterator[Explorer]:
    with started("-m", "sched_sim", "explore", "--no-browser", *options) as process:
        yield Explorer(process)


def opened(visit: Visit, explorer: Explorer, query: str | None = None) -> Page:
    """The page with its first picture; query: by default that of the command."""
    visit.page.goto(explorer.first if query is None else f"{explorer.base}?{query}")
    visit.page.wait_for_selector('.ss-explorer[data-shown]:not([data-shown=""])')
    return visit.page


def shown(page: Page, explorer: Explorer) -> Mapping[str, Any]:
    """The view of the address, once it is drawn."""
    view: Mapping[str, Any] = explorer.view(page.url.partition("?")[2].partition("#")[0])
    page.wait_for_selector(f'.ss-explorer:not(.ss-stale)[data-shown="{view["query"]}"]')
    return view
