"""A schedule as a notebook shows it: HTML that is whole in itself."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from fractions import Fraction
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

pytest.importorskip("IPython", reason="it comes with the extra notebook, which is not installed")

from IPython.core.formatters import DisplayFormatter

from reports.explorer import notebook
from reports.explorer.notebook import schedule_html
from sched_sim import Task, Timing, load_costs, run_scenario, select, simulate
from sched_sim import shown as plug_in
from sched_sim.schedule.intervals import jobs
from sched_sim.schedule.outcome import Schedule
from tests.browser import Visit
from tests.scenarios import scenario, sensor

LATE = scenario(1, {"predict": 0.1, "correct.gps": 0.5}, sensor("gps", 10, [1, 3]), steps=100)
PROJECT = Path(__file__).parents[3] / "pyproject.toml"


def schedule(cycles: int = 1, *, speed: float = 0.77, keep_slices: bool = True) -> Schedule:
    return simulate(
        select(load_costs("steffes2014"), "dual-rate"), Timing(10, 4, 8), speed, cycles, keep_slices=keep_slices
    )


@pytest.fixture
def installed(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """What pyproject.toml says, whether the project was installed since or not."""
    points = [
        EntryPoint(name, value, plug_in.GROUP)
        for name, value in tomllib.loads(PROJECT.read_text())["project"]["entry-points"][plug_in.GROUP].items()
    ]
    monkeypatch.setattr(
        plug_in, "entry_points", lambda *, group, name: [p for p in points if (p.group, p.name) == (group, name)]
    )
    plug_in.drawing.cache_clear()
    yield
    plug_in.drawing.cache_clear()


def displayed(value: object) -> str:
    """As a notebook takes it."""
    formats, _ = DisplayFormatter().format(value)
    return str(formats["text/html"])


def opened(visit: Visit, html: str) -> Page:
    visit.page.set_content(f"<!doctype html><title>notebook</title><body>{html}")
    return visit.page


@pytest.mark.usefixtures("installed")
def test_with_slices_it_is_a_chart_above_its_table(visit: Visit) -> None:
    late = schedule(speed=0.7)
    page = opened(visit, displayed(late))
    chart, table = page.locator(".ss-gantt-frame"), page.get_by_role("table").filter(has_text="deadlines missed")
    assert chart.bounding_box()["y"] < table.bounding_box()["y"]  # type: ignore[index]
    assert page.locator(".ss-gantt-finding").inner_text().startswith(f"✗ 1 of {len(jobs(late))} jobs misses")
    assert visit.requests == []


@pytest.mark.usefixtures("installed")
def test_several_outputs_stand_below_one_another(visit: Visit) -> None:
    page = opened(visit, displayed(schedule()) + displayed(schedule(2)))
    assert page.locator(".ss-gantt-frame").count() == 2
    assert page.locator("figure[data-alive]").count() == 0


@pytest.mark.usefixtures("installed")
def test_the_outcome_of_a_scenario_is_the_chart_of_its_schedule_above_its_tables(visit: Visit) -> None:
    outcome = run_scenario(LATE, keep_slices=True)
    assert outcome.schedule.slices
    page = opened(visit, displayed(outcome))
    assert page.locator(".ss-gantt-frame").is_visible()
    assert page.locator("caption").all_inner_texts() == [
        "Response times, in HR periods", "Measurements, and the l - k at which their corrections landed"
    ]  # fmt: skip


@pytest.mark.usefixtures("installed")
def test_without_slices_the_table_says_how_to_have_them() -> None:
    for value in (schedule(keep_slices=False), run_scenario(LATE)):
        assert "<script" not in displayed(value)
        assert "keep_slices=True" in displayed(value)
    assert "keep_slices" not in schedule()._repr_html_()


def test_where_nothing_draws_there_is_the_table(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(plug_in, "drawing", lambda _name: None)
    assert displayed(schedule()) == schedule()._repr_html_()


def test_without_scripts_the_table_stands() -> None:
    table = schedule()._repr_html_()
    assert table in schedule_html(schedule(), table)


def test_of_a_long_schedule_the_first_steps_are_drawn(visit: Visit, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(notebook, "MOST_SLICES", 20)
    page = opened(visit, schedule_html(schedule(3), "<table></table>"))
    assert "the first 11 of 30 steps" in page.locator(".ss-gantt-finding").inner_text()


@pytest.mark.parametrize(("at", "said"), [(2, "the first 11 of 30 steps"), (25, "; 2 more deadlines are missed later")])
def test_a_miss_after_what_is_drawn_is_told(at: int, said: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(notebook, "MOST_SLICES", 20)
    costs = select(load_costs("steffes2014"), "dual-rate")
    task = Task("rare", Fraction(100), Fraction(1, 4), priority=5, offset=Fraction(at))
    missing = simulate(costs, Timing(10, 4, 8), "0.77", 3, tasks=[task], keep_slices=True)
    assert missing.misses
    assert f'{said}"' in schedule_html(missing, "<table></table>")


def test_a_dark_notebook_has_a_dark_chart(visit: Visit) -> None:
    page = visit.page
    page.set_content(
        "<!doctype html><title>notebook</title><body style='background: #111'>"
        + schedule_html(schedule(), "<table></table>")
    )
    assert page.locator("figure").get_attribute("data-theme") == "dark"
    page.evaluate("document.body.style.background = 'white'")
    page.wait_for_selector("figure[data-theme=light]")


def test_keys_that_are_pressed_in_it_are_no_shortcuts_of_the_notebook(visit: Visit) -> None:
    page = opened(visit, schedule_html(schedule(), "<table></table>"))
    page.evaluate("document.addEventListener('keydown', (event) => event.preventDefault())")
    shown = page.locator(".ss-gantt-range")
    before = shown.inner_text()
    page.get_by_role("button", name="zoom in").press("Enter")
    expect(shown).not_to_have_text(before)
