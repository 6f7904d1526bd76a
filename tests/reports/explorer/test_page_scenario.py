"""A scenario's page of the whole explorer, as the command serves it."""

from __future__ import annotations

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, expect

from tests.browser import Visit
from tests.reports.explorer.explored import Explorer, exploring
from tests.reports.explorer.form import drag
from tests.scenarios import ROCKET

pytest.importorskip("uvicorn", reason="the extra explore is not installed")


@pytest.mark.slow
def test_it_is_opened_changed_and_come_back_to(visit: Visit) -> None:
    with exploring("--port", "0", "--scenario", str(ROCKET)) as explorer:
        page = visit.page
        page.goto(explorer.first)
        expect(page.locator("[data-first]").first).to_be_visible()
        assert Axe().run(page).violations_count == 0
        sliders = page.locator("form input[type=range]:visible")
        for number in range(sliders.count()):
            drag(page, sliders.nth(number), 0.5, 0.3, 0.6)
        query = settled(page, explorer)
        link = page.evaluate("location.href")
        page.goto(explorer.base)
        page.goto(link)
        assert settled(page, explorer) == query
        page.goto("about:blank")  # it asks no more


def settled(page: Page, explorer: Explorer) -> str:
    """The query that is drawn, once it is that of the address, which follows what is drawn, too. The page is asked for
    its address: what the driver has heard of it may be older."""
    for _ in range(600):
        asked = explorer.view(page.evaluate("location.search.slice(1)"), "scenario/view")["query"]
        if page.locator(".ss-scenario").get_attribute("data-shown") == asked:
            return str(asked)
        page.wait_for_timeout(100)
    raise AssertionError(f"{page.evaluate('location.href')} is not drawn")
