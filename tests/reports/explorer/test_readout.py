"""The curves of a printed figure tell their values: under the pointer, and by the keyboard."""

from __future__ import annotations

import json

import pytest
from matplotlib.figure import Figure
from playwright.sync_api import Locator

from reports.drawing.readout import readout
from reports.explorer.module import asset, module
from tests.browser import Visit


def figure() -> Figure:
    axes = (drawn := Figure(figsize=(6, 4))).add_subplot()
    axes.set_title("$N = 10$", loc="left")
    axes.set(xlabel="$L$ (steps)", ylabel="speed", yscale="log", xlim=(0, 10), ylim=(1, 100))
    axes.plot([2, 4, 8], [2, 10, 50], "o-", color="#11538c", label="Dual-rate")
    axes.axhline(20, color="#b8700a", label="Larsen")
    return drawn


@pytest.fixture
def plot(visit: Visit) -> Locator:
    """The only plot of the figure, over a picture of 600 by 400 pixels."""
    page = visit.page
    page.set_content(
        "<!doctype html><title>figure</title><div style='position: relative; width: 600px; height: 400px'>"
    )
    page.add_style_tag(content=asset("report.css"))
    script = module("readout") + f";readout(document.querySelector('div'), {json.dumps(readout(figure()))});"
    page.add_script_tag(content=script, type="module")
    return page.locator(".ss-readout")


def point_at(visit: Visit, plot: Locator, across: float, up: float) -> None:
    box = plot.bounding_box()
    assert box is not None
    visit.page.mouse.move(box["x"] + across * box["width"], box["y"] + (1 - up) * box["height"])


def keys(visit: Visit) -> list[Locator]:
    return visit.page.locator(".ss-told-key").all()


def test_it_lies_over_the_plot(plot: Locator) -> None:
    box, axes = plot.bounding_box(), figure().axes[0].get_position()
    assert box is not None
    assert (box["width"], box["height"]) == pytest.approx((600 * axes.width, 400 * axes.height), abs=0.5)


def test_under_the_pointer_the_nearest_values_are_told_where_they_are(visit: Visit, plot: Locator) -> None:
    point_at(visit, plot, 0.41, 0.5)
    assert visit.page.locator(".ss-told").inner_text().split("\n") == [
        "L (steps): 4",
        "speed",
        "Dual-rate",
        "10",
        "Larsen",
        "20",
    ]
    lengths = [[len(path.get_attribute("d") or "") > 12 for path in key.locator("path").all()] for key in keys(visit)]
    assert lengths == [[False, True], [False]], "the line, and the marker where there is one"
    ring = visit.page.locator("circle").first
    assert (ring.get_attribute("cx"), ring.get_attribute("cy")) == ("40.00%", "50.00%")
    point_at(visit, plot, 0.41, -0.5)
    assert visit.page.locator(".ss-told").is_hidden()


def test_arrow_keys_go_from_value_to_value_and_a_screen_reader_hears_them(visit: Visit, plot: Locator) -> None:
    plot.focus()
    assert plot.get_attribute("aria-label") == "N = 10: values of the curves along L (steps)"
    told = []
    for key in ("ArrowRight", "ArrowRight", "End", "ArrowLeft", "Home", "ArrowLeft"):
        visit.page.keyboard.press(key)
        told.append(str(plot.get_attribute("aria-valuetext")).split(";")[0])
    assert told == [f"L (steps): {L}" for L in (2, 4, 8, 4, 2, 2)]
    visit.page.keyboard.press("Escape")
    assert visit.page.locator(".ss-told").is_hidden()


def test_the_tip_stays_on_the_picture(visit: Visit, plot: Locator) -> None:
    for across, up in ((0.2, 0.02), (0.8, 0.98)):
        point_at(visit, plot, across, up)
        tip = visit.page.locator(".ss-told").bounding_box()
        assert tip is not None
        assert 0 <= tip["x"] - 8 <= 600 - tip["width"]
        assert -0.5 <= tip["y"] - 8 <= 400.5 - tip["height"]
