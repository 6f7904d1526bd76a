"""The Gantt chart under a mouse, a finger and keys."""

from __future__ import annotations

import pytest

from sched_sim.design.timing import Timing
from tests.browser import Visit
from tests.reports.explorer.drawn import Chart, late, schedule

TALL = "body { padding: 300px 0 3000px; }"


def middle(chart: Chart) -> tuple[float, float]:
    box = chart.page.locator(".ss-gantt-frame canvas").bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2, box["y"] + 64


def stretch(chart: Chart) -> tuple[float, float]:
    """The first step and the end of those that are shown."""
    words = chart.range.split()
    return (0.0, float(words[0])) if words[1] == "steps" else (float(words[1]), float(words[3]))


def test_what_is_hovered_tells_of_itself(visit: Visit) -> None:
    chart = Chart(visit, late())
    x, y = middle(chart)
    chart.page.mouse.move(x, y)
    tip = chart.text("tip")
    assert "high-rate job of step 4" in tip or "high-rate job of step 5" in tip
    assert "high-rate propagate" in tip
    chart.page.mouse.move(x, 5)
    assert not chart.page.locator(".ss-gantt-tip").is_visible()


def test_escape_takes_away_what_is_hovered(visit: Visit) -> None:
    chart = Chart(visit, late())
    chart.page.mouse.move(*middle(chart))
    assert chart.page.locator(".ss-gantt-tip").is_visible()
    chart.page.keyboard.press("Escape")
    assert not chart.page.locator(".ss-gantt-tip").is_visible()


def test_a_pointer_that_is_faster_than_the_next_picture_does_no_harm(visit: Visit) -> None:
    chart = Chart(visit, late())
    x, y = middle(chart)
    chart.page.evaluate(
        """([shown, x, y]) => {
          const canvas = document.querySelector("canvas");
          chart.show(shown);
          for (const type of ["pointermove", "pointerdown", "pointerup"]) {
            for (const down of [0, 60]) {
              canvas.dispatchEvent(new PointerEvent(type, { clientX: x + 300, clientY: y + down, bubbles: true }));
            }
          }
          document.querySelector("[aria-label='next job']").click();
        }""",
        [schedule("larsen", Timing(10, 4, 4), "2"), x, y],
    )
    chart.settle()
    assert "high-rate job of step 0" in chart.text("tip")


def test_what_it_tells_stays_in_the_window(visit: Visit) -> None:
    chart = Chart(visit, schedule(), around="body { padding-top: 480px; }")
    x, row = middle(chart)
    chart.page.mouse.move(x + 20, row)
    tip = chart.page.locator(".ss-gantt-tip").bounding_box()
    assert tip is not None
    assert tip["y"] > 0
    assert tip["y"] + tip["height"] < row < 700


def test_arrow_keys_walk_the_jobs_and_each_is_said(visit: Visit) -> None:
    chart = Chart(visit, late())
    chart.press("ArrowRight")
    assert "high-rate job of step 0" in chart.text("tip")
    chart.press("ArrowRight", "ArrowRight")
    assert "high-rate job of step 2" in chart.text("tip")
    assert "high-rate job of step 2, row HR: meets its deadline" in chart.text("live")
    chart.press("ArrowDown", "End")
    assert "low-rate update of step 0" in chart.text("tip")
    assert "✗ misses its deadline: it never finishes" in chart.text("tip")
    chart.press("Home", "ArrowUp")
    assert "high-rate job of step 1" in chart.text("tip")
    chart.press("Escape")
    assert not chart.page.locator(".ss-gantt-tip").is_visible()


def test_what_is_below_stays_where_it_is_when_the_keys_come_and_go(visit: Visit) -> None:
    """So that a click there is not lost."""
    chart = Chart(visit, schedule())
    legend, keys = (chart.page.locator(f".ss-gantt-{name}") for name in ("legend", "keys"))
    before = legend.bounding_box()
    chart.press("ArrowRight")
    assert keys.is_visible()
    assert legend.bounding_box() == before
    chart.page.evaluate("document.activeElement.blur()")
    assert not keys.is_visible()
    assert legend.bounding_box() == before


def test_a_job_tells_its_times_in_steps_and_in_milliseconds(visit: Visit) -> None:
    chart = Chart(visit, schedule())
    chart.press("ArrowRight", "ArrowDown", "End")
    lines = dict(line.split("\t", 1) for line in chart.text("tip").splitlines() if "\t" in line)
    assert lines["release"] == "4\t10"
    assert lines["deadline"] == "8\t20"
    assert lines["finish"] == "8\t20"
    assert lines["response time"] == "4\t10"
    assert lines["preempted"] == "3 times"
    assert "with nothing to spare" in chart.text("tip")


def test_without_a_rate_there_are_no_milliseconds(visit: Visit) -> None:
    chart = Chart(visit, schedule(period_ms=None))
    chart.press("ArrowRight")
    assert "ms" not in chart.text("tip").split()


def test_keys_and_buttons_zoom_and_move(visit: Visit) -> None:
    chart = Chart(visit, schedule(timing=Timing(80, 44, 80)))
    chart.press("+", "+")
    first, end = stretch(chart)
    assert end - first == pytest.approx(80 / 1.5**2, rel=1e-2)
    chart.press("Shift+ArrowRight")
    assert stretch(chart)[0] > first
    chart.press("-")
    chart.press("0")
    assert chart.range == "80 steps"
    chart.click("zoom in")
    assert stretch(chart) == (20, 60)
    chart.click("zoom out")
    assert chart.range == "80 steps"
    chart.click("zoom in")
    chart.click("show all steps")
    assert chart.range == "80 steps"


def test_buttons_alone_reach_every_job_and_every_miss(visit: Visit) -> None:
    chart = Chart(visit, late())
    chart.click("next job")
    chart.click("next job")
    assert "of step 1" in chart.text("tip")
    chart.click("previous job")
    assert "of step 0" in chart.text("tip")
    chart.click("next missed deadline")
    assert "misses its deadline" in chart.text("tip")


def test_the_stretch_moves_to_the_job_that_is_walked_to(visit: Visit) -> None:
    chart = Chart(visit, schedule(timing=Timing(80, 44, 80)))
    chart.press("ArrowRight", "+", "+", "+", "+", "+", "+", "End")
    first, end = stretch(chart)
    assert first < 79 < end
    assert "of step 79" in chart.text("tip")


def test_a_wheel_scrolls_the_page_and_zooms_with_ctrl(visit: Visit) -> None:
    chart = Chart(visit, schedule(timing=Timing(80, 44, 80)), around=TALL)
    x, y = middle(chart)
    chart.page.mouse.move(x, y)
    chart.page.mouse.wheel(0, 120)
    chart.page.wait_for_function("scrollY > 0")
    assert chart.range == "80 steps"
    chart.page.keyboard.down("Control")
    chart.page.mouse.wheel(0, -100)
    chart.page.keyboard.up("Control")
    chart.page.wait_for_function("document.querySelector('.ss-gantt-range').textContent !== '80 steps'")
    first, end = stretch(chart)
    assert end - first < 50
    assert first > 0
    assert end < 80


def test_dragging_moves_what_is_shown_with_the_hand_and_a_double_click_shows_all(visit: Visit) -> None:
    chart = Chart(visit, schedule(timing=Timing(80, 44, 80)))
    chart.click("zoom in")
    x, y = middle(chart)
    chart.page.mouse.move(x, y)
    chart.page.mouse.down()
    chart.page.mouse.move(x - 100, y, steps=4)
    chart.page.mouse.up()
    chart.settle()
    first, end = stretch(chart)
    assert first == pytest.approx(20 + 100 / 920 * 40, abs=0.5)
    assert end - first == pytest.approx(40, abs=0.1)
    chart.page.mouse.dblclick(x, y)
    chart.settle()
    assert chart.range == "80 steps"


def test_a_click_keeps_what_a_job_says_until_the_chart_is_left(visit: Visit) -> None:
    chart = Chart(visit, schedule())
    x, y = middle(chart)
    chart.page.mouse.click(x + 20, y)
    chart.page.mouse.move(x, 5)
    assert "high-rate job of step 5" in chart.text("tip")
    assert "high-rate job of step 5" in chart.text("live")
    chart.page.mouse.click(x, 600)
    assert not chart.page.locator(".ss-gantt-tip").is_visible()


def fingers(chart: Chart, *moves: list[tuple[float, float]]) -> None:
    """Fingers that are put down, moved and lifted: where each of them is, one move after another."""
    session = chart.page.context.new_cdp_session(chart.page)
    for number, places in enumerate([*moves, []]):
        points = [{"x": x, "y": y, "id": finger} for finger, (x, y) in enumerate(places)]
        kind = "touchStart" if number == 0 else "touchMove" if places else "touchEnd"
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    chart.settle()


def test_the_page_scrolls_under_a_finger_on_the_chart(visit: Visit) -> None:
    chart = Chart(visit, schedule(timing=Timing(80, 44, 80)), width=360, around=TALL)
    x, y = middle(chart)
    fingers(chart, *([(x, y - up)] for up in range(0, 200, 20)))
    chart.page.wait_for_function("scrollY > 50")
    assert chart.range == "80 steps"


def test_a_finger_moves_what_is_shown_along_its_axis(visit: Visit) -> None:
    chart = Chart(visit, schedule(timing=Timing(80, 44, 80)), width=360, around=TALL)
    chart.click("zoom in")
    x, y = middle(chart)
    fingers(chart, *([(x - left, y)] for left in range(0, 120, 20)))
    assert stretch(chart)[0] > 25
    assert chart.page.evaluate("scrollY") == 0


def test_a_tap_tells_of_a_job(visit: Visit) -> None:
    chart = Chart(visit, schedule(), width=360)
    x, y = middle(chart)
    fingers(chart, [(x + 10, y)])
    chart.page.wait_for_function("!document.querySelector('.ss-gantt-tip').hidden")
    assert "high-rate job of step" in chart.text("tip")


def test_two_fingers_zoom(visit: Visit) -> None:
    chart = Chart(visit, schedule(timing=Timing(80, 44, 80)), width=360)
    x, y = middle(chart)
    fingers(chart, *([(x - apart, y), (x + apart, y)] for apart in (30, 40, 50, 60)))
    first, end = stretch(chart)
    assert end - first == pytest.approx(40, rel=0.1)
