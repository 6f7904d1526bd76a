"""Bars of a Gantt panel as polygons and their outlines."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias

from reports.charts.scale import Scale

Box: TypeAlias = tuple[float, float, float, float]
"""Left, right (in steps), foot, head (in mm)."""

Points = list[tuple[float, float]]


def rectangles(boxes: Iterable[Box]) -> list[Points]:
    """Their corners."""
    return [[(left, foot), (right, foot), (right, head), (left, head)] for left, right, foot, head in boxes]


def outlines(boxes: Iterable[Box], scale: Scale, edge_mm: float) -> list[Points]:
    """Closed lines `edge_mm` wide that stay inside from left to right, so that no gap beside a bar looks busy. What is
    narrower than a line has none."""
    edge = edge_mm / scale.mm_per_step
    inner = [
        (left + edge / 2, right - edge / 2, foot, head) for left, right, foot, head in boxes if right - left > edge
    ]
    return [[*corners, corners[0]] for corners in rectangles(inner)]
