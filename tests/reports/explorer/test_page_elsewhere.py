"""A page of another site in the same browser: it has nothing computed, reads nothing, and frames nothing."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread

import pytest

from tests.browser import Visit
from tests.reports.explorer.explored import exploring

pytest.importorskip("uvicorn", reason="the extra explore is not installed")

ASKS = """async ([address, mode]) => {
  try {
    await fetch(address, { mode });
    return "answered";
  } catch {
    return "nothing";
  }
}"""
LOADS = """([name, address]) => new Promise((resolve) => {
  const element = document.createElement(name);
  element.onload = () => resolve("loaded");
  element.onerror = () => resolve("nothing");
  element.src = address;
  document.body.append(element);
})"""


class Handler(SimpleHTTPRequestHandler):
    def log_message(self, *said: object) -> None:
        pass


@pytest.fixture
def elsewhere(tmp_path: Path) -> Iterator[int]:
    """The port of another server."""
    (tmp_path / "index.html").write_text("<!doctype html><title>elsewhere</title><p>here", encoding="utf-8")
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Handler, directory=tmp_path))
    Thread(target=server.serve_forever, args=(0.01,), daemon=True).start()
    yield server.server_address[1]
    server.shutdown()
    server.server_close()


def test_it_gets_nothing(visit: Visit, elsewhere: int) -> None:
    """By another name, which is another site, and by another port alone, which is not."""
    with exploring("--port", "0", "-N", "10", "-M", "4") as explorer:
        page, base = visit.page, explorer.base
        for name in ("localhost", "127.0.0.1"):
            page.goto(f"http://{name}:{elsewhere}/")
            view = f"{base}view?N=10&M=4"
            assert [page.evaluate(ASKS, [view, mode]) for mode in ("cors", "no-cors")] == ["nothing"] * 2
            for element, path in (
                ("script", "view?N=10&M=4"),
                ("script", "explorer.js"),
                ("img", "schedule.svg?N=10&M=4"),
            ):
                assert page.evaluate(LOADS, [element, f"{base}{path}"]) == "nothing"
            page.evaluate(LOADS, ["iframe", explorer.first])
            assert not [frame for frame in page.frames[1:] if frame.locator(".ss-explorer").count()]
        assert "0 answered" in explorer.end()
    visit.errors.clear()  # the browser says what it has refused
