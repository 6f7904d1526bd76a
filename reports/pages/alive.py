"""Figures that a script makes alive, and stay as they are where none runs: elements of HTML, and the script."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from functools import cache
from typing import Any, Literal

from reports.drawing.style import WIDTH_MM
from reports.explorer.compact import compact
from reports.explorer.module import asset, module

STYLES = ("palette.css", "gantt.css", "report.css")
VIEW_BOX = re.compile(r'viewBox="0 0 ([\d.]+) ')
LEAST_SHARE = 0.99
"""Of the width of a page: what differs less is as wide."""


def figure(still: str, data: Mapping[str, Any] | None, *, caption: str = "", attributes: str = "") -> str:
    """still: a `picture`, or a <table>; data: "plots", see `reports.drawing.readout`, or "panels",
    see `reports.charts.told`, with "still" where the picture is to be seen first, or "frames" of them, see
    `reports.pages.pictures.Sliding`; "narrow": that of a narrow picture after it; None where nothing is to be told.
    caption: a <figcaption>."""
    if data is None:
        return f'<figure class="ss-figure"{attributes}>{still}{caption}</figure>'
    text = json.dumps(data, allow_nan=False, separators=(",", ":")).replace("<", r"\u003c")
    script = f'<script type="application/json">{text}</script>'
    return f'<figure class="ss-figure" data-alive{attributes}>{still}{caption}{script}</figure>'


def picture(svg: str, shown: Literal["", "ss-wide", "ss-narrow"] = "") -> str:
    """svg: an element, see `reports.pages.inline`. It may become wider than the page, and then scrolls in itself.
    One that is narrower than the text of a printed page is no wider on a screen either, where there is room, so that
    letters are as large in all. shown: where; by default everywhere, else one of a pair."""
    width = VIEW_BOX.search(svg)
    share = 1.0 if width is None else float(width[1]) / 72 * 25.4 / WIDTH_MM
    narrower = f' style="--ss-share:{share:.3g}"' if share < LEAST_SHARE else ""
    return f'<div class="{f"ss-scroll {shown}".strip()}"><div class="ss-picture"{narrower}>{svg}</div></div>'


@cache
def style() -> str:
    """The style sheet of such figures."""
    return compact("".join(map(asset, STYLES)))


@cache
def script() -> str:
    """The module that makes all of a page alive, to stand behind them."""
    return compact(module("report"))
