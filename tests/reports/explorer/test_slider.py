"""A figure with a slider: its states one after another, by hand and by keys; the picture is the one of the file."""

from __future__ import annotations

import re

import pytest
from axe_playwright_python.sync_playwright import Axe
from matplotlib.figure import Figure
from playwright.sync_api import Page, expect

from reports.charts.panels import Panel, method_panel
from reports.pages import alive
from reports.pages.body import body_of
from reports.pages.markdown import Figures
from reports.pages.pictures import Frame, Picture, Sliding, pictures
from sched_sim.costs.table_file import load_costs
from sched_sim.design.least_speed import staircase
from sched_sim.design.methods import select
from sched_sim.design.timing import Timing
from tests.browser import Visit

PAPER = load_costs("steffes2014")
STAIRS = staircase(select(PAPER, "dual-rate"), 10, 4)


@pytest.fixture(scope="module")
def panels() -> list[Panel]:
    """For each L the dual-rate filter at its least speed."""
    return [method_panel(PAPER, "dual-rate", Timing(10, 4, stair.L), stair.speed) for stair in STAIRS]


@pytest.fixture(scope="module")
def picture(panels: list[Panel]) -> Picture:
    frames = [Frame(f"L = {stair.L}", [panel]) for stair, panel in zip(STAIRS, panels, strict=True)]
    return pictures({"by-l.svg": Sliding("L asked for", frames, at=3)})["by-l.svg"]


def opened(visit: Visit, picture: Picture) -> Page:
    figure = body_of(Figures("").figure("by-l.svg", "by L", "A caption.") + "\n", {"by-l.svg": picture}).lead
    title = "<!doctype html><html lang=en class=ss-ground><title>slider</title>"
    visit.page.set_content(f"{title}<style>{alive.style()}</style><main><h1>Slider</h1>{figure}</main>")
    visit.page.add_script_tag(content=alive.script(), type="module")
    return visit.page


@pytest.fixture
def page(visit: Visit, picture: Picture) -> Page:
    return opened(visit, picture)


def test_the_file_is_the_state_that_is_shown_first(picture: Picture, panels: list[Panel]) -> None:
    assert picture.svg == pictures({"by-l.svg": [panels[3]]})["by-l.svg"].svg


def test_keys_go_through_the_states_and_say_which(page: Page, panels: list[Panel]) -> None:
    slider = page.get_by_role("slider", name="L asked for")
    slider.focus()
    for key, at in (("ArrowLeft", 2), ("Home", 0), ("End", len(panels) - 1), ("ArrowRight", len(panels) - 1)):
        page.keyboard.press(key)
        expect(slider).to_have_attribute("aria-valuetext", f"L = {STAIRS[at].L}")
        expect(page.locator(".ss-slider-said")).to_have_text(f"L = {STAIRS[at].L}")
        expect(page.locator(".ss-alive-title")).to_contain_text(panels[at].notes[0])
        expect(page.locator(".ss-gantt-finding")).to_contain_text("no deadline missed")


def test_a_job_of_the_state_that_is_shown_tells_its_release_response_and_deadline(page: Page) -> None:
    page.get_by_role("slider").press("Home")
    expect(page.locator(".ss-alive-title")).to_contain_text(f"speed {float(STAIRS[0].speed):.4g}")
    page.get_by_role("button", name="next job").click()
    told = page.locator(".ss-gantt-tip").inner_text().lower()
    assert all(re.search(rf"{word}\s+[\d.]+", told) for word in ("release", "response time", "deadline"))


def test_on_a_phone_it_is_in_the_page_and_no_rule_of_accessible_pages_is_broken(page: Page) -> None:
    page.set_viewport_size({"width": 360, "height": 700})
    box = page.locator(".ss-slider").bounding_box()
    assert box is not None
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= 360
    assert [rule["id"] for rule in Axe().run(page).response["violations"]] == []


def test_on_paper_there_is_the_picture_alone(page: Page) -> None:
    page.emulate_media(media="print")
    assert page.get_by_role("img", name="by L").is_visible()
    assert page.locator(".ss-slider").is_hidden()


def test_curves_over_all_states_are_seen_first_and_tell_their_values(visit: Visit, panels: list[Panel]) -> None:
    axes = (curves := Figure(figsize=(4, 3))).add_subplot(xlabel="L", ylabel="speed")
    axes.plot([stair.L for stair in STAIRS], [float(stair.speed) for stair in STAIRS], "o-", label="dual-rate")
    frames = [Frame(f"L = {stair.L}", [panel]) for stair, panel in zip(STAIRS, panels, strict=True)]
    page = opened(visit, pictures({"by-l.svg": Sliding("L asked for", frames, 0, curves)})["by-l.svg"])
    page.locator(".ss-readout").press("Home")
    expect(page.locator(".ss-told")).to_contain_text("1.19")
    assert page.locator(".ss-slider").is_hidden()
    page.get_by_role("button", name="Show the chart").click()
    assert page.locator(".ss-readout").is_hidden()
    page.get_by_role("slider", name="L asked for").press("ArrowRight")
    expect(page.locator(".ss-alive-title")).to_contain_text(panels[1].notes[0])
