"""Names and figures of the report on boards, as it writes them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import ceil

from reports.drawing.style import SOURCES as KINDS
from reports.drawing.style import Line
from reports.pages.machine import marked
from reports.pages.minus import true_minus
from reports.pages.numbers import significant, span
from reports.pages.stored import Rows
from sched_sim.costs.table import Cost
from studies.measurement.published_timings import Written

SOURCES: Mapping[str, str] = {
    "cortex-m4f": "M4F, float",
    "cortex-m33": "M33, float",
    "cortex-m7": "M7, double",
    "cortex-m4-soft": "M4, soft double",
    "c": marked("C"),
    "numba": marked("numba"),
    "numpy": marked("NumPy"),
}
"""What figures and tables call them, in their order."""
CORES = ("cortex-m4f", "cortex-m33", "cortex-m7", "cortex-m4-soft")
IN_HARDWARE = CORES[:3]
HERE = ("c", "numba", "numpy")
EMULATED, MEASURED = KINDS["emulated"], KINDS["measured"]
LINES: Mapping[str, Line] = {
    "cortex-m4f": Line(EMULATED.colour, "-", EMULATED.marker, 4.8),
    "cortex-m33": Line("#0d2b1a", "-", "D", 2.6),
    "cortex-m7": Line("#5c7a1f", "-", "o", 4.4),
    "cortex-m4-soft": Line("#1d8a5f", "-", "X", 4.6),
    "c": Line(MEASURED.colour, "-", MEASURED.marker, 4.6),
    "numba": Line("#8a5800", "-", "v", 4.6),
}
"""Greens of emulated cores, browns of what is timed here; no two have one shape."""
PAPERS = ("recalculate", "larsen", "dual-rate")
"""Methods of Steffes 2014, beside the standard filter."""
OTHERS = ("clone", "clone-split", "carried-gain", "delayed-horizon")
SHOWN = ("standard", "larsen", "dual-rate", "clone")
"""Methods whose jobs are on the page; all are in the files."""
WRITTEN: Mapping[Written, str] = {
    "plain loops": "plain loops, as they are counted",
    "with more around it": "the job and more around it",
    "generic matrix class": "generic matrix class",
    "zeros left out": "zeros left out, unrolled or generated",
    "left out of both": "zeros left out, of the counts too",
}


def microseconds(cost: Cost) -> str:
    """Median, and from the minimum to the 95th percentile."""
    least, median, most = (significant(1e6 * float(value)) for value in (cost.minimum, cost.median, cost.p95))
    return f"{median} ({span(least, most)})"


def signed(deviation: float | Fraction) -> str:
    """In percent with one decimal, and its sign."""
    text = f"{100 * float(deviation):+.1f}"
    return "0.0" if text in ("+0.0", "-0.0") else true_minus(text)


def percent_up(share: Fraction) -> str:
    """In percent, one decimal, never less than it is: within so much a largest deviation is."""
    return f"{ceil(1000 * share) / 10:.1f}"


def factor(ratios: Sequence[Fraction]) -> str:
    """Within which factor of 1 all of them are: two digits, never less than it is."""
    most = max(max(ratio, 1 / ratio) for ratio in ratios)
    return f"{ceil(most)}" if most >= 10 else f"{ceil(10 * most) / 10:g}"


def as_ratio(value: Fraction) -> str:
    """Of one time to another: two decimals, one from 10 on."""
    return f"{float(value):.{1 if value >= 10 else 2}f}"


def on_page(rows: Rows) -> Rows:
    """A line may not end within "15, 3", "168 MHz", "inconclusive: few",
    "cortex-m4f" or a date. A method and its job share a cell, so that
    what a row is of is seen beside its numbers, on a phone and where a page of paper begins too."""
    if list(rows[0][:2]) == ["Method", "job"]:
        rows = [["Job", *rows[0][2:]], *([f"{method}: {job}", *rest] for method, job, *rest in rows[1:])]
    return [[_unbroken(str(cell)) for cell in row] for row in rows]


def _unbroken(cell: str) -> str:
    together = re.sub(r"(?<=\d,) (?=\d)|(?<=\d) (?=MHz)|(?<=inconclusive:) ", "\N{NO-BREAK SPACE}", cell)
    return re.sub(
        r"cortex-[\w-]+|\d{4}-\d\d-\d\d", lambda name: name[0].replace("-", "\N{NON-BREAKING HYPHEN}"), together
    )
