"""The whole explorer in a browser: from a control to what is drawn, and from a link back to the controls."""

from __future__ import annotations

import csv
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
from playwright.sync_api import expect

from tests.browser import Visit
from tests.reports.explorer.explored import Explorer, opened, shown
from tests.reports.explorer.form import drag, field, give, slider, unfold

FLIGHT = "hr_hz=400&measurement_hz=5&delay_ms=110&model=ins-gps&within=0.4"


def test_who_knows_rates_delay_and_need_finds_method_part_and_landing(visit: Visit, explorer: Explorer) -> None:
    """From an explorer that was started without a word."""
    page = opened(visit, explorer, "")
    for label, text in [("Loop rate", "400"), ("Measurement rate", "5"), ("Delay", "110"), ("Needed accuracy", "0.4")]:
        give(page, label, text)
    view = shown(page, explorer)
    kept = page.get_by_role("region", name="Designs that keep 0.4 m")
    best = next(row["within"] for row in view["methods"] if row["within"] and row["within"]["part"])
    expect(kept).to_contain_text(best["part"])
    expect(page.get_by_role("status").first).to_contain_text(view["answer"]["sentence"])


@pytest.mark.exhaust
def test_all_sliders_can_be_dragged_from_end_to_end_without_a_refusal(visit: Visit, explorer: Explorer) -> None:
    """One after the other, each from where the one before has led."""
    page = opened(visit, explorer, FLIGHT)
    unfold(page)
    sliders = page.locator("form input[type=range]:visible")
    assert sliders.count() >= 7
    for number in range(sliders.count()):
        before = page.url
        drag(page, sliders.nth(number), 0.5, 0.02, 0.98, 0.3)
        expect(page).not_to_have_url(before)
        shown(page, explorer)
        expect(page.get_by_role("alert").filter(has_text=re.compile("."))).to_have_count(0)


@pytest.mark.exhaust
def test_each_choice_can_be_made_and_taken_back(visit: Visit, explorer: Explorer) -> None:
    page = opened(visit, explorer, FLIGHT)
    first = shown(page, explorer)["query"]
    unfold(page)
    labels = page.locator("select:visible").evaluate_all("all => all.map(one => one.labels[0].textContent)")
    assert len(labels) >= 8
    for label in labels:
        other = field(page, label).evaluate("select => [...select.options].findLast(one => !one.selected).value")
        field(page, label).select_option(other)
        assert other in [*shown(page, explorer)["design"].values(), "", "2"], label
        page.go_back()
        assert shown(page, explorer)["query"] == first, label


def test_a_link_says_the_design_and_its_controls(visit: Visit, explorer: Explorer) -> None:
    page = opened(visit, explorer, FLIGHT)
    field(page, "Processor").select_option("cortex-m4f")
    give(page, "Delay", "90")
    unfold(page)
    field(page, "Low-rate noise").select_option("euler")
    view = shown(page, explorer)
    values = page.locator("input:visible, select:visible").evaluate_all("all => all.map(one => one.value)")
    link = page.url
    page.goto("about:blank")
    page.goto(link)
    assert shown(page, explorer)["query"] == view["query"]
    unfold(page)
    assert page.locator("input:visible, select:visible").evaluate_all("all => all.map(one => one.value)") == values


@pytest.mark.parametrize(
    ("query", "why"),
    [
        ("model=/etc/passwd&N=10&M=4", "model '/etc/passwd' is unknown"),
        ("N=10&M=12&L=3", "L=3 is less than M=12"),
    ],
)
def test_a_link_that_cannot_be_says_so_at_its_control_and_leads_back(
    visit: Visit, explorer: Explorer, query: str, why: str
) -> None:
    page = opened(visit, explorer, query)
    expect(page.get_by_role("alert").filter(has_text=why)).to_be_visible()
    page.get_by_role("button", name="Back to the last design").click()
    shown(page, explorer)
    assert "status of 422" in visit.errors.pop()  # the browser's own word for it


def test_a_link_that_no_control_can_mend_is_told_and_any_change_goes_on(visit: Visit, explorer: Explorer) -> None:
    page = opened(visit, explorer, "colour=red")
    expect(page.get_by_text("'colour' is unknown")).to_be_visible()
    field(page, "Method").select_option("larsen")
    assert shown(page, explorer)["design"]["method"] == "larsen"
    assert "status of 422" in visit.errors.pop()


def test_what_is_shown_can_be_saved(visit: Visit, explorer: Explorer, tmp_path: Path) -> None:
    page = opened(visit, explorer, FLIGHT)
    names = ["Chart (SVG)", "Methods (CSV)", "Parts (CSV)", "Jobs (CSV)"]
    for name, file in zip(names, ("schedule.svg", "methods.csv", "parts.csv", "jobs.csv"), strict=True):
        with page.expect_download() as saving:
            page.get_by_role("link", name=name).click()
        assert saving.value.suggested_filename == file
        saving.value.save_as(tmp_path / file)
        text = (tmp_path / file).read_text(encoding="utf-8")
        if file.endswith(".svg"):
            ElementTree.fromstring(text)
        else:
            assert len(list(csv.DictReader(text.splitlines()))) > 1


def test_the_keyboard_alone_reaches_all_and_changes_it(visit: Visit, explorer: Explorer) -> None:
    page = opened(visit, explorer, FLIGHT)
    wanted = slider(page, "Delay")
    for _ in range(40):
        page.keyboard.press("Tab")
        if wanted.evaluate("one => one === document.activeElement"):
            break
    expect(wanted).to_be_focused()
    page.keyboard.press("ArrowLeft")
    assert shown(page, explorer)["design"]["delay_ms"] == "109"
    assert field(page, "Delay").input_value() == "109"
    expect(wanted).to_have_attribute("aria-valuetext", "109 ms")
    expect(wanted).to_be_focused()
