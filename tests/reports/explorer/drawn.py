"""Schedules to draw, as a view has them, and a page that draws them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict
from fractions import Fraction
from typing import Any

from reports.explorer.module import asset, module
from sched_sim.costs.table_file import load_costs
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.timing import Timing
from sched_sim.schedule.tasks import Task
from studies.explorer.schedule import timeline
from tests.browser import Visit
from tests.reports.explorer.scripts import PAGE

TEN = Timing(10, 4, 8)
STYLES = ("palette.css", "gantt.css")


def schedule(
    method: str = "dual-rate",
    timing: Timing = TEN,
    speed: str = "0.77",
    *,
    cycles: int = 1,
    options: Options = Options(),
    tasks: Sequence[Task] = (),
    period_ms: float | None = 2.5,
) -> dict[str, Any]:
    """The "schedule" of a view, with the costs of the paper."""
    costs = select(load_costs("steffes2014"), method, options, "minimum")
    return asdict(timeline(costs, timing, Fraction(speed), cycles, options, tasks, period_ms))


def late() -> dict[str, Any]:
    """One job of 12 misses its deadline."""
    return schedule(speed="0.7")


def nothing() -> dict[str, Any]:
    """A processor with nothing to do."""
    empty: dict[str, Any] = schedule()
    empty.update(rows=[{"name": "idle", "cpu": 0}], styles=[], marks=[], busy=0.0)
    for columns in (empty["jobs"], empty["bars"]):
        columns.update({name: [] for name in columns})
    return empty


def by_hand(steps: int, jobs: Iterable[tuple[float, float | None, float]]) -> dict[str, Any]:
    """Of jobs (release, finish, deadline) of one kind, each of which runs from release to finish."""
    listed = list(jobs)
    numbers = list(range(len(listed)))
    zeros = [0] * len(listed)
    ends = [steps if finish is None else finish for _, finish, _ in listed]
    missed = [end > deadline for end, (_, _, deadline) in zip(ends, listed, strict=True)]
    starts = [release for release, _, _ in listed]
    return {
        "steps": steps,
        "period_ms": None,
        "cut": "",
        "rows": [{"name": "HR", "cpu": 0}],
        "styles": [{"label": "P", "meaning": "propagate"}],
        "jobs": {
            "row": zeros,
            "kind": ["hr"] * len(listed),
            "step": numbers,
            "release": starts,
            "start": starts,
            "finish": [finish for _, finish, _ in listed],
            "deadline": [deadline for _, _, deadline in listed],
            "missed": missed,
            "preemptions": zeros,
        },
        "bars": {"row": zeros, "style": zeros, "start": starts, "end": ends, "job": numbers},
        "marks": [],
        "misses": sum(missed),
        "busy": 0.5,
    }


class Chart:
    """A Gantt chart on a page of its own; `page` is Playwright's."""

    def __init__(self, visit: Visit, shown: dict[str, Any], *, width: int = 1000, around: str = "") -> None:
        self.page = visit.page
        self.page.set_viewport_size({"width": width, "height": 700})
        style = "".join(asset(style) for style in STYLES) + "body { margin: 0; font: 15px sans-serif; }" + around
        self.page.set_content(PAGE.format(style=style))
        self.page.add_script_tag(
            content=module("gantt") + "window.chart = ganttChart(document.querySelector('#host'));", type="module"
        )
        self.page.wait_for_function("window.chart !== undefined")
        self.show(shown)

    def show(self, shown: dict[str, Any]) -> None:
        self.page.evaluate("shown => chart.show(shown)", shown)
        self.settle()

    def settle(self) -> None:
        """Waits until what was asked for is drawn."""
        self.page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def press(self, *keys: str) -> None:
        """Keys, with the chart in focus."""
        self.page.focus(".ss-gantt-frame")
        for key in keys:
            self.page.keyboard.press(key)
        self.settle()

    def click(self, label: str) -> None:
        self.page.get_by_role("button", name=label, exact=True).click()
        self.settle()

    def text(self, part: str) -> str:
        """Of the part whose class is ss-gantt-PART."""
        return self.page.locator(f".ss-gantt-{part}").inner_text()

    @property
    def range(self) -> str:
        """Which steps are shown, in words."""
        return self.text("range")

    def columns(self, colour: tuple[int, int, int], *, apart: int = 3) -> list[int]:
        """The columns of the canvas, from the left, in which some pixel has the colour, or nearly."""
        found: list[int] = self.page.evaluate(
            """([colour, apart]) => {
              const canvas = document.querySelector(".ss-gantt-frame canvas");
              const { data, width } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
              const found = new Set();
              for (let at = 0; at < data.length; at += 4) {
                const near = colour.every((value, channel) => Math.abs(value - data[at + channel]) <= apart);
                if (near && data[at + 3] > 200) found.add((at / 4) % width);
              }
              return [...found].sort((one, other) => one - other);
            }""",
            [list(colour), apart],
        )
        return found
