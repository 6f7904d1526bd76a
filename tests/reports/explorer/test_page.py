"""The page in a browser: what is changed, what it then shows, and what its address says."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.browser import Visit
from tests.reports.explorer.form import drag, field, give, slider
from tests.reports.explorer.made_view import made_view
from tests.reports.explorer.small_server import SmallServer

DESIGN = "hr_hz=400&measurement_hz=5&delay_ms=110&model=ins-gps"


@pytest.fixture
def server() -> Iterator[SmallServer]:
    with SmallServer().running() as server:
        yield server


def opened(visit: Visit, server: SmallServer, link: str = "") -> Page:
    """The page of a link, with its first picture."""
    visit.page.goto(server.url + link)
    visit.page.wait_for_selector('.ss-explorer[data-shown]:not([data-shown=""])')
    return visit.page


def shows(page: Page, text: str) -> None:
    """What the view that is drawn was asked for."""
    page.wait_for_selector(f'.ss-explorer[data-shown="{text}"]')


def test_without_a_link_it_begins_with_a_design_and_can_be_changed(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server)
    shows(page, DESIGN)
    assert [field(page, label).input_value() for label in ("Loop rate", "Measurement rate", "Delay")] == [
        "400",
        "5",
        "110",
    ]
    give(page, "Needed accuracy", "0.38")
    shows(page, f"{DESIGN}&within=0.38")
    expect(page.get_by_role("heading", name="Designs that keep 0.38 m")).to_be_visible()
    assert page.url == f"{server.url}?{DESIGN}&within=0.38"
    give(page, "Needed accuracy", "0,4")  # a comma is a point
    shows(page, f"{DESIGN}&within=0.4")


def test_the_answer_its_warnings_and_its_files_come_with_the_design(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server, f"?{DESIGN}&L=62")
    expect(page.get_by_role("status").first).to_have_text("✓dual-rate lands by step 62 of 80 with speed 0.656")
    expect(page.get_by_role("list", name="Warnings")).to_have_text("lands at 45 of the 62 you allow")
    for name, kind in [("Chart (SVG)", "schedule.svg"), ("Methods (CSV)", "methods.csv"), ("Jobs (CSV)", "jobs.csv")]:
        expect(page.get_by_role("link", name=name)).to_have_attribute("href", f"{server.url}{kind}?{DESIGN}&L=62")


def test_of_the_designs_that_do_the_least_is_named_and_of_one_that_is_picked_controls_and_address_tell(
    visit: Visit, server: SmallServer
) -> None:
    page = opened(visit, server, f"?{DESIGN}&within=0.38")
    methods = page.get_by_role("region", name="Designs that keep")
    expect(methods).to_contain_text("Needs least: dual-rate on rp2040, landing by step 66 (165 ms).")
    expect(methods.get_by_role("rowheader")).to_have_text(["dual-rate", "clone", "recalculate"])
    page.get_by_role("button", name="clone").first.click()
    taken = f"{DESIGN}&within=0.38&method=clone&L=66&processor=rp2040"
    shows(page, taken)
    assert page.url == f"{server.url}?{taken}"
    assert field(page, "Method").input_value() == "clone"
    assert field(page, "Land by").input_value() == "165"
    assert field(page, "Processor").input_value() == "rp2040"


def test_all_that_is_said_is_in_the_words_of_the_page_and_why_no_parts_are_compared_in_their_place(
    visit: Visit, server: SmallServer
) -> None:
    why = "no parts: on each the least speed takes a search"
    said = {"warnings": ["delay_ms 300 is long"], "notes": ["hr_hz 400", why], "parts": []}
    server.view = lambda query: {
        **made_view(query),
        **said,
        "answer": {"sentence": "not by land_within_ms 9", "state": ""},
    }
    page = opened(visit, server, f"?{DESIGN}")
    expect(page.get_by_role("status").first).to_have_text("not by Land by 9")
    expect(page.get_by_role("list", name="Warnings")).to_have_text("Delay 300 is long")
    expect(page.get_by_role("region", name="Parts")).to_contain_text(f"{why.capitalize()}.")
    page.get_by_text("How this was computed").click()
    expect(page.get_by_text("Loop rate 400")).to_be_visible()


def test_methods_that_cannot_be_are_no_rows_but_reasons(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server, f"?{DESIGN}&within=0.3")
    methods = page.get_by_role("region", name="Designs that keep")
    expect(methods.get_by_role("rowheader")).to_have_text(["recalculate", "dual-rate", "clone"])
    expect(methods.get_by_role("list", name="Why not").get_by_role("listitem")).to_have_text(
        ["recalculate, dual-rate, clone: 0.373 m at best", "augmentation: no memory of so many steps"]
    )


def test_dragging_is_one_step_back(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server, f"?{DESIGN}&L=62&within=0.38")
    before = page.url
    for label in ("Delay", "Land by"):
        drag(page, slider(page, label), 0.5, 0.02, 0.98, 0.4)
        expect(page).not_to_have_url(before)
        shows(page, page.url.partition("?")[2])
        expect(page.locator(".ss-stale")).to_have_count(0)
        expect(page.get_by_role("alert").filter(has_text=re.compile("."))).to_have_count(0)
        page.go_back()
        expect(page).to_have_url(before)
        shows(page, before.partition("?")[2])


def test_back_and_forward_show_each_discrete_change(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server)
    field(page, "Method").select_option("clone")
    shows(page, f"{DESIGN}&method=clone")
    expect(page.get_by_text("keeps a copy of what was measured")).to_be_visible()
    field(page, "Processor").select_option("rp2040")
    shows(page, f"{DESIGN}&method=clone&processor=rp2040")
    page.go_back()
    shows(page, f"{DESIGN}&method=clone")
    assert field(page, "Processor").input_value() == ""
    page.go_back()
    shows(page, DESIGN)
    page.go_forward()
    shows(page, f"{DESIGN}&method=clone")
    assert field(page, "Method").input_value() == "clone"


def test_what_is_refused_is_said_beside_its_field_and_the_last_picture_stays(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server, f"?{DESIGN}&L=62")
    field(page, "Land by").fill("100")
    expect(page.get_by_role("alert").filter(has_text="L=40 must be > M=44")).to_be_visible()
    expect(field(page, "Land by")).to_be_focused()
    expect(field(page, "Land by")).to_have_attribute("aria-invalid", "true")
    described = field(page, "Land by").get_attribute("aria-describedby") or ""
    assert "L=40 must be" in "".join(page.locator(f"#{name}").inner_text() for name in described.split())
    expect(page.locator(".ss-stale")).to_have_count(1)
    shows(page, f"{DESIGN}&L=62")
    page.get_by_role("button", name="Back to the last design").click()
    expect(page.locator(".ss-stale")).to_have_count(0)
    assert field(page, "Land by").input_value() == "155"
    visit.errors.remove(*(error for error in visit.errors if "422" in error))


def test_a_refusal_is_in_the_words_of_the_page_that_of_a_pinned_design_too(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server, f"?{DESIGN}#A=hr_hz%3D400%26measurement_hz%3D5%26delay_ms%3D1000")
    expect(page.get_by_text("A: Delay is longer than Measurement rate allows")).to_be_visible()
    give(page, "Delay", "1000")
    said = "Delay is longer than Measurement rate allows: see `sched-sim minimum delay_ms`"
    expect(page.get_by_role("alert").filter(has_text=said)).to_be_visible()
    refused = [error for error in visit.errors if "422" in error]
    assert len(refused) >= 2
    visit.errors[:] = [error for error in visit.errors if error not in refused]


def test_a_link_that_is_refused_says_why_and_can_be_mended(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server, "?N=10&M=12&L=8")
    expect(page.get_by_role("alert").filter(has_text="must be > M=12")).to_be_visible()
    assert field(page, "M").input_value() == "12"
    expect(page.locator(".ss-stale")).to_have_count(1)
    give(page, "M", "4")
    shows(page, "N=10&M=4&L=8")
    expect(page.locator(".ss-stale")).to_have_count(0)
    visit.errors.remove(*(error for error in visit.errors if "422" in error))


def test_a_link_that_no_control_can_mend_leaves_the_design_to_begin_with(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server, "?colour=red")
    expect(page.get_by_text("'colour' is unknown: choose from N, M, L")).to_be_visible()
    expect(page.locator(".ss-stale")).to_have_count(0)
    give(page, "Delay", "100")
    shows(page, DESIGN.replace("110", "100"))
    assert page.url == f"{server.url}?{DESIGN.replace('110', '100')}"
    visit.errors.remove(*(error for error in visit.errors if "422" in error))


def test_in_steps_and_back(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server)
    page.get_by_role("radio", name="steps").check()
    shows(page, "hr_hz=400&model=ins-gps&N=80&M=44")
    assert [field(page, label).input_value() for label in ("N", "M", "Loop rate")] == ["80", "44", "400"]
    give(page, "N", "100")
    page.get_by_role("radio", name="Hz and ms").check()
    shows(page, "hr_hz=400&model=ins-gps&measurement_hz=4&delay_ms=110")
    assert field(page, "Measurement rate").input_value() == "4"


def test_units_are_turned_of_what_was_asked_for_last(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server, "?hr_hz=400&N=80&M=44&model=ins-gps")
    server.open.clear()
    give(page, "N", "100")
    page.get_by_role("radio", name="Hz and ms").check()
    server.open.set()
    shows(page, "hr_hz=400&model=ins-gps&measurement_hz=4&delay_ms=110")


def test_a_rate_that_is_no_decimal_is_a_fraction_and_has_its_place_on_the_slider(
    visit: Visit, server: SmallServer
) -> None:
    page = opened(visit, server, "?hr_hz=400&N=70&M=44&model=ins-gps")
    page.get_by_role("radio", name="Hz and ms").check()
    shows(page, "hr_hz=400&model=ins-gps&measurement_hz=40/7&delay_ms=110")
    assert field(page, "Measurement rate").input_value() == "40/7"
    expect(slider(page, "Measurement rate")).to_have_attribute("aria-valuetext", "40/7 Hz")
    drag(page, slider(page, "Measurement rate"), 0.5, 0.51)
    assert 0.2 < float(field(page, "Measurement rate").input_value()) < 8.9


def test_what_the_command_was_started_with_in_steps_is_shown_in_steps(visit: Visit, server: SmallServer) -> None:
    server.view = lambda query: made_view(query or "N=80&M=44&hr_hz=400")
    page = opened(visit, server)
    assert [field(page, label).input_value() for label in ("N", "M", "Loop rate")] == ["80", "44", "400"]


def test_designs_are_pinned_kept_in_the_link_and_removed(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server, f"?{DESIGN}")
    page.get_by_role("button", name="Pin this design").click()
    field(page, "Method").select_option("clone")
    shows(page, f"{DESIGN}&method=clone")
    page.get_by_role("button", name="Pin this design").click()
    pinned = page.get_by_role("region", name="Pinned designs").get_by_role("table")
    expect(pinned.get_by_role("row", name="method")).to_have_text("methodclonedual-rateclone")
    expect(pinned.get_by_role("row", name="part")).to_contain_text("rp2040 would do")
    expect(pinned.get_by_role("row", name="load")).to_contain_text("80.0 % at the least speed")
    expect(page).to_have_url(re.compile("#A=.*&B="))
    link = page.url
    page.goto("about:blank")
    opened(visit, server, link.removeprefix(server.url))
    expect(pinned.get_by_role("row", name="method")).to_have_text("methodclonedual-rateclone")
    page.get_by_role("button", name="Remove design A").click()
    expect(pinned.get_by_role("row", name="method")).to_have_text("methodcloneclone")
    expect(page).to_have_url(re.compile(r"\?[^#]*#B=[^&]*$"))
    page.get_by_role("button", name="Remove design B").click()
    expect(pinned).to_have_count(0)
    expect(page).to_have_url(re.compile("^[^#]*$"))


def test_pins_are_marked_in_the_plots(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server, f"?{DESIGN}#A=N%3D80%26M%3D44%26L%3D50%26hr_hz%3D400")
    plot = page.get_by_role("img", name=re.compile("Land later"))
    expect(plot).to_have_attribute("aria-label", re.compile("A: L 50, "))


def test_a_point_of_a_curve_is_taken(visit: Visit, server: SmallServer) -> None:
    """By the keys: the first point and one more; with power L falls."""
    page = opened(visit, server, f"?{DESIGN}&method=clone")
    for plot, landing in (("Land later", 46), ("What landing later", 46), ("What a faster processor buys", 79)):
        page.get_by_role("slider", name=re.compile(plot)).focus()
        for key in ("Home", "ArrowRight", "Enter"):
            page.keyboard.press(key)
        shows(page, f"{DESIGN}&method=clone&L={landing}")
        page.go_back()
        shows(page, f"{DESIGN}&method=clone")


def test_what_takes_long_says_so_and_can_be_stopped(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server)
    server.open.clear()
    field(page, "Method").select_option("clone")
    expect(page.get_by_text("Still computing")).to_be_visible()
    page.get_by_role("button", name="Stop").click()
    expect(page.get_by_text("Stopped. Shown is the design before.")).to_be_visible()
    expect(page.locator(".ss-stale")).to_have_count(1)
    server.open.set()
    page.get_by_role("button", name="Back to the last design").click()
    expect(page.locator(".ss-stale")).to_have_count(0)
    assert field(page, "Method").input_value() == "dual-rate"
    field(page, "Processor").select_option("rp2040")
    shows(page, f"{DESIGN}&processor=rp2040")
    expect(page.locator(".ss-stale")).to_have_count(0)


def test_what_is_no_view_is_told(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server)
    server.view = lambda query: {"odd": query}
    field(page, "Method").select_option("clone")
    expect(page.get_by_text("failed to answer (HTTP 200)").first).to_be_visible()
    shows(page, DESIGN)


def test_the_link_is_copied_or_selected(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server)
    page.evaluate("() => { navigator.clipboard.writeText = async (text) => { window.copied = text; }; }")
    page.get_by_role("button", name="Copy the link").click()
    expect(page.get_by_text("Copied.")).to_be_visible()
    assert page.evaluate("window.copied") == f"{server.url}?{DESIGN}"
    page.evaluate("() => { navigator.clipboard.writeText = () => Promise.reject(new Error()); }")
    page.get_by_role("button", name="Copy the command").click()
    expect(page.get_by_text("Selected")).to_be_visible()
    assert page.evaluate("getSelection().toString() || document.activeElement.value") == "sched-sim minimum -N 80 -M 44"


NARROW = {"width": 360, "height": 740}


def test_on_a_phone_the_answer_stays_in_sight_and_nothing_is_wider(visit: Visit, server: SmallServer) -> None:
    visit.page.set_viewport_size(NARROW)  # type: ignore[arg-type]
    page = opened(visit, server)
    for name in ("Land by", "Link"):
        field(page, name).scroll_into_view_if_needed()
        expect(page.get_by_role("status").first).to_be_in_viewport(ratio=1)
    assert page.evaluate("document.documentElement.scrollWidth") <= NARROW["width"]


def test_on_paper_nothing_that_says_the_design_is_cut_off(visit: Visit, server: SmallServer) -> None:
    """As wide as A4 between its margins."""
    visit.page.set_viewport_size({"width": 680, "height": 1000})
    page = opened(visit, server, f"?{DESIGN}&within=0.38#A={DESIGN.replace('&', '%26').replace('=', '%3D')}")
    page.emulate_media(media="print")
    for name in ("Link", "Command", "Python"):
        assert field(page, name).evaluate("one => one.scrollWidth <= one.clientWidth"), name
        assert field(page, name).evaluate("one => one.scrollHeight <= one.clientHeight"), name
    assert page.evaluate("document.documentElement.scrollWidth") <= 680


def test_a_form_in_a_narrow_place_is_above_what_it_shows(visit: Visit, server: SmallServer) -> None:
    """It looks at its own width, not at the window's: a notebook's cell is narrow in a wide window."""
    page = opened(visit, server)

    def sides() -> tuple[Any, Any]:
        return page.get_by_role("form", name="Design").bounding_box(), page.locator(".ss-results").bounding_box()

    form, results = sides()
    assert form["x"] + form["width"] <= results["x"]
    page.evaluate("document.querySelector('main').style.width = '500px'")
    form, results = sides()
    assert form["y"] + form["height"] <= results["y"]


def test_by_keyboard_alone_a_method_is_shown(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server)
    page.keyboard.press("Tab")
    expect(page.get_by_role("button", name="Skip to the designs")).to_be_focused()
    page.keyboard.press("Enter")
    for _ in range(9):
        page.keyboard.press("Tab")
        if page.evaluate("document.activeElement.textContent") == "clone":
            break
    page.keyboard.press("Enter")
    shows(page, f"{DESIGN}&method=clone")
    assert page.evaluate("document.activeElement.textContent") == "clone"


def test_two_on_one_page_share_no_id(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server)
    page.evaluate("""async () => {
      const more = document.createElement("div");
      more.dataset.explorer = "";
      document.querySelector("main").before(more);
      await import("/explorer.js?again");
    }""")
    expect(page.locator(".ss-explorer[data-shown]")).to_have_count(2)
    ids = page.evaluate("[...document.querySelectorAll('[id]')].map(({id}) => id)")
    assert len(ids) == len(set(ids))


def test_the_answer_is_read_out_when_it_stands_still(visit: Visit, server: SmallServer) -> None:
    page = opened(visit, server)
    answer = page.get_by_role("status").first
    expect(answer).not_to_have_attribute("aria-busy", "true")
    page.evaluate("""() => {
      window.busy = [];
      const answer = document.querySelector("[role=status]");
      const heard = new MutationObserver(() => busy.push(answer.getAttribute("aria-busy")));
      heard.observe(answer, {subtree: true, characterData: true, childList: true});
    }""")
    drag(page, slider(page, "Land by"), 0.9, 0.3, 0.6)
    expect(page.locator(".ss-explorer")).to_have_attribute("data-shown", re.compile("L="))
    expect(answer).not_to_have_attribute("aria-busy", "true")
    said = page.evaluate("window.busy")
    assert said
    assert set(said) == {"true"}
