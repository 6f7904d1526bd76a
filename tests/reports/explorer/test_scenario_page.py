"""The page of a scenario in a browser: what it shows, and that its trace is scrolled through."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Literal

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, expect

from sched_sim.scenario.scenario import Scenario
from sched_sim.scenario.scenario_file import read_scenario
from studies.explorer.scenario import explore_scenario
from studies.explorer.scenario_runs import Runs
from studies.selection.in_scenario import question_of
from tests.browser import Visit
from tests.reports.explorer.form import drag, slider
from tests.reports.explorer.scenario_page import HOST, opened
from tests.scenarios import BY_HAND, scenario, sensor

WORTH = Path(__file__).parents[2] / "studies" / "explorer" / "worth.toml"
LATE = scenario(10, BY_HAND | {"correct.gps": [2] * 9 + [60]}, sensor("gps", 20, 8, land_by=10), steps=2_000)
URGENT = scenario(10, BY_HAND | {"predict": [4] * 19 + [9]}, sensor("gps", 20, 8, priority=5), steps=400)

Opened = Callable[..., Page]


@pytest.fixture
def page_of(visit: Visit) -> Iterator[Opened]:
    """Opens the page of a scenario with a query."""

    def open_page(of: Scenario, query: str = "") -> Page:
        question = None if of.accuracy is None else question_of(of, WORTH.parent)
        return opened(visit.page, Runs(of, question), query)

    yield open_page
    visit.page.unroute_all(behavior="ignoreErrors")


def test_it_answers_with_the_sentence_and_the_causes(page_of: Opened) -> None:
    page, view = page_of(LATE, "times_slower=3"), explore_scenario(replace(LATE, speed=LATE.speed / 3))
    expect(page.get_by_role("status").first).to_contain_text(view.answer["sentence"])
    assert page.locator(".ss-answer").get_attribute("data-state") == "misses"
    assert page.locator(".ss-warnings li").all_inner_texts() == list(view.warnings)
    expect(page.get_by_text(f"The processor is busy {100 * view.busy[0]:.3g} % of the time")).to_be_visible()


def test_a_job_is_picked_in_the_table_or_the_form_and_is_in_the_link(page_of: Opened) -> None:
    page = page_of(LATE)
    title = page.locator(".ss-plot-title").first
    page.get_by_role("button", name="correct gps", exact=True).click()
    expect(title).to_have_text("correct gps: response times")
    assert page.url == f"{HOST}/scenario?shown=correct+gps"
    page.get_by_label("Distribution of").select_option("predict")
    expect(title).to_have_text("predict: response times")
    page.go_back()
    expect(title).to_have_text("correct gps: response times")


def test_what_is_exact_is_found_when_it_is_asked_for(page_of: Opened) -> None:
    page = page_of(URGENT)
    button = page.get_by_role("button", name="Find the exact probabilities")
    expect(button.locator("xpath=..")).to_contain_text("mostly some seconds")
    button.click()
    expect(page.get_by_text("takes longer, exactly").first).to_be_visible()
    expect(button).to_be_hidden()
    assert page.url == f"{HOST}/scenario?exact=yes"
    page.get_by_label("Seed", exact=True).fill("5")
    expect(button).to_be_visible()
    page.go_back()
    expect(button).to_be_hidden()


def test_the_accuracy_is_told_where_a_model_is_stated_and_where_nothing_is_exact_why(page_of: Opened) -> None:
    of = read_scenario(WORTH)
    view = explore_scenario(of, question=question_of(of, WORTH.parent))
    assert view.accuracy is not None
    page = page_of(of)
    expect(page.get_by_text(view.accuracy.sentence)).to_be_visible()
    expect(page.get_by_text("there are 2 sensors, and a design has one")).to_be_visible()


def test_another_seed_is_another_run(page_of: Opened) -> None:
    page, view = page_of(LATE), explore_scenario(replace(LATE, seed=5))
    page.get_by_label("Seed", exact=True).fill("5")
    page.wait_for_url(f"{HOST}/scenario?seed=5")
    expect(page.get_by_role("status").first).to_contain_text(view.answer["sentence"])
    expect(page.locator("[data-shown]")).to_have_attribute("data-shown", "seed=5")


def test_a_drag_is_one_step_to_go_back(page_of: Opened) -> None:
    page = page_of(LATE)
    drag(page, slider(page, "Processor so many times as slow"), 0.5, 0.55, 0.6, 0.65)
    page.wait_for_url("**times_slower=**")
    page.go_back()
    expect(page.get_by_label("Processor so many times as slow", exact=True)).to_have_value("1")
    assert page.url == f"{HOST}/scenario"


def test_a_refusal_is_told_and_the_page_goes_on(page_of: Opened, visit: Visit) -> None:
    page = page_of(LATE)
    page.get_by_label("Steps", exact=True).fill("99999999")
    expect(page.get_by_role("alert")).to_have_text(["", "steps is 99999999: give at most 1,000,000", "", ""])
    expect(page.get_by_label("Steps", exact=True)).to_have_attribute("aria-invalid", "true")
    page.get_by_role("button", name="Back to the last design").click()
    expect(page.get_by_label("Steps", exact=True)).to_have_value("2000")
    visit.errors.clear()  # the browser's, of an answer with status 422


@pytest.mark.parametrize(
    ("query", "said"), [("file=vehicle.toml", "the query's key 'file' is unknown"), ("seed=1&seed=2", "seed twice")]
)
def test_of_a_link_that_is_refused_the_scenario_itself_is_shown(
    query: str, said: str, page_of: Opened, visit: Visit
) -> None:
    page = page_of(LATE, query)
    expect(page.get_by_text(said)).to_be_visible()
    expect(page.get_by_label("Steps", exact=True)).to_have_value("2000")
    visit.errors.clear()  # the browser's, of an answer with status 422


def test_the_trace_is_scrolled_through(page_of: Opened) -> None:
    page = page_of(LATE, "at=100&span=40")
    said = page.locator(".ss-trace-said")
    expect(said).to_have_text("Steps 100 to 140 of 2,000")
    page.get_by_role("button", name="Next steps").click()
    expect(said).to_have_text("Steps 140 to 180 of 2,000")
    page.get_by_role("button", name="Previous steps").click()
    expect(said).to_have_text("Steps 100 to 140 of 2,000")
    page.get_by_label("First step", exact=True).fill("1,990")
    page.get_by_label("First step", exact=True).press("Enter")
    expect(said).to_have_text("Steps 1,960 to 2,000 of 2,000")
    expect(page.get_by_role("button", name="Next steps")).to_be_disabled()
    page.get_by_label("First step shown").press("Home")
    expect(said).to_have_text("Steps 0 to 40 of 2,000")
    page.wait_for_url(f"{HOST}/scenario?at=0&span=40")


def test_the_trace_goes_from_miss_to_miss(page_of: Opened) -> None:
    runs = Runs(LATE)
    page, after = page_of(LATE, "at=0&span=24"), -1.0
    said = page.locator(".ss-trace-said")
    for _ in range(3):
        page.get_by_role("button", name="To the next late landing").click()
        found = runs.next(f"after={max(after, 0)}&of=landing")["found"]
        after = found["deadline"]
        expect(said).to_contain_text(f"correct gps of step {found['step']} misses its deadline, step {after:g}")
        expect(page.locator("[data-first]")).to_have_attribute("data-first", f"{max(after + 2 - 24, 0):g}")


def test_how_far_a_late_window_has_been_simulated_is_told(page_of: Opened, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("studies.explorer.scenario_runs.AT_ONCE", 1_000)
    page = page_of(replace(LATE, steps=30_000))
    texts = "[...document.querySelectorAll('.ss-trace-said')].map(each => each.textContent).join()"
    page.evaluate(f"window.told = []; new MutationObserver(() => told.push({texts}))"
                  ".observe(document.querySelector('.ss-trace-said'), {childList: true})")  # fmt: skip
    page.get_by_label("First step shown").press("End")
    expect(page.locator(".ss-trace-said")).to_have_text("Steps 29,960 to 30,000 of 30,000")
    assert "Simulating: 10,000 of 30,000 steps so far" in page.evaluate("told")


@pytest.mark.parametrize(("scheme", "width"), [("light", 1280), ("dark", 360)])
def test_there_is_no_axe_violation(scheme: Literal["light", "dark"], width: int, page_of: Opened, visit: Visit) -> None:
    visit.page.set_viewport_size({"width": width, "height": 800})
    visit.page.emulate_media(color_scheme=scheme)
    page = page_of(read_scenario(WORTH), "times_slower=3")
    found = Axe().run(page)
    assert found.response["violations"] == []
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_all_of_it_is_reached_by_keys(page_of: Opened) -> None:
    page = page_of(LATE, "at=0&span=24")
    reached = set()
    for _ in range(60):
        page.keyboard.press("Tab")
        reached.add(page.evaluate("document.activeElement.textContent || document.activeElement.id"))
    assert {"predict", "correct gps", "Next steps ›", "To the next miss", "To the next late landing"} <= reached
    page.get_by_role("button", name="To the next miss").focus()
    page.keyboard.press("Enter")
    expect(page.locator(".ss-trace-said")).to_contain_text("misses its deadline")
