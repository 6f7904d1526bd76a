"""A real browser, Debian's Chromium, for tests of what is drawn in one."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from playwright.sync_api import Browser, BrowserContext, Page, expect, sync_playwright

expect.set_options(timeout=60_000)  # of a busy machine

QUIET = ("--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
         "--disable-component-update", "--disable-sync")  # fmt: skip


def chromium() -> str:
    """Its path; skips the test where it is not installed."""
    path = shutil.which("chromium")
    if path is None:
        pytest.skip("there is no chromium: apt-get install chromium")
    return path


@contextmanager
def started() -> Iterator[Browser]:
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium(), args=list(QUIET))
        yield browser
        browser.close()


class Visit:
    """A page, and what went wrong on it: errors, and requests that leave the machine."""

    def __init__(self, context: BrowserContext) -> None:
        self.page: Page = context.new_page()
        self.errors: list[str] = []
        self.requests: list[str] = []
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on("console", lambda said: self.errors.append(said.text) if said.type == "error" else None)
        context.on("request", lambda request: self.requests.append(request.url))

    def begin(self) -> None:
        """As a new page is."""
        self.page.unroute_all()
        self.page.set_viewport_size({"width": 1280, "height": 720})
        self.page.emulate_media(
            media="null", color_scheme="light", reduced_motion="no-preference", forced_colors="none"
        )
        self.errors, self.requests = [], []

    @property
    def outside(self) -> list[str]:
        """Requests to anything but this machine."""
        own = ("http://127.0.0.1:", "http://localhost:", "data:", "blob:", "about:", "file:")
        return [url for url in self.requests if not url.startswith(own)]
