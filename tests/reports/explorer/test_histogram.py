"""A histogram in the browser: bars, tails, a deadline, quantiles."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import numpy as np
import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, expect

from tests.browser import Visit
from tests.reports.explorer.scripts import loaded

SHOW = """(shown) => {
  window.shownHistogram ??= histogram.histogram(document.querySelector("#host"));
  shownHistogram.show(shown);
}"""


def spread(*, log: bool = True, **others: Any) -> dict[str, Any]:
    """A thousand response times of which none is above 2 ms, and a tail that goes on."""
    values = np.random.default_rng(1).triangular(0.2, 0.5, 2.0, 1000)
    counts, edges = np.histogram(values, bins=20, range=(0, 2))
    at = np.linspace(0, 3, 31)
    return {
        "title": "predict",
        "x": {"label": "response time (ms)"},
        "y": {"label": "share of jobs", "log": log},
        "edges": edges.tolist(),
        "bars": (counts / 1000).tolist(),
        "tails": [
            {"name": "longer", "x": [0.0, *np.sort(values).tolist()], "y": (1 - np.arange(1001) / 1000).tolist()},
            {"name": "longer, exactly", "x": at.tolist(), "y": (10.0 ** (-2 * at)).tolist()},
        ],
        "points": None,
        "deadline": {"x": 2.5, "label": "deadline 2.5 ms"},
        "marks": [{"x": 0.8, "label": "median 0.8"}, {"x": 0.85, "label": "mean 0.85"}],
        "unresolved": {"y": 0.003, "label": "not resolved"},
        **others,
    }


def shown(visit: Visit, given: dict[str, Any]) -> Page:
    loaded(visit, "histogram", styles=("palette.css", "plot.css"))
    visit.page.evaluate(SHOW, given)
    visit.page.wait_for_selector(".ss-plot-grid[d]", state="attached")
    return visit.page


def data(page: Page, name: str) -> list[str]:
    found: list[str] = page.locator(f".ss-plot-picture .{name}").evaluate_all(
        "(all) => all.map((one) => one.getAttribute('d'))"
    )
    return found


def test_each_share_above_nothing_has_a_bar(visit: Visit) -> None:
    given = spread()
    (bars,) = data(shown(visit, given), "ss-histogram-bars")
    assert bars.count("M") == sum(share > 0 for share in given["bars"])


def test_tails_are_drawn_where_the_axis_is_logarithmic_the_exact_one_dashed(visit: Visit) -> None:
    page = shown(visit, spread())
    assert all(data(page, "ss-histogram-tail"))
    dashes = page.locator(".ss-plot-area .ss-histogram-tail").evaluate_all(
        "(all) => all.map((one) => getComputedStyle(one).strokeDasharray)"
    )
    assert dashes[0] == "none" != dashes[1]
    page.evaluate(SHOW, spread(log=False))
    assert not any(data(page, "ss-histogram-tail"))


@pytest.mark.parametrize(("at", "drawn"), [(2.5, True), (40.0, False)])
def test_a_deadline_is_a_line_or_where_it_is_far_off_an_arrow(visit: Visit, at: float, drawn: bool) -> None:
    page = shown(visit, spread(deadline={"x": at, "label": f"deadline {at:g} ms"}))
    (line,) = data(page, "ss-histogram-deadline")
    assert bool(line) is drawn
    name = page.locator(".ss-plot-limit-label").text_content() or ""
    assert name.endswith("→") is not drawn


def test_names_of_quantiles_are_apart_and_none_is_cut(visit: Visit) -> None:
    visit.page.set_viewport_size({"width": 360, "height": 700})
    page = shown(visit, spread())
    names = page.locator(".ss-histogram-name, .ss-plot-limit-label")
    boxes = names.evaluate_all(
        "(all) => all.map((one) => one.getBBox()).map((box) => [box.x, box.y, box.width, box.height])"
    )
    assert len(boxes) == 3
    for (x, y, width, height), (left, top, wide, high) in combinations(boxes, 2):
        assert x + width <= left or left + wide <= x or y + height <= top + 1 or top + high <= y + 1
    area = page.locator(".ss-plot-area").bounding_box()
    assert area is not None
    assert all(x >= 0 and x + width <= area["width"] for x, _, width, _ in boxes)


def test_what_is_not_resolved_is_shaded_and_named(visit: Visit) -> None:
    page = shown(visit, spread())
    assert data(page, "ss-histogram-unresolved")[0]
    expect(page.get_by_role("listitem").filter(has_text="not resolved")).to_be_visible()


def test_keys_walk_along_the_bars(visit: Visit) -> None:
    given = spread()
    page = shown(visit, given)
    walk = page.get_by_role("slider")
    walk.focus()
    for _ in range(5):
        page.keyboard.press("ArrowRight")
    expect(walk).to_have_attribute("aria-valuetext", "response time 0.5 to 0.6 ms")
    expect(page.locator(".ss-plot-said")).to_contain_text(f"share of jobs {given['bars'][5]:.3g}")


def test_bins_of_whole_numbers_are_named_by_them(visit: Visit) -> None:
    points = {"name": "exactly", "x": [44, 45, 46, 47], "y": [0.5, 0.3, 0.2, 1e-4]}
    steps = {"edges": [43.5, 44.5, 45.5, 47.5], "bars": [0.5, 0.3, 0.2], "tails": [], "points": points}
    page = shown(visit, spread(**steps, x={"label": "l (steps)"}, deadline=None, marks=[]))
    walk = page.get_by_role("slider")
    walk.focus()
    expect(walk).to_have_attribute("aria-valuetext", "l 44 steps")
    page.keyboard.press("End")
    expect(walk).to_have_attribute("aria-valuetext", "l 46 to 47 steps")
    assert data(page, "ss-histogram-point")[0].count("M") == 4


def test_no_values_make_it_fail(visit: Visit) -> None:
    nothing = {"tails": [], "deadline": None, "marks": [], "unresolved": None}
    page = shown(visit, spread(**nothing, edges=[0, 1], bars=[]))
    for log in (True, False):
        for others in ({"edges": [0, 1], "bars": [0]}, {"edges": [2, 2], "bars": [1]}, {"edges": [], "bars": []}):
            page.evaluate(SHOW, spread(**nothing, **others, log=log))
            assert "NaN" not in page.locator(".ss-plot-picture").evaluate("(picture) => picture.outerHTML")


def test_axe_finds_no_violation(visit: Visit) -> None:
    page = shown(visit, spread())
    page.get_by_text("Values as a table").click()
    expect(page.get_by_role("columnheader")).to_have_count(4)
    assert Axe().run(page).response["violations"] == []
