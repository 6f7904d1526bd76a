"""The published pages: alive, offline, and as they were where no script runs and on paper."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from axe_playwright_python.sync_playwright import Axe
from matplotlib.colors import to_hex
from playwright.sync_api import Browser, Locator, Page, expect

from reports.charts.panels import method_panel
from reports.drawing.dark import DARK_GROUND, contrast
from reports.pages import alive
from sched_sim.costs.table_file import load_costs
from sched_sim.design.timing import Timing
from sched_sim.schedule.intervals import JobSpan, jobs
from tests.browser import Visit
from tests.reports.published import FOLDER

REPORTS = sorted(path.parent.name for path in FOLDER.glob("*/index.html"))
OF_ALL_KINDS = [
    name if name in ("steffes2014", "erkf", "modular") else pytest.param(name, marks=pytest.mark.exhaust)
    for name in REPORTS
]
"""With sliders, charts, drawings, the most tables; the others are like them."""
LARGEST_SCRIPT = 100 * 1024
A4_MM, LETTER_MM, MARGIN_MM = 210.0, 215.9, 15.0
PHONE = 360
READABLE = 700
"""Pixels of a figure, in which its smallest text is 10 pixels high."""
WIDER = """[...document.querySelectorAll("table, figure, svg, pre")].filter(
    (it) => it.getBoundingClientRect().right > innerWidth || it.scrollWidth > it.clientWidth + 1
).map((it) => it.outerHTML)
"""
UNREACHED = """[...document.querySelectorAll("table, pre")].filter(
    (it) => it.getBoundingClientRect().right > innerWidth && !it.closest("[tabindex='0']")
).map((it) => it.outerHTML)
"""
FILLS = """(svg) => [":scope > path", "text"].map(
    (which) => getComputedStyle(svg.querySelector(which)).fill.match(/[0-9]+/g).slice(0, 3).map(Number)
)"""
THINNED = """[...document.querySelectorAll(".ss-picture > svg > :not(title), tbody tr:nth-child(n + 3)")].forEach(
    (it) => it.remove()
)"""


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


def figure(page: Page, file: str) -> Locator:
    """By the file that its caption leads to."""
    return page.locator(f'figure:has(a[href="{file}"])')


def picture(page: Page, file: str) -> Locator:
    return figure(page, file).locator(".ss-picture > svg")


def chart(page: Page) -> Locator:
    return figure(page, "fig3.svg").locator(".ss-gantt").nth(1)


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
    still, button = picture(page, "fig3.svg"), figure(page, "fig3.svg").get_by_role("button", name="Show the")
    assert still.is_hidden()
    assert button.inner_text() == "Show the printed figure"
    button.click()
    assert still.is_visible()
    assert chart(page).is_hidden()
    button.click()
    assert chart(page).is_visible()
    timeline, still = figure(page, "fig2.svg"), picture(page, "fig2.svg")
    assert still.is_visible()
    timeline.get_by_role("button", name="Show the chart").click()
    assert still.is_hidden()
    expect(timeline.locator(".ss-gantt-range")).to_have_text("steps 9 to 20")


def test_texts_of_a_figure_are_found_and_copied(visit: Visit) -> None:
    page = opened(visit)
    texts = picture(page, "costs.svg").locator("text").all_text_contents()
    longest = max(texts, key=len)
    assert page.evaluate("(text) => find(text)", longest)
    assert page.evaluate("getSelection().toString()") == longest


def test_on_paper_and_without_scripts_the_pictures_stand(visit: Visit, browser: Browser) -> None:
    page = opened(visit)
    page.emulate_media(media="print")
    assert_pictures_alone(page)
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(page_of("steffes2014").as_uri())
    assert_pictures_alone(page)
    assert page.locator(".table").first.get_attribute("tabindex") == "0"
    context.close()


def assert_pictures_alone(page: Page) -> None:
    assert all(still.is_visible() for still in page.locator(".ss-picture > svg").all())
    assert page.locator("canvas:visible, button:visible, .ss-readout:visible").count() == 0


@pytest.mark.parametrize("report", REPORTS)
def test_on_paper_no_table_loses_a_column_and_heads_come_again(visit: Visit, report: str) -> None:
    page = opened(visit, report)
    page.emulate_media(media="print", color_scheme="dark")
    for paper_mm in (A4_MM, LETTER_MM):
        page.set_viewport_size({"width": int((paper_mm - 2 * MARGIN_MM) / 25.4 * 96), "height": 900})
        assert page.evaluate(WIDER) == []
    assert page.evaluate("getComputedStyle(document.querySelector('thead')).display") == "table-header-group"
    assert page.evaluate("getComputedStyle(document.documentElement).backgroundColor") == "rgb(255, 255, 255)"
    assert page.locator("nav:visible, header:visible").count() == 0


@pytest.mark.parametrize("report", OF_ALL_KINDS)
def test_no_rule_of_accessible_pages_is_broken_and_a_phone_shows_all(visit: Visit, report: str) -> None:
    page = opened(visit, report)
    page.set_viewport_size({"width": PHONE, "height": 800})
    page.emulate_media(color_scheme="dark")
    assert page.evaluate("document.documentElement.scrollWidth") == PHONE
    assert page.evaluate(UNREACHED) == []
    assert broken(page) == []
    page.set_viewport_size({"width": 1280, "height": 900})
    page.emulate_media(color_scheme="light")
    assert broken(page) == []


def test_on_a_phone_the_figure_of_the_answer_is_the_narrow_one(visit: Visit) -> None:
    page = opened(visit, "patent-multirate")
    lead = page.locator("#figure-1")
    wide, narrow = lead.locator(".ss-picture > svg").all()
    assert (wide.is_visible(), narrow.is_visible()) == (True, False)
    page.set_viewport_size({"width": PHONE, "height": 800})
    assert (wide.is_visible(), narrow.is_visible()) == (False, True)
    assert lead.get_by_role("button", name="Full size").is_hidden()
    narrow.locator("xpath=..").locator(".ss-readout").first.press("End")
    expect(lead.locator(".ss-told:visible")).to_contain_text("10")
    page.emulate_media(media="print")
    assert (wide.is_visible(), narrow.is_visible()) == (True, False)


def test_on_a_phone_a_figure_opens_to_full_size_by_button_and_by_tap(visit: Visit) -> None:
    page = opened(visit)
    costs, still = figure(page, "costs.svg"), picture(page, "costs.svg")
    button = costs.get_by_role("button", name="Full size")
    assert button.is_hidden()
    page.set_viewport_size({"width": PHONE, "height": 800})
    for touch in (lambda: button.press("Enter"), lambda: still.click(position={"x": 3, "y": 3})):
        touch()
        assert button.get_attribute("aria-pressed") == "true"
        region = costs.get_by_role("region", name="at full size")
        region.focus()
        page.keyboard.press("ArrowRight")
        assert page.evaluate("document.activeElement.scrollWidth") >= READABLE
        assert page.evaluate("document.documentElement.scrollWidth") == PHONE
        touch()
        assert button.get_attribute("aria-pressed") == "false"
        assert region.count() == 0


def test_figures_follow_the_theme_while_the_page_is_open(visit: Visit) -> None:
    page = opened(visit)
    still = picture(page, "costs.svg")
    seen = []
    for theme in ({"color_scheme": "light"}, {"color_scheme": "dark"}, {"forced_colors": "active"}):
        page.emulate_media(**theme)  # type: ignore[arg-type]
        ground, text = (to_hex([part / 255 for part in fill]) for fill in still.evaluate(FILLS))
        seen.append(ground)
        assert contrast(ground, text) >= 4.5
    assert seen[:2] == ["#ffffff", DARK_GROUND]


def test_keys_skip_to_the_report_and_each_place_is_seen(visit: Visit) -> None:
    page = opened(visit)
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.textContent") == "Skip to the report"
    assert page.evaluate("document.activeElement.getBoundingClientRect().left") >= 0
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    assert page.evaluate("document.querySelector('main').contains(document.activeElement)")
    page.locator(".table").first.focus()
    page.keyboard.press("Shift+Tab")
    page.keyboard.press("Tab")
    assert page.evaluate("getComputedStyle(document.activeElement).outlineWidth") == "2px"


def broken(page: Page) -> list[tuple[str, list[str]]]:
    """Rules, and where; all rows of a table and all shapes of a picture are alike."""
    page.evaluate(THINNED)
    found = Axe().run(page).response["violations"]
    return [(rule["id"], [node["target"] for node in rule["nodes"]]) for rule in found]
