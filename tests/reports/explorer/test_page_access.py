"""The whole explorer's page for everyone: narrow, dark, by a screen reader; and pictures of it to look at."""

from __future__ import annotations

from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser

from tests.browser import Visit
from tests.reports.explorer.explored import Explorer, opened
from tests.reports.explorer.form import unfold

FLIGHT = "hr_hz=400&measurement_hz=5&delay_ms=110&model=ins-gps&within=0.4"
DESIGNS = {"flight": FLIGHT, "misses": "N=10&M=4&speed=0.7", "part": f"{FLIGHT}&processor=rp2040", "refused": "N=0&M=4"}
LOOKS = {
    "desktop": {"viewport": {"width": 1280, "height": 900}},
    "phone": {"viewport": {"width": 360, "height": 740}, "has_touch": True, "is_mobile": True},
    "dark": {"viewport": {"width": 1280, "height": 900}, "color_scheme": "dark"},
}


@pytest.mark.parametrize(
    ("design", "look"),
    [
        ("flight", "desktop"),
        ("flight", "phone"),
        ("flight", "dark"),
        ("misses", "dark"),
        ("part", "phone"),
        ("refused", "desktop"),
    ],
)
def test_no_rule_of_accessible_pages_is_broken(
    browser: Browser, explorer: Explorer, tmp_path: Path, design: str, look: str
) -> None:
    """And nothing is wider than the screen."""
    context = browser.new_context(**LOOKS[look])  # type: ignore[arg-type]
    visit = Visit(context)
    page = opened(visit, explorer, DESIGNS[design])
    unfold(page)
    found = Axe().run(page)
    page.screenshot(path=tmp_path / f"{design}-{look}.png", full_page=True)
    wide = page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth")
    context.close()
    assert found.violations_count == 0, found.generate_report()
    assert wide <= 0
    assert visit.outside == []
