"""A frame of the Gantt chart in a browser: of 20,000 pieces of work, over that of a processor with nothing to do."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from typing import Any

from benchmarks.timing import Result
from tests.browser import Visit, started
from tests.reports.explorer.drawn import Chart, by_hand, nothing

PIECES, KEYS = 20_000, 20
TIMED = """() => {
  window.times = [];
  const original = window.requestAnimationFrame;
  window.requestAnimationFrame = (draw) => original((now) => {
    const start = performance.now();
    draw(now);
    const pen = document.querySelector(".ss-gantt-frame canvas").getContext("2d");
    pen.getImageData(0, 0, 1, 1);
    times.push(performance.now() - start);
  });
}"""


def frame_ms(visit: Visit, shown: dict[str, Any]) -> float:
    """The least time of a frame, with its pixels done, as keys zoom in a little and out to all of it."""
    chart = Chart(visit, shown)
    chart.page.focus(".ss-gantt-frame")
    chart.page.evaluate(TIMED)
    for _ in range(KEYS):
        for key in ("+", "0"):
            chart.page.keyboard.press(key)
            chart.page.evaluate("() => new Promise(done => setTimeout(done, 40))")
    whole: list[float] = chart.page.evaluate("times.slice(1).filter((_, at) => at % 2 === 0)")
    return min(whole)


def results() -> Iterator[Result]:
    if shutil.which("chromium") is None:
        print("Not measured: frames of the Gantt chart in a browser, for there is no chromium.")
        return
    late = PIECES // 3
    jobs = [(at, at + 0.5, at + (0.4 if at == late else 1)) for at in range(PIECES)]
    with started() as browser:
        full, empty = (frame_ms(Visit(browser.new_context()), shown) for shown in (by_hand(PIECES, jobs), nothing()))
    yield Result(f"a frame of {PIECES:,} pieces of work in a browser over an empty one", full / empty, 6, higher=False)
