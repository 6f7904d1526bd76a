"""A plot of lines in the browser: what it draws, hides, tells and gives back."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Locator, Page, expect

from tests.browser import Visit
from tests.reports.explorer.plots import Shown, accuracy_shown, landings_shown, stairs_shown
from tests.reports.explorer.scripts import loaded

STYLES = ("palette.css", "plot.css")
SHOW = """([shown, picks]) => {
  const host = document.querySelector("#host");
  window.picked = [];
  window.shownPlot = plot.plot(host, picks ? { onPick: (x, line) => picked.push([x, line.name]) } : {});
  shownPlot.show(shown);
}"""

MADE = """(shown) => {
  const times = 1234567.2 / shown.lines[0].y[0];
  const text = (speed) => amounts.powerText(times * speed, { short: "speed" });
  shownPlot.show({ ...shown, y: { ...shown.y, text } });
}"""
AT_FULL_WIDTH = """() => {
  const [, , width] = document.querySelector(".ss-plot-picture").getAttribute("viewBox").split(" ");
  return Number(width) === document.querySelector(".ss-plot-area").getBoundingClientRect().width;
}"""


def drawn(visit: Visit, shown: Shown, *, picks: bool = True) -> Page:
    loaded(visit, "plot", "amounts", styles=STYLES)
    visit.page.evaluate(SHOW, [shown, picks])
    visit.page.wait_for_selector(".ss-plot-grid[d]", state="attached")
    return visit.page


def shows(page: Page, shown: Shown) -> None:
    page.evaluate("(shown) => shownPlot.show(shown)", shown)


def paths(page: Page) -> list[str]:
    found: list[str] = page.locator(".ss-plot-area .ss-plot-line").evaluate_all(
        "(all) => all.map((one) => one.getAttribute('d'))"
    )
    return found


def boxes(texts: Locator) -> list[dict[str, Any]]:
    return [box for text in texts.all() if (box := text.bounding_box()) is not None and box["width"] > 0]


def overlap(one: dict[str, Any], other: dict[str, Any]) -> bool:
    across = one["x"] < other["x"] + other["width"] and other["x"] < one["x"] + one["width"]
    return bool(across and one["y"] + 2 < other["y"] + other["height"] and other["y"] + 2 < one["y"] + one["height"])


def test_each_method_has_a_line_and_a_button_that_hides_it(visit: Visit) -> None:
    page = drawn(visit, stairs_shown())
    assert len(paths(page)) == 3
    numbers = page.locator(".ss-plot-number").nth(1).text_content()
    button = page.get_by_role("button", name="recalculate")
    expect(button).to_have_attribute("aria-pressed", "true")
    button.click()
    expect(button).to_have_attribute("aria-pressed", "false")
    expect(button).to_be_focused()
    assert len(paths(page)) == 2
    assert page.locator(".ss-plot-number").nth(1).text_content() != numbers
    shows(page, stairs_shown())
    assert len(paths(page)) == 2
    button.click()
    assert len(paths(page)) == 3


def test_a_pointer_is_told_what_every_line_says_there(visit: Visit) -> None:
    shown = stairs_shown()
    page = drawn(visit, shown)
    box = page.locator(".ss-plot-ring").bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    tip = page.locator(".ss-plot-tip")
    expect(tip).to_be_visible()
    dual_rate = shown["lines"][0]
    least = dual_rate["y"][dual_rate["x"].index(8)]
    expect(tip).to_contain_text("L 8 steps")
    expect(tip).to_contain_text(f"dual-rate{least:.5g}")
    page.mouse.move(1, 1)
    expect(tip).to_be_hidden()


def test_what_the_pointer_is_told_is_what_the_table_has(visit: Visit) -> None:
    """Digit by digit, and a need is rounded up."""
    page = drawn(visit, stairs_shown())
    page.evaluate(MADE, stairs_shown() | {"points": []})
    page.get_by_text("Values as a table").click()
    walk, told = page.get_by_role("slider"), page.locator(".ss-plot-row")
    walk.focus()
    page.keyboard.press("Home")
    expect(walk).to_have_attribute("aria-valuetext", "L 5 steps")
    row = page.get_by_role("row").filter(has=page.get_by_role("rowheader", name="5", exact=True))
    names, values = told.locator("span:not(.ss-plot-value)"), told.locator(".ss-plot-value")
    in_tip = dict(zip(names.all_inner_texts(), values.all_inner_texts(), strict=True))
    heads = page.get_by_role("columnheader").all_inner_texts()[1:]
    cells = dict(zip(heads, row.get_by_role("cell").all_inner_texts(), strict=True))
    assert in_tip == {name: text for name, text in cells.items() if text != "–"}
    assert in_tip["dual-rate"] == "1,234,568"


def test_a_click_on_the_staircase_gives_its_l(visit: Visit) -> None:
    page = drawn(visit, stairs_shown())
    box = page.locator(".ss-plot-pin").bounding_box()
    assert box is not None
    page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    assert page.evaluate("picked") == [[12, "dual-rate"]]


def test_keys_walk_along_the_current_line_and_enter_picks(visit: Visit) -> None:
    page = drawn(visit, stairs_shown())
    walk = page.get_by_role("slider")
    walk.focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    expect(walk).to_have_attribute("aria-valuetext", "L 10 steps")
    said = page.locator(".ss-plot-said")
    expect(said).to_contain_text("least speed: dual-rate")
    page.keyboard.press("Enter")
    page.keyboard.press("End")
    page.keyboard.press("Enter")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Enter")
    picked = page.evaluate("picked")
    assert picked[:2] == [[10, "dual-rate"], [20, "dual-rate"]]
    assert picked[2][1] == "larsen"
    page.keyboard.press("Escape")
    expect(page.locator(".ss-plot-tip")).to_be_hidden()


def test_what_is_read_stays_while_new_pictures_come_and_nothing_is_said_aloud(visit: Visit) -> None:
    page = drawn(visit, stairs_shown())
    page.get_by_role("slider").focus()
    page.keyboard.press("ArrowRight")
    said = page.locator(".ss-plot-said").text_content()
    later = stairs_shown()
    later["lines"][0]["y"] = [2 * value for value in later["lines"][0]["y"]]
    shows(page, later)
    expect(page.locator(".ss-plot-tip")).to_contain_text("L 9 steps")
    assert page.locator(".ss-plot-said").text_content() == said


def test_there_is_a_gap_where_nothing_lands(visit: Visit) -> None:
    shown = landings_shown()
    assert shown["lines"][0]["y"][0] is None
    page = drawn(visit, shown)
    (path,) = paths(page)
    assert path.count("M") == 1
    first = next(index for index, landed in enumerate(shown["lines"][0]["y"]) if landed is not None)
    shown["lines"][0]["y"][first + 3] = None
    shows(page, shown)
    (path,) = paths(page)
    assert path.count("M") == 2


def test_a_step_line_is_read_between_its_points_too(visit: Visit) -> None:
    page = drawn(visit, landings_shown())
    box = page.locator(".ss-plot-area").bounding_box()
    assert box is not None
    page.mouse.click(box["x"] + 0.9 * box["width"], box["y"] + box["height"] - 40)
    ((x, _),) = page.evaluate("picked")
    assert x not in landings_shown()["lines"][0]["x"]
    assert 1 < x < 2


@pytest.mark.parametrize(("limit", "beyond"), [(0.4, True), (0.01, True), (5.0, False)])
def test_what_lies_beyond_a_limit_is_shaded(visit: Visit, limit: float, beyond: bool) -> None:
    page = drawn(visit, accuracy_shown(limit))
    label = page.locator(".ss-plot-limit-label")
    expect(label).to_contain_text(f"within {limit:g} m")
    assert bool(page.locator(".ss-plot-beyond").get_attribute("d")) is beyond
    within = page.locator(".ss-plot-limit").get_attribute("d") != ""
    assert within is (limit == 0.4)
    assert (label.text_content() or "")[0] in ("w" if within else "↑↓")


@pytest.mark.parametrize(
    "shown", [stairs_shown(), landings_shown(), accuracy_shown(0.4)], ids=["least speed", "landing", "accuracy"]
)
def test_no_text_is_cut_or_lies_on_another(visit: Visit, shown: Shown) -> None:
    page = drawn(visit, shown)
    for width in (320, 360, 700, 1200):
        page.set_viewport_size({"width": width, "height": 700})
        page.wait_for_function(AT_FULL_WIDTH)
        texts = boxes(page.locator(".ss-plot-area text"))
        assert texts
        assert not any(overlap(one, other) for one, other in combinations(texts, 2))
        assert all(box["x"] >= 0 and box["x"] + box["width"] <= width for box in texts)
        assert page.evaluate("document.documentElement.scrollWidth") <= width


STRANGE: dict[str, list[dict[str, Any]]] = {
    "no line": [],
    "an empty line": [{"x": [], "y": []}],
    "one point": [{"x": [4], "y": [0.5]}],
    "nothing but nulls": [{"x": [1, 2, 3], "y": [None, None, None]}],
    "the same value": [{"x": [1, 2, 3], "y": [7, 7, 7]}],
    "zero and less": [{"x": [0, 1, 2], "y": [0, -1, 5]}],
    "all zero": [{"x": [0, 0.5], "y": [0, 0]}],
    "huge and tiny": [{"x": [1e-12, 1, 1e12], "y": [1e-300, 1, 1e300]}],
}


@pytest.mark.parametrize("log", [False, True], ids=["linear", "logarithmic"])
def test_no_values_make_it_fail(visit: Visit, log: bool) -> None:
    page = drawn(visit, stairs_shown())
    for name, given in STRANGE.items():
        lines = [{"name": name, "step": True, "current": True, **line} for line in given]
        axis = {"label": name, "log": log}
        shows(
            page,
            {"title": name, "x": axis, "y": axis, "lines": lines, "points": [], "limit": {"y": 1, "label": "at 1"}},
        )
        page.get_by_role("slider").focus()
        for key in ("ArrowRight", "ArrowDown", "Enter"):
            page.keyboard.press(key)
        picture = page.locator(".ss-plot-picture").evaluate("(picture) => picture.outerHTML")
        assert "NaN" not in picture
        assert "Infinity" not in picture
        assert "undefined" not in picture
        page.locator(".ss-plot-walk").evaluate("(walk) => walk.blur()")


def test_ten_lines_of_a_thousand_points_take_the_elements_that_are_there(visit: Visit) -> None:
    x = list(range(1, 1501))
    names = ["dual-rate", "larsen", "recalculate", "clone", "standard", "a", "b", "c", "d", "e"]
    shown = stairs_shown() | {"points": []}
    shown["lines"] = [
        {"name": name, "x": x, "y": [number + 100 / at for at in x], "step": True, "current": number == 1}
        for number, name in enumerate(names)
    ]
    page = drawn(visit, shown)
    page.evaluate("() => { window.kept = [...document.querySelectorAll('.ss-plot-area path, .ss-plot-entry')]; }")
    for line in shown["lines"]:
        line["y"] = [2 * value for value in line["y"]]
    shows(page, shown)
    assert page.evaluate("kept.every((element) => element.isConnected)")
    assert max(len(path) for path in paths(page)) < 40_000


def test_its_values_are_a_table_too(visit: Visit) -> None:
    shown = stairs_shown()
    page = drawn(visit, shown)
    assert page.locator("table").count() == 0
    page.get_by_text("Values as a table").click()
    table = page.get_by_role("table")
    expect(table).to_be_visible()
    heads = table.get_by_role("columnheader").all_text_contents()
    assert heads == ["L (steps)", "dual-rate", "larsen", "recalculate"]
    row = table.get_by_role("row").filter(has=page.get_by_role("rowheader", name="8", exact=True))
    dual_rate = shown["lines"][0]
    expect(row.get_by_role("cell").first).to_have_text(f"{dual_rate['y'][dual_rate['x'].index(8)]:.5g}")
    expect(page.locator("[aria-current=true]")).to_have_text("8")
    shows(page, shown | {"title": "Another title"})
    expect(table).to_contain_text("Another title")


def test_a_long_table_has_at_most_some_sixty_rows_and_that_of_the_design(visit: Visit) -> None:
    loaded(visit, "values")
    line = {"name": "a", "x": list(range(1, 2001)), "y": [float(at * at) for at in range(1, 2001)], "step": True}
    shown = stairs_shown() | {"lines": [line], "points": [{"x": 777, "y": 1, "label": "", "current": True}]}
    rows, current, caption = visit.page.evaluate(
        "(shown) => { const { rows, current, caption } = values.valuesOf(shown); return [rows, current, caption]; }",
        shown,
    )
    assert len(rows) <= 63
    assert rows[current][0] == 777
    assert (rows[0][0], rows[-1][0]) == (1, 2000)
    assert f"{len(rows)} of 2,000 rows" in caption


def test_a_picture_says_in_words_where_the_designs_are(visit: Visit) -> None:
    shown = stairs_shown()
    page = drawn(visit, shown)
    said = page.get_by_role("img").get_attribute("aria-label") or ""
    assert "this design: L 8 steps, least speed" in said
    assert "A: L 12 steps" in said


def test_destroyed_it_leaves_nothing(visit: Visit) -> None:
    page = drawn(visit, stairs_shown())
    page.evaluate("shownPlot.destroy()")
    assert page.locator("#host > *").count() == 0


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_no_violation(visit: Visit, scheme: str) -> None:
    visit.page.emulate_media(color_scheme="dark" if scheme == "dark" else "light")
    page = drawn(visit, accuracy_shown(0.4))
    page.get_by_text("Values as a table").click()
    page.get_by_role("slider").focus()
    page.keyboard.press("ArrowRight")
    found = Axe().run(page)
    assert found.response["violations"] == []
