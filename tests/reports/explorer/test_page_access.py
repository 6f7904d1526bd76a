"""The whole explorer's page for everyone: narrow, dark, by a screen reader."""

from __future__ import annotations

from typing import Any

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import expect

from tests.browser import Visit
from tests.reports.explorer.explored import Explorer, opened
from tests.reports.explorer.form import unfold

FLIGHT = "hr_hz=400&measurement_hz=5&delay_ms=110&model=ins-gps&within=0.4"
PINNED = f"{FLIGHT}#A=N%3D10%26M%3D4"
DESKTOP, PHONE = {"width": 1280, "height": 900}, {"width": 360, "height": 740}


@pytest.mark.parametrize(
    ("query", "size", "scheme"),
    [
        (PINNED, PHONE, "light"),
        (f"{FLIGHT}&processor=rp2040", DESKTOP, "dark"),
        ("N=10&M=4&speed=0.7", PHONE, "dark"),
        ("N=0&M=4", DESKTOP, "light"),
    ],
    ids=["pinned on a phone", "on a part in the dark", "misses in the dark", "refused"],
)
def test_no_rule_of_accessible_pages_is_broken(
    visit: Visit, explorer: Explorer, query: str, size: Any, scheme: Any
) -> None:
    """And nothing is wider than the screen."""
    visit.page.set_viewport_size(size)
    visit.page.emulate_media(color_scheme=scheme)
    page = opened(visit, explorer, query)
    expect(page.get_by_role("button", name="Remove design A")).to_have_count(int(query == PINNED))
    unfold(page)
    found = Axe().run(page)
    assert found.violations_count == 0, found.generate_report()
    assert page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth") <= 0
    visit.errors[:] = [error for error in visit.errors if "status of 422" not in error]
