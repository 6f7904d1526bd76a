"""A browser for each process of tests, and a visit for each test."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser

from tests.browser import Visit, started


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    with started() as browser:
        yield browser


@pytest.fixture
def visit(browser: Browser) -> Iterator[Visit]:
    """At the end: no error was raised on the page, and nothing was asked of another machine."""
    context = browser.new_context()
    visit = Visit(context)
    yield visit
    context.close()
    assert visit.errors == []
    assert visit.outside == []
