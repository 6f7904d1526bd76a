"""How long the explorer's page takes from a slider to the picture, in a real browser with the real server."""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator
from importlib.util import find_spec
from statistics import median
from typing import Any

from playwright.sync_api import Page, expect

from benchmarks.timing import Result
from tests.browser import started
from tests.reports.explorer.explored import exploring

STEPS = 21
DESIGNS = {
    "N = 80": "hr_hz=400&measurement_hz=5&delay_ms=110&model=ins-gps&within=0.4",
    "N = 1,000": "hr_hz=1000&measurement_hz=1&delay_ms=110",
}

SLIDER = """async ([label, steps]) => {
  const sliders = [...document.querySelectorAll("input[type=range]")];
  const slider = sliders.find((one) => one.ariaLabel === label && one.checkVisibility());
  const root = document.querySelector(".ss-explorer");
  const frame = () => new Promise(requestAnimationFrame);
  const times = [];
  for (let step = 0; step < steps; step += 1) {
    const before = root.dataset.shown;
    const start = performance.now();
    slider.value = Number(slider.value) + 1;
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    while (root.dataset.shown === before) await frame();
    await frame();
    times.push(performance.now() - start);
  }
  return times;
}"""

NOTHING = """async (steps) => {
  const frame = () => new Promise(requestAnimationFrame);
  const times = [];
  for (let step = 0; step < steps; step += 1) {
    const start = performance.now();
    await fetch("/favicon.ico");
    await frame();
    await frame();
    times.push(performance.now() - start);
  }
  return times;
}"""
"""Of a page that asks for nothing and draws nothing."""


def results() -> Iterator[Result]:
    if shutil.which("chromium") is None or find_spec("uvicorn") is None:
        print("Not measured: the explorer's page in a browser, for there is no chromium, or not the extra explore.")
        return
    with exploring("--port", "0") as explorer, started() as browser:
        page = browser.new_page()
        page.goto(f"{explorer.base}nothing")
        least = median(page.evaluate(NOTHING, STEPS))
        for name, query in DESIGNS.items():
            took = median(_dragged(page, f"{explorer.base}?{query}"))
            yield Result(f"explorer: slider to picture, {name}", took, 100, False, "ms")
            yield Result(f"explorer: the same over an empty page, {name}", took / least, 6, False)


def _dragged(page: Page, address: str) -> Any:
    page.goto(address)
    expect(page.locator(".ss-explorer")).to_have_attribute("data-shown", re.compile("."))
    return page.evaluate(SLIDER, ["Delay, slider", STEPS])
