"""What the whole explorer's page says when its server is slow, gone, or there again."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import expect

from tests.browser import Visit
from tests.reports.explorer.explored import exploring, opened, shown
from tests.reports.explorer.form import give

pytest.importorskip("uvicorn", reason="the extra explore is not installed")

DESIGN = ("-N", "10", "-M", "4")


def left(visit: Visit) -> None:
    """The page, which asks again and again, so that the browser says that nobody is there."""
    visit.page.goto("about:blank")
    visit.errors[:] = [error for error in visit.errors if "ERR_CONNECTION_REFUSED" not in error]


def test_a_server_that_is_gone_is_told_and_the_page_goes_on_with_the_next(visit: Visit) -> None:
    with exploring("--port", "0", *DESIGN) as explorer:
        page = opened(visit, explorer)
        explorer.kill()
        give(page, "M", "5")
        expect(page.get_by_text("is not running any more")).to_be_visible()
        with exploring("--port", str(explorer.port), *DESIGN) as again:
            assert shown(page, again)["design"]["M"] == 5
        expect(page.get_by_text("is not running any more")).to_be_hidden()
    left(visit)


def test_a_server_that_ends_while_it_is_asked_is_told(visit: Visit) -> None:
    with exploring("--port", "0", *DESIGN) as explorer:
        page = opened(visit, explorer)
        explorer.pause()
        give(page, "M", "5")
        expect(page.get_by_text("Still computing")).to_be_visible()
        explorer.go_on()
        assert shown(page, explorer)["design"]["M"] == 5
        assert re.match("Ended after", explorer.end().splitlines()[1])
        give(page, "M", "6")
        expect(page.get_by_text("is not running any more")).to_be_visible()
    left(visit)
