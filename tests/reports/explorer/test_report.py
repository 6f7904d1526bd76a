"""The published pages: alive, offline, and as they were where no script runs and on paper."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, Locator, Page, expect

from reports.charts.panels import method_panel
from reports.pages import alive
from sched_sim.costs.table_file import load_costs
from sched_sim.design.timing import Timing
from sched_sim.schedule.intervals import JobSpan, jobs
from tests.browser import Visit
from tests.reports.published import FOLDER

REPORTS = sorted(path.parent.name for path in FOLDER.glob("*/index.html"))
LARGEST_SCRIPT = 100 * 1024


def page_of(report: str) -> Path:
    return FOLDER / report / "index.html"


def opened(visit: Visit, report: str = "steffes2014") -> Page:
    visit.page.goto(page_of(report).as_uri())
    return visit.page


@pytest.fixture(scope="module")
def dual_rate() -> list[JobSpan]:
    """The jobs of the second schedule of Fig. 3, in HR periods of so many ticks."""
    schedule = method_panel(load_costs("steffes2014"), "dual-rate", Timing(10, 4, 8), 0.77).schedule
    period = schedule.period
    return [
        job._replace(release=job.release / period, finish=(job.finish or 0) / period, deadline=job.deadline / period)  # type: ignore[arg-type]
        for job in jobs(schedule)
    ]


def figure(page: Page, name: str) -> Locator:
    return page.get_by_role("figure").filter(has=page.get_by_alt_text(re.compile(name)))


def chart(page: Page) -> Locator:
    return figure(page, "Fig. 3").locator(".ss-gantt").nth(1)


@pytest.mark.parametrize("report", REPORTS)
def test_a_page_has_one_script_that_is_small_and_ends_where_it_should(report: str) -> None:
    text = page_of(report).read_text(encoding="utf-8")
    scripts = re.findall(r'<script type="module">(.*?)</script>', text, re.DOTALL)
    assert len(scripts) == 1
    assert scripts[0].strip() == alive.script().strip(), "python -m tests.reports.rebuild"
    assert len(alive.script().encode()) < LARGEST_SCRIPT
    assert "</script" not in alive.script()


@pytest.mark.parametrize("report", REPORTS)
def test_every_figure_with_something_to_tell_is_alive_and_nothing_is_asked_for(visit: Visit, report: str) -> None:
    page = opened(visit, report)
    data = page.locator('script[type="application/json"]').count()
    assert data > 0
    assert page.locator("figure[data-alive]").count() == 0
    assert page.locator("figure:has(canvas), figure:has(.ss-readout)").count() == data
    assert all(url.startswith(("file:", "data:")) for url in visit.requests)


def test_a_job_that_is_walked_to_says_what_the_schedule_says(visit: Visit, dual_rate: list[JobSpan]) -> None:
    page = opened(visit)
    gantt = chart(page)
    gantt.locator(".ss-gantt-frame").focus()
    page.keyboard.press("Home")
    by_release = [job for job in dual_rate if job.row.name == "HR"]
    for job in by_release:
        told = gantt.locator("[aria-live]").inner_text()
        assert f"of step {job.step}," in told
        for instant in (job.release, job.finish, job.deadline):
            assert re.search(rf"\b{round(instant, 4):.6g}\b", told)
        page.keyboard.press("ArrowRight")


def test_under_the_pointer_a_job_tells_its_times(visit: Visit, dual_rate: list[JobSpan]) -> None:
    page = opened(visit)
    frame = chart(page).locator(".ss-gantt-frame")
    frame.scroll_into_view_if_needed()
    box = frame.bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + 0.55 * box["width"], box["y"] + 60)
    tip = page.locator(".ss-gantt-tip:visible").inner_text().lower()
    (job,) = [job for job in dual_rate if (job.kind, job.step) == ("hr", 5)]
    assert "of step 5" in tip
    assert [float(number) for number in re.findall(r"(?:release|finish|deadline)\s+([\d.]+)", tip)] == pytest.approx(
        [job.release, job.finish, job.deadline], abs=1e-4
    )


def test_a_button_brings_the_printed_figure_back_and_one_that_says_more_is_seen_first(visit: Visit) -> None:
    page = opened(visit)
    picture, button = page.get_by_alt_text(re.compile("Fig. 3")), figure(page, "Fig. 3").locator(".ss-switch")
    assert picture.is_hidden()
    assert button.inner_text() == "Show the printed figure"
    button.click()
    assert picture.is_visible()
    assert chart(page).is_hidden()
    button.click()
    assert chart(page).is_visible()
    timeline, picture = figure(page, "Fig. 2"), page.get_by_alt_text(re.compile("Fig. 2"))
    assert picture.is_visible()
    timeline.get_by_role("button", name="Show the chart").click()
    assert picture.is_hidden()
    expect(timeline.locator(".ss-gantt-range")).to_have_text("steps 9 to 20")


def test_on_paper_a_figure_is_its_picture(visit: Visit) -> None:
    page = opened(visit)
    page.emulate_media(media="print")
    assert all(image.is_visible() for image in page.locator("figure img").all())
    assert page.locator("canvas:visible, .ss-switch:visible, .ss-readout:visible").count() == 0


def test_without_scripts_the_pictures_stand(browser: Browser) -> None:
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(page_of("steffes2014").as_uri())
    assert all(image.is_visible() for image in page.locator("figure img").all())
    assert page.locator("canvas").count() == 0
    context.close()


def test_no_rule_of_accessible_pages_is_broken(visit: Visit) -> None:
    page = opened(visit)
    assert broken(page) == []
    page.set_viewport_size({"width": 360, "height": 800})
    assert broken(page, "figure") == []


def broken(page: Page, within: str | None = None) -> list[tuple[str, list[str]]]:
    """Rules, and where."""
    found = Axe().run(page, context=within).response["violations"]
    return [(rule["id"], [node["target"] for node in rule["nodes"]]) for rule in found]
