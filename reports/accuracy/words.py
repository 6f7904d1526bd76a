"""Names and figures of the report on accuracy, as it writes them."""

from __future__ import annotations

import re
from typing import NamedTuple

from filters.accuracy import Accuracy
from reports.charts.panels import METHOD_NAMES
from reports.pages.numbers import significant
from reports.pages.stored import Rows
from studies.accuracy.given import Given
from studies.accuracy.scale import SUMMED

ROUNDING, LEAST_PERCENT = 1e-12, 1e-3
"""Less than the second is written as less than this."""


class Shown(NamedTuple):
    """How a model's output is written. scale: of its unit in one of the model's."""

    name: str
    unit: str
    scale: float


MODELS = {
    "ins-gps": Shown("INS, GPS 0.5 m", "m", 1.0),
    "ins-rtk": Shown("INS, RTK 2 cm", "mm", 1e3),
    "star-tracker": Shown("Star tracker", "µrad", 1e6),
    "camera": Shown("Camera", "mm", 1e3),
}


def deviation(name: str, value: float) -> str:
    """Three digits and the unit."""
    if value == float("inf"):
        return "no bound"
    return f"{significant(value * MODELS[name].scale)} {MODELS[name].unit}"


def percents(share: float) -> str:
    """Three digits; 0.1 is 10 %."""
    if share == float("inf"):
        return "no bound"
    return f"< {LEAST_PERCENT:g}" if abs(100 * share) < LEAST_PERCENT else significant(100 * share)


def short_percents(share: float) -> str:
    """At most two digits, for who reads in a hurry."""
    text = significant(100 * share, 2)
    return text.rstrip("0").rstrip(".") if "." in text else text


def more(share: float) -> str:
    """So much above the other; nothing where it is the same but for rounding."""
    if abs(share) < ROUNDING:
        return "+0 %"
    return f"{'' if abs(100 * share) < LEAST_PERCENT else '+'}{percents(share)} %"


def heading(of: Given) -> str:
    """A model with its rates."""
    return f"{MODELS[of.name].name}: a fix every {of.ms(of.N):g} ms, {of.ms(of.M):g} ms late"


def method_name(method: str) -> str:
    return "Dual-rate, $Q'$" if method == SUMMED else METHOD_NAMES[method]


def plain_name(method: str) -> str:
    return "Dual-rate, Q′" if method == SUMMED else METHOD_NAMES[method]


def verdict(method: str, accuracy: Accuracy, exact: Accuracy) -> str:
    """exact: of the same age."""
    if method == "standard":
        return "exact, if nothing is late"
    if method == "px4-predictor":
        return f"approximate: {more(accuracy.worst / exact.worst - 1)}, rms {more(accuracy.rms / exact.rms - 1)}"
    if method == "fuse-as-fresh":
        return f"wrong: biased by {significant(accuracy.bias)} m at 15 m/s"
    if method == SUMMED:
        return f"approximate: {more(accuracy.worst / exact.worst - 1)}"
    return "exact"


def ordinal(n: int) -> str:
    return {1: "every", 2: "every 2nd", 3: "every 3rd"}.get(n, f"every {n}th")


def unbroken(rows: Rows) -> Rows:
    """For a page: a line may not end between a number and its unit, nor in "GPS 0.5 m"."""
    return [
        [re.sub(r"(?<=[\d<>]) (?=[\d%a-zµ(])|(?<=GPS|RTK) (?=\d)", "\N{NO-BREAK SPACE}", str(cell)) for cell in row]
        for row in rows
    ]
