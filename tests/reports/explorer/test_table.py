"""A table in the browser: names, numbers, verdicts, rows to pick."""

from __future__ import annotations

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, expect

from tests.browser import Visit
from tests.reports.explorer.scripts import loaded

ROWS = [
    {"name": "rp2040", "fits": True, "load": 0.421},
    {"name": "esp32", "fits": False, "load": 1.2},
    {"name": "cortex-m4f", "fits": None, "load": None},
]
SHOW = """([rows, current, picks]) => {
  window.picked = window.picked ?? [];
  table.table(document.querySelector("#host"), {
    caption: "Parts",
    columns: [
      { key: "name", label: "part" },
      { label: "verdict", holds: (row) => row.fits, text: (row) => ["does not", "fits"][Number(row.fits)] },
      { key: "load", label: "load", numeric: true },
    ],
    rows,
    current,
    ...(picks ? { onPick: (row, index) => picked.push([row.name, index]) } : {}),
  });
}"""


def shown(visit: Visit, *, picks: bool = True) -> Page:
    loaded(visit, "table", styles=("palette.css", "plot.css"))
    visit.page.evaluate(SHOW, [ROWS, 1, picks])
    return visit.page


def test_it_has_a_caption_and_names_its_columns_and_rows(visit: Visit) -> None:
    page = shown(visit)
    expect(page.get_by_role("table", name="Parts")).to_be_visible()
    assert page.get_by_role("columnheader").all_text_contents() == ["part", "verdict", "load"]
    assert page.get_by_role("rowheader").all_text_contents() == [row["name"] for row in ROWS]
    assert page.locator("th[scope=row]").count() == len(ROWS)


def test_a_verdict_has_a_sign_and_a_word(visit: Visit) -> None:
    page = shown(visit)
    verdicts = page.locator("tbody td:nth-child(2)").all_text_contents()
    assert verdicts[:2] == ["✓ fits", "✗ does not"]
    assert verdicts[2].startswith("– ")


def test_numbers_are_aligned_and_what_is_not_known_is_a_dash(visit: Visit) -> None:
    page = shown(visit)
    loads = page.locator("tbody td:nth-child(3)")
    assert loads.all_text_contents() == ["0.421", "1.2", "–"]
    assert loads.first.evaluate("(cell) => getComputedStyle(cell).textAlign") == "right"


def test_a_row_is_picked_by_its_button_and_keeps_the_focus_when_it_is_drawn_anew(visit: Visit) -> None:
    page = shown(visit)
    page.get_by_role("button", name="cortex-m4f").focus()
    page.keyboard.press("Enter")
    assert page.evaluate("picked") == [["cortex-m4f", 2]]
    page.evaluate(SHOW, [ROWS, 2, True])
    expect(page.get_by_role("button", name="cortex-m4f")).to_be_focused()
    expect(page.get_by_role("button", name="cortex-m4f")).to_have_attribute("aria-current", "true")


def test_the_current_row_is_marked_by_more_than_its_colour(visit: Visit) -> None:
    page = shown(visit, picks=False)
    assert page.locator("[aria-current=true]").all_text_contents() == ["esp32"]
    sign = page.locator(".ss-table-now th").evaluate("(cell) => getComputedStyle(cell, '::before').content")
    assert "▸" in sign


def test_on_a_phone_keys_scroll_it_and_the_names_stay(visit: Visit) -> None:
    visit.page.set_viewport_size({"width": 220, "height": 500})
    page = shown(visit)
    region = page.get_by_role("group", name="Parts")
    assert region.evaluate("(region) => region.scrollWidth > region.clientWidth")
    assert page.evaluate("document.documentElement.scrollWidth") <= 220
    name = page.get_by_role("rowheader").first
    before = name.bounding_box()
    region.focus()
    page.keyboard.press("ArrowRight")
    page.wait_for_function("document.querySelector('.ss-table-region').scrollLeft > 0")
    after = name.bounding_box()
    assert before is not None
    assert after is not None
    assert after["x"] >= region.evaluate("(region) => region.getBoundingClientRect().x")
    page.evaluate(SHOW, [ROWS, 1, True])
    assert region.evaluate("(region) => region.scrollLeft") > 0


def test_axe_finds_no_violation(visit: Visit) -> None:
    for scheme in ("light", "dark"):
        visit.page.emulate_media(color_scheme="dark" if scheme == "dark" else "light")
        page = shown(visit)
        assert Axe().run(page).response["violations"] == []
