"""The table of a schedule's jobs."""

from __future__ import annotations

from typing import Any

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page

from tests.browser import Visit
from tests.reports.explorer.drawn import by_hand, late, nothing, schedule
from tests.reports.explorer.scripts import loaded

STYLES = ("palette.css", "plot.css", "gantt.css")


@pytest.fixture
def page(visit: Visit) -> Page:
    loaded(visit, "jobs", styles=STYLES)
    return visit.page


def show(page: Page, shown: dict[str, Any]) -> list[list[str]]:
    """The cells of its rows."""
    page.evaluate("shown => window.jobs.jobsTable(document.querySelector('#host'), shown)", shown)
    return cells(page)


def cells(page: Page) -> list[list[str]]:
    rows: list[list[str]] = page.evaluate(
        "[...document.querySelectorAll('#host tbody tr')].map(row => [...row.cells].map(cell => cell.innerText.trim()))"
    )
    return rows


def test_each_job_has_what_the_chart_tells_of_it(page: Page) -> None:
    rows = show(page, schedule())
    assert len(rows) == 12
    assert rows[0][2:5] == ["HR", "0 (0)", "0 (0)"]
    [update] = [row for row in rows if row[0] == "low-rate update of step 0"]
    assert update[1:4] == ["✓ met", "LR", "4 (10)"]
    assert update[5:] == ["8 (20)", "4 (10)", "8 (20)", "0 (0)", "3 times"]
    assert page.locator("#host caption").inner_text() == "Jobs, with times in steps (ms)"


def test_misses_are_said_in_words_and_can_be_shown_alone(page: Page) -> None:
    rows = show(page, late())
    assert [row[1] for row in rows if row[1].startswith("✗")] == ["✗ missed, never finishes"]
    assert "1 of 12 jobs misses its deadline" in page.locator("#host p").inner_text()
    page.get_by_label("only missed deadlines").check()
    assert [row[0] for row in cells(page)] == ["low-rate update of step 0"]


def test_where_none_is_missed_there_is_nothing_to_choose(page: Page) -> None:
    show(page, late())
    page.get_by_label("only missed deadlines").check()
    assert len(show(page, schedule())) == 12
    assert not page.get_by_label("only missed deadlines").is_visible()


def test_many_jobs_come_by_the_hundred(page: Page) -> None:
    def job(step: int) -> tuple[float, float, float]:
        return step, step + 0.5, step + 1

    assert len(show(page, by_hand(250, map(job, range(250))))) == 100
    assert page.get_by_role("status").inner_text() == "jobs 1 to 100 of 250"
    page.get_by_role("button", name="further jobs").click()
    assert cells(page)[0][0] == "high-rate job of step 100"
    page.get_by_role("button", name="last jobs").click()
    assert [row[0] for row in cells(page)][-1] == "high-rate job of step 249"
    assert page.get_by_role("status").inner_text() == "jobs 201 to 250 of 250"
    show(page, by_hand(250, map(job, range(250))))
    assert page.get_by_role("status").inner_text() == "jobs 201 to 250 of 250"
    page.get_by_role("button", name="first jobs").click()
    assert cells(page)[0][0] == "high-rate job of step 0"


@pytest.mark.parametrize("of", [schedule, late, nothing])
def test_it_breaks_no_rule_of_accessible_pages(of: Any, page: Page) -> None:
    show(page, of())
    found = Axe().run(page).response["violations"]
    assert [(each["id"], [node["html"] for node in each["nodes"]]) for each in found] == []
