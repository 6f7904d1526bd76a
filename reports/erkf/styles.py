"""How ways, filters, sensors and systems look: the same in each figure of the report."""

from __future__ import annotations

from reports.drawing.style import GREY, INK, Line

WAYS = {
    "inverse": Line(INK, "-", "s"),
    "Givens": Line("#11538c", "-", "o"),
    "Householder": Line("#1d8a8a", (0, (6.0, 1.5)), "p", 4.2),
    "Faddeev": Line("#6b5b1e", (0, (8.0, 2.5)), "h", 4.2),
    "pivoted LU": Line("#b3382f", (0, (4.0, 1.5)), "^"),
    "unpivoted LU": Line("#c2477f", (0, (5.0, 1.5, 1.0, 1.5)), "v"),
    "closed form": Line("#2e7d4f", (0, (1.0, 1.2)), "D"),
    "plain Kalman filter": Line(GREY, "-", "X", 4.2),
}
"""Ways to compute a step; the plain filter is there for comparison."""

EKF = Line("#c98208", "-", "X", 4.4)
ERKF = Line("#5c3a6b", "-", "P", 4.4)
LIMIT = Line(INK, (0, (4.0, 1.5)), "d", 4.4)
"""The robust filter with an infinite mu."""
FILTERS = {"EKF": EKF, "ERKF": ERKF}
WIDTHS = {"EKF": 2.4, "ERKF": 1.0}
"""The EKF lies under the ERKF, which it often cannot be told apart from, and is to be seen at both sides of it."""

TRUE = Line(INK, "-", "")
GPS = Line("#6a8fae", "-", ".", 5.0)
IMU = Line(GREY, "-", "")

HOLLOW = {"attitude": True, "position": False}
"""Signs of the two systems, whatever way they stand for."""


def way_line(name: str) -> Line:
    """Of a way's name, in which the way stands before a colon: "Givens: one QR, dense"."""
    return WAYS[name.partition(":")[0]]
