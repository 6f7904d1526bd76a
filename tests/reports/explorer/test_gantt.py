"""The Gantt chart in a browser: what it draws and says."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import pytest
from axe_playwright_python.sync_playwright import Axe
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from playwright.sync_api import Browser

from reports.drawing.style import FILLS, RED, TASK_FILLS
from sched_sim.design.options import Options
from sched_sim.design.timing import Timing
from sched_sim.schedule.tasks import Task
from tests.browser import Visit
from tests.reports.explorer.drawn import Chart, by_hand, late, nothing, schedule
from tests.reports.explorer.scripts import asking, loaded
from tests.reports.explorer.test_palette import contrast

BLUE = FILLS["HRP"].colour
TASKS = [Task("control", "2", "0.3", 5, "0"), Task("<b>telemetry</b>", "5", "0.7", 15, "1")]


def rgb(colour: str) -> tuple[int, int, int]:
    return int(colour[1:3], 16), int(colour[3:5], 16), int(colour[5:7], 16)


def test_its_hatches_are_those_of_print(browser: Browser) -> None:
    with asking(browser, "colours") as colours:
        assert colours("return of.HATCHES;") == {label: fill.hatch[0] for label, fill in FILLS.items() if fill.hatch}
        assert colours("return of.TASK_HATCHES;") == [fill.hatch[:1] for fill in TASK_FILLS]


def test_tasks_have_their_fills_in_turn_by_name_as_in_print(browser: Browser) -> None:
    labels = ["task:z", "HRP", "task:a", "task:b", "task:c", "task:d"]
    with asking(browser, "colours") as colours:
        names = colours("return of.fillNames(a);", [{"label": label} for label in labels])
    assert names == ["task0", "HRP", "task0", "task1", "task2", "task3"]


def test_pale_work_has_an_outline_in_the_light_and_none_in_the_dark(visit: Visit) -> None:
    """In the dark every fill stands out; with the user's own colours all have the outline of texts."""
    loaded(visit, "colours", styles=("palette.css", "gantt.css"))
    ask = """labels => colours.coloursOf(document.body, labels.map((label) => ({label})))"""
    of_print = {label: fill for label, fill in FILLS.items() if contrast(fill.colour, "white") < 3}
    for scheme, forced in (("light", "none"), ("dark", "none"), ("light", "active")):
        visit.page.emulate_media(color_scheme=scheme, forced_colors=forced)  # type: ignore[arg-type]
        found = visit.page.evaluate(ask, list(FILLS))
        edged = {label for label, fill in zip(FILLS, found["fills"], strict=True) if fill["edge"]}
        assert edged == (set(FILLS) if forced == "active" else set(of_print) if scheme == "light" else set())
    visit.page.emulate_media(color_scheme="light", forced_colors="none")


def test_work_is_drawn_where_it_is_done_and_nowhere_else(visit: Visit) -> None:
    bars = [(0.0, 1.5, 2), (3.0, 3.25, 4), (7.0, 9.5, 10)]
    chart = Chart(visit, by_hand(10, bars))
    drawn = chart.columns(rgb(FILLS["P"].colour))
    left, right = drawn[0], drawn[-1]
    per_step = (right - left) / 9.5
    for at in range(1, 100):
        step = at / 10 + 0.03
        if step < 9.5:
            worked = any(start <= step < end for start, end, _ in bars)
            assert (round(left + step * per_step) in drawn) == worked


@pytest.mark.parametrize("method", ["larsen", "dual-rate"])
def test_its_legend_says_what_runs_and_what_the_signs_mean(method: str, visit: Visit) -> None:
    chart = Chart(visit, schedule(method, Timing(10, 4, 4 if method == "larsen" else 8), "1.5"))
    said = chart.text("legend")
    wanted = {"larsen": ("P", "U"), "dual-rate": ("HRP", "HRU", "LRP", "LRU")}[method]
    assert all(f"{label}  {FILLS[label].meaning}" in said for label in wanted)
    assert "release" in said
    assert "measurement arrives" in said
    assert f"correction lands, step {4 if method == 'larsen' else 5} ({10 if method == 'larsen' else 12.5} ms)" in said
    assert "missed" not in said


def test_a_late_schedule_says_so_in_words_and_draws_it_in_red(visit: Visit) -> None:
    chart = Chart(visit, late())
    assert chart.text("finding").startswith("✗ 1 of 12 jobs misses its deadline")
    assert "1 of 12 jobs misses its deadline" in (
        chart.page.locator(".ss-gantt-frame").get_attribute("aria-label") or ""
    )
    assert "missed deadline" in chart.text("legend")
    assert "work after its deadline" in chart.text("legend")
    assert len(chart.columns(rgb(RED))) > 15


def test_a_schedule_in_time_has_no_red(visit: Visit) -> None:
    chart = Chart(visit, schedule())
    assert chart.text("finding").startswith("no deadline missed · 87")
    assert chart.columns(rgb(RED)) == []


def test_no_merging_hides_a_miss(visit: Visit) -> None:
    misses = (0, 7_777, 19_999)
    shares = (0.4 if step in misses else 1 for step in range(20_000))
    chart = Chart(visit, by_hand(20_000, ((step, step + 0.5, step + share) for step, share in enumerate(shares))))
    red = chart.columns(rgb(RED))
    groups = [after - before for before, after in pairwise(red) if after - before > 12]
    assert len(groups) + 1 == len(misses)
    assert groups[0] / sum(groups) == pytest.approx(7_777 / 20_000, abs=0.02)


@st.composite
def stretches_of_jobs(draw: st.DrawFn) -> tuple[int, list[tuple[float, float, float]], float, float]:
    """Steps, jobs that run one after another, some beyond their deadlines, and the ends of what is shown."""
    steps = draw(st.integers(1, 3000))
    longest = draw(st.floats(0.05, 0.99))
    late = draw(st.sets(st.integers(0, steps - 1), max_size=3))
    jobs = [(step, step + longest, step + (longest / 2 if step in late else 1)) for step in range(steps)]
    first = draw(st.floats(0, 0.95)) * steps
    return steps, jobs, first, first + draw(st.floats(0.02, 1)) * (steps - first)


@settings(deadline=None, max_examples=5, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(stretches_of_jobs())
def test_there_is_red_where_and_only_where_a_deadline_is_missed(
    visit: Visit, given: tuple[int, list[tuple[float, float, float]], float, float]
) -> None:
    steps, jobs, first, end = given
    chart = Chart(visit, {**by_hand(steps, jobs), "first": first, "last": end})
    shown = [finish > deadline and first < finish and deadline < end for _, finish, deadline in jobs]
    assert bool(chart.columns(rgb(RED))) == any(shown)


def test_what_is_under_a_pixel_is_as_dense_as_the_processor_is_busy(visit: Visit) -> None:
    chart = Chart(visit, by_hand(20_000, ((step, step + 0.5, step + 1) for step in range(20_000))))
    alpha = chart.page.evaluate(
        """() => {
          const canvas = document.querySelector(".ss-gantt-frame canvas");
          const middle = canvas.getContext("2d").getImageData(500, 64, 1, 1).data;
          return [...middle];
        }"""
    )
    assert alpha[3] == pytest.approx(127, abs=3)
    assert alpha[:3] == pytest.approx(rgb(FILLS["P"].colour), abs=2)


def test_rows_of_several_processors_and_tasks_are_named_and_no_name_is_markup(visit: Visit) -> None:
    chart = Chart(visit, schedule(timing=Timing(20, 8, 16), speed="1.3", tasks=TASKS, options=Options(cpus=2)))
    said = chart.text("legend")
    assert said.index("HRP") < said.index("LRU") < said.index("task control") < said.index("<b>telemetry</b>")
    assert chart.page.locator(".ss-gantt-legend b").count() == 0


@pytest.mark.parametrize("of", [nothing, lambda: by_hand(1, [(0, 0.4, 1)]), lambda: by_hand(3, [(0, None, 1)])])
def test_a_schedule_of_almost_nothing_is_drawn_too(of: Callable[[], dict[str, Any]], visit: Visit) -> None:
    chart = Chart(visit, of())
    assert chart.text("finding")
    chart.press("ArrowRight", "ArrowDown", "End", "+", "+", "0")
    chart.click("zoom in")


def test_another_schedule_with_as_many_steps_keeps_the_stretch_and_makes_no_elements_anew(visit: Visit) -> None:
    chart = Chart(visit, schedule())
    chart.click("zoom in")
    zoomed = chart.range
    assert zoomed != "10 steps"
    chart.page.evaluate("window.before = [...document.querySelectorAll('.ss-gantt *')]")
    chart.show(schedule(speed="0.78"))
    assert chart.range == zoomed
    assert chart.page.evaluate("before.every(element => element.isConnected)")
    chart.show(schedule(timing=Timing(20, 8, 16)))
    assert chart.range == "20 steps"


def test_a_window_of_a_run_begins_where_it_says(visit: Visit) -> None:
    marks = [{"step": 203, "label": f"{letter} {name}", "meaning": f"{name} {does}"}
             for name in ("gps", "camera") for letter, does in (("k", "measures"), ("l", "has landed"))]  # fmt: skip
    window = by_hand(220, ((step, step + 0.5, step + 1) for step in range(200, 220)))
    chart = Chart(visit, {**window, "origin": 200, "marks": marks})
    assert chart.range == "steps 200 to 220"
    assert min(chart.columns(rgb(FILLS["P"].colour))) < 60
    assert all(f"{mark['label']}{mark['meaning']}" in chart.text("legend").replace("\n", "") for mark in marks)
    chart.press("-")
    assert chart.range == "steps 200 to 220"
    chart.press("+")
    assert chart.range == "steps 203.3 to 216.7"


def test_it_begins_with_a_part_where_one_is_given(visit: Visit) -> None:
    chart = Chart(visit, {**schedule(), "first": 3, "last": 7})
    assert chart.range == "steps 3 to 7 of 10"
    chart.click("show all steps")
    assert chart.range == "10 steps"


def test_it_is_as_wide_as_its_place(visit: Visit) -> None:
    chart = Chart(visit, schedule(), width=1000)
    for width in (360, 1400):
        chart.page.set_viewport_size({"width": width, "height": 700})
        chart.settle()
        chart.settle()
        assert chart.page.evaluate("document.querySelector('canvas').clientWidth") == pytest.approx(width, abs=20)
        assert chart.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_in_the_dark_and_back_it_has_other_colours(visit: Visit) -> None:
    chart = Chart(visit, schedule())
    chart.page.evaluate("document.body.dataset.theme = 'dark'")
    chart.settle()
    assert chart.columns(rgb(BLUE)) == []
    chart.page.evaluate("document.body.dataset.theme = 'light'")
    chart.settle()
    assert chart.columns(rgb(BLUE))


def test_on_paper_it_is_light(visit: Visit) -> None:
    visit.page.emulate_media(color_scheme="dark")
    chart = Chart(visit, schedule())
    assert chart.columns(rgb(BLUE)) == []
    chart.page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    assert chart.columns(rgb(BLUE))
    chart.page.evaluate("window.dispatchEvent(new Event('afterprint'))")
    assert chart.columns(rgb(BLUE)) == []


def test_destroyed_it_leaves_nothing(visit: Visit) -> None:
    chart = Chart(visit, schedule())
    chart.page.evaluate("chart.destroy()")
    assert chart.page.evaluate("document.querySelector('#host').childElementCount") == 0


@pytest.mark.parametrize(("of", "scheme"), [(schedule, "light"), (late, "dark"), (nothing, "light")])
def test_it_breaks_no_rule_of_accessible_pages(of: Callable[[], dict[str, Any]], scheme: Any, visit: Visit) -> None:
    visit.page.emulate_media(color_scheme=scheme)
    chart = Chart(visit, of())
    chart.press("ArrowRight", "ArrowDown")
    found = Axe().run(chart.page).response["violations"]
    assert [(each["id"], [node["html"] for node in each["nodes"]]) for each in found] == []
