"""The explorer in a notebook: what Python says the page shows, what the page is told Python knows."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace

import pytest
from axe_playwright_python.sync_playwright import Axe
from hypothesis import given, settings
from hypothesis import strategies as st
from playwright.sync_api import Page, expect

pytest.importorskip("anywidget", reason="the extra notebook is not installed")

from reports import Explorer
from sched_sim.errors import InputError
from studies.explorer.design import Design
from studies.explorer.query import design_of, query_of
from studies.explorer.view import explore
from tests.browser import Visit
from tests.reports.explorer.host import hosted, sent

STEFFES = Design(N=10, M=4, L=8)


def test_its_arguments_are_those_of_a_design() -> None:
    explorer = Explorer(N=10, M=4, L=8)
    assert explorer.design == STEFFES
    assert explorer.view == explore(STEFFES)
    assert explorer.query == query_of(STEFFES)
    assert Explorer(STEFFES).design == STEFFES


def test_a_design_that_is_set_is_looked_at_and_heard_of() -> None:
    explorer, heard = Explorer(STEFFES), []
    explorer.observe(lambda change: heard.append(change["new"]), "view")
    explorer.design = replace(STEFFES, L=9)
    assert heard == [explorer.view] == [explore(replace(STEFFES, L=9))]
    assert design_of(explorer.query) == explorer.design


@settings(max_examples=20, deadline=None)
@given(st.integers(5, 10))
def test_what_the_page_asks_for_is_the_design(L: int) -> None:
    explorer = Explorer(STEFFES)
    explorer.query = f"N=10&M=4&L={L}"
    assert explorer.design == replace(STEFFES, L=L)
    assert explorer.answered == explorer.query
    assert explorer.get_state()["view"] == explore(explorer.design).document()


def test_a_query_in_other_words_is_answered_too() -> None:
    """Although its view is the one that is there."""
    explorer = Explorer(STEFFES)
    explorer.query = "L=8&M=4&N=10"
    assert explorer.answered == "L=8&M=4&N=10"
    assert explorer.view == explore(STEFFES)


def test_an_error_of_the_page_is_told_there_and_leaves_the_design() -> None:
    explorer = Explorer(STEFFES)
    explorer.query = "N=10&M=4&L=3"
    assert "give L from 5 on" in explorer.error
    assert (explorer.answered, explorer.design) == (explorer.query, STEFFES)
    explorer.query = "N=10&M=4&L=9"
    assert (explorer.error, explorer.design.L) == ("", 9)


def test_what_nobody_thought_of_is_told_and_raised() -> None:
    """Here in a function of the user's that hears of the view."""
    explorer = Explorer(STEFFES)
    explorer.observe(lambda _change: 1 / 0, "view")
    with pytest.raises(ZeroDivisionError):
        explorer.query = "N=10&M=4&L=9"
    assert explorer.error.endswith("nobody thought of: ZeroDivisionError: division by zero")
    assert explorer.answered == explorer.query


def test_an_error_of_python_is_raised() -> None:
    explorer = Explorer(STEFFES)
    with pytest.raises(InputError, match="give L from 5 on"):
        explorer.design = replace(STEFFES, L=3)
    assert (explorer.design, explorer.view) == (STEFFES, explore(STEFFES))
    with pytest.raises(InputError, match="a design and L: give one Design"):
        Explorer(STEFFES, L=3)


def test_without_the_extra_the_remedy_is_named() -> None:
    code = "import sys; sys.modules['anywidget'] = None; from reports import Explorer"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert run.stderr.splitlines()[-1].endswith('needs the package anywidget: pip install "sched-sim[notebook]"')


# -------------------------------------------------------------------------------------------------------- in a browser


def shows(page: Page, design: Design) -> None:
    """Waits until it does."""
    expect(page.locator(".ss-explorer")).to_have_attribute("data-shown", query_of(design))


def test_the_page_shows_what_python_sets(visit: Visit) -> None:
    explorer = Explorer(STEFFES)
    hosted(visit.page, explorer)
    shows(visit.page, STEFFES)
    for L in (5, 6, 7, 10):
        explorer.design = replace(STEFFES, L=L)
        sent(visit.page, explorer)
    shows(visit.page, replace(STEFFES, L=10))
    assert explorer.design == replace(STEFFES, L=10)


def test_python_knows_what_is_changed_in_the_page(visit: Visit) -> None:
    explorer = Explorer(STEFFES)
    hosted(visit.page, explorer)
    shows(visit.page, STEFFES)
    visit.page.get_by_label("Land by, slider").focus()
    visit.page.keyboard.press("ArrowRight")
    shows(visit.page, replace(STEFFES, L=9))
    assert explorer.design == replace(STEFFES, L=9)
    assert explorer.view == explore(explorer.design)


def test_what_cannot_be_is_said_in_the_cell(visit: Visit) -> None:
    explorer = Explorer(STEFFES)
    hosted(visit.page, explorer)
    shows(visit.page, STEFFES)
    box = visit.page.get_by_role("textbox", name="Land by")
    box.fill("3")
    box.press("Enter")
    expect(visit.page.locator(".ss-explorer")).to_contain_text("give L from 5 on")
    assert explorer.design == STEFFES


def test_a_cell_that_is_shown_again_has_the_design_and_what_was_refused(visit: Visit) -> None:
    explorer = Explorer(STEFFES)
    explorer.query = "N=10&M=4&L=3"
    hosted(visit.page, explorer)
    shows(visit.page, STEFFES)
    expect(visit.page.locator(".ss-explorer")).to_contain_text("give L from 5 on")


def test_a_python_that_does_not_answer_is_said_in_the_cell(visit: Visit) -> None:
    explorer = Explorer(STEFFES)
    assert "SILENT_MS = 20000" in explorer._esm
    explorer._esm = explorer._esm.replace("SILENT_MS = 20000", "SILENT_MS = 50")
    hosted(visit.page, explorer, answers=False)
    shows(visit.page, STEFFES)
    visit.page.get_by_label("Land by, slider").focus()
    visit.page.keyboard.press("ArrowRight")
    expect(visit.page.locator(".ss-explorer")).to_contain_text("Python does not answer")
    assert explorer.design == STEFFES


def test_keys_that_are_pressed_in_it_are_no_shortcuts_of_the_notebook(visit: Visit) -> None:
    hosted(visit.page, Explorer(STEFFES))
    shows(visit.page, STEFFES)
    visit.page.evaluate("document.addEventListener('keydown', (event) => event.preventDefault())")
    slider = visit.page.get_by_label("Land by, slider")
    before = slider.input_value()
    slider.press("ArrowRight")
    assert slider.input_value() != before


def test_it_ends_with_its_cell(visit: Visit) -> None:
    hosted(visit.page, Explorer(STEFFES))
    visit.page.wait_for_selector(".ss-explorer[data-shown]")
    visit.page.evaluate("window.end()")
    assert visit.page.locator(".ss-explorer").count() == 0


def test_no_rule_of_accessible_pages_is_broken(visit: Visit) -> None:
    hosted(visit.page, Explorer(STEFFES))
    visit.page.wait_for_selector(".ss-explorer[data-shown]")
    found = Axe().run(visit.page, context=".ss-explorer").response["violations"]
    assert [(rule["id"], [node["target"] for node in rule["nodes"]]) for rule in found] == []
