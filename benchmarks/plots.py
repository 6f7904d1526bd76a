"""A new picture of a plot in a browser: ten lines of 1,500 points each, over ten lines of two."""

from __future__ import annotations

import shutil
from collections.abc import Iterator

from benchmarks.timing import Result
from reports.drawing.style import METHOD_LINES
from tests.browser import Visit, started
from tests.reports.explorer.plots import Shown
from tests.reports.explorer.scripts import loaded

LINES, POINTS, PICTURES = 10, 1500, 40
TIMED = """([shown, pictures]) => {
  const drawn = plot.plot(document.querySelector("#host"), {});
  drawn.show(shown);
  const again = (number) => {
    const lines = shown.lines.map((line) => ({ ...line, y: line.y.map((value) => value * (1 + number / pictures)) }));
    const next = { ...shown, lines };
    const start = performance.now();
    drawn.show(next);
    document.body.getBoundingClientRect();
    return performance.now() - start;
  };
  return new Promise((done) => setTimeout(() => {
    done(Math.min(...Array.from({ length: pictures }, (_, number) => again(number))));
  }, 200));
}"""


def staircases(points: int) -> Shown:
    """Lines of so many points, one for each method."""
    x = list(range(1, points + 1))
    lines = [
        {"name": name, "x": x, "y": [1 + number + 100 / at for at in x], "step": True, "current": number == 3}
        for number, name in enumerate([*METHOD_LINES][:LINES])
    ]
    across, down = {"label": "L (steps)", "log": False}, {"label": "least speed", "log": True}
    return {"title": "least speed", "x": across, "y": down, "lines": lines, "points": [], "limit": None}


def picture_ms(visit: Visit, shown: Shown) -> float:
    """The least time from a new picture to its layout."""
    loaded(visit, "plot", styles=("palette.css", "plot.css"))
    least: float = visit.page.evaluate(TIMED, [shown, PICTURES])
    return least


def results() -> Iterator[Result]:
    if shutil.which("chromium") is None:
        print("Not measured: plots in a browser, for there is no chromium.")
        return
    with started() as browser:
        full, few = (picture_ms(Visit(browser.new_context()), staircases(points)) for points in (POINTS, 2))
    yield Result(
        f"{LINES} lines of {POINTS:,} points drawn anew in a browser over lines of 2", full / few, 15, higher=False
    )
