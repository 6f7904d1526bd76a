"""A browser for each process of tests, and a visit for each test."""

from __future__ import annotations

from collections.abc import Generator, Iterator

import pytest
from playwright.sync_api import Browser

from tests.browser import Visit, started


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    with started() as browser:
        yield browser


@pytest.fixture(scope="session")
def page_of_all(browser: Browser) -> Iterator[Visit]:
    """A new page takes longer than most of what is tried on it."""
    context = browser.new_context()
    yield Visit(context)
    context.close()


@pytest.fixture
def visit(page_of_all: Visit) -> Iterator[Visit]:
    """Empty, whatever other tests did. At the end: no error was raised on the page, and nothing was asked of another
    machine."""
    page_of_all.begin()
    yield page_of_all
    assert page_of_all.errors == []
    assert page_of_all.outside == []


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Generator[None, object, object]:
    """The page is left before the servers that it asks are gone."""
    try:
        return (yield)
    finally:
        visited = getattr(item, "funcargs", {}).get("visit")
        if visited is not None:
            visited.page.goto("about:blank")
