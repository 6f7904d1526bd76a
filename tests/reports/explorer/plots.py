"""Plots for tests, made of what the library says."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from sched_sim import Options, Timing, achieved_l, load_costs, select, staircase

N, M = 20, 4
Shown = dict[str, Any]


def stairs_shown() -> Shown:
    """The least speed of three methods against L, the design L = 8, a pinned one, and no limit."""
    table = load_costs("steffes2014")
    lines = []
    for method in ("dual-rate", "larsen", "recalculate"):
        stairs = staircase(select(table, method, Options()), N, M)
        x, y = [stair.L for stair in stairs], [float(stair.speed) for stair in stairs]
        lines.append({"name": method, "x": x, "y": y, "step": True, "current": method == "dual-rate"})
    return {
        "title": "Least speed by L",
        "x": {"label": "L (steps)", "log": False},
        "y": {"label": "least speed (standard steps)", "log": True},
        "lines": lines,
        "points": [point_on(lines[0], 8, "this design", current=True), point_on(lines[0], 12, "A", current=False)],
        "limit": None,
    }


def point_on(line: Shown, x: float, label: str, *, current: bool) -> Shown:
    return {"x": x, "y": line["y"][line["x"].index(x)], "label": label, "current": current}


def landings_shown() -> Shown:
    """The achieved l of the dual-rate filter against speed: nothing lands at the slowest speeds."""
    costs = select(load_costs("steffes2014"), "dual-rate", Options())
    speeds = [Fraction(number, 100) for number in range(60, 200, 5)]
    landed = [achieved_l(costs, Timing(N, M, N), speed) for speed in speeds]
    line = {"name": "dual-rate", "x": [float(speed) for speed in speeds], "y": landed, "step": True, "current": True}
    return {
        "title": "Where it lands",
        "x": {"label": "speed (standard steps)", "log": True},
        "y": {"label": "l, step in which it lands (steps)", "log": False},
        "lines": [line],
        "points": [],
        "limit": None,
    }


def accuracy_shown(limit: float) -> Shown:
    """A standard deviation that grows with L, below and above a limit."""
    x = list(range(5, 21))
    line = {"name": "dual-rate", "x": x, "y": [0.35 + 0.005 * L for L in x], "step": False, "current": True}
    return {
        "title": "Worst standard deviation",
        "x": {"label": "L (steps)", "log": False},
        "y": {"label": "worst std (m)", "log": False},
        "lines": [line],
        "points": [point_on(line, 12, "this design", current=True)],
        "limit": {"y": limit, "label": f"within {limit:g} m"},
    }
