"""Scripts of the explorer on an empty page, to ask them and to look at what they draw."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from playwright.sync_api import Browser

from reports.explorer.module import asset, module
from tests.browser import Visit

Ask = Callable[..., Any]
LOADED = """async ([name, text]) => {
  const url = URL.createObjectURL(new Blob([text], {type: "text/javascript"}));
  window[name] = await import(url);
}"""
PAGE = """<!doctype html><html lang="en"><head><title>a test</title>
<meta name="viewport" content="width=device-width, initial-scale=1"><style>{style}</style></head>
<body class="ss-ground"><main><h1>A test</h1><div id="host"></div></main></body></html>"""


def loaded(visit: Visit, *names: str, styles: tuple[str, ...] = ()) -> None:
    """An empty page with a `div` named host; what each module exports is in the window under its name."""
    visit.page.set_content(PAGE.format(style="".join(asset(style) for style in styles)))
    for name in names:
        visit.page.evaluate(LOADED, [name, module(name)])


@contextmanager
def asking(browser: Browser, name: str) -> Iterator[Ask]:
    """A function that evaluates a body in which the exports are `of`, and the arguments a, b, c: for pure functions,
    which leave nothing behind on the page."""
    context = browser.new_context()
    visit = Visit(context)
    loaded(visit, name)

    def ask(body: str, *arguments: object) -> Any:
        given = [*arguments, None, None, None][:3]
        return visit.page.evaluate(f"([a, b, c]) => {{ const of = window.{name}; {body} }}", given)

    yield ask
    context.close()
    assert visit.errors == []
