"""Table 4 on one axis: every cell with what it is uncertain by."""

from __future__ import annotations

import pytest
from matplotlib.patches import Rectangle

from reports.drawing.style import SOURCES
from reports.steffes.table4 import Speeds, table4_figure
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from tests.reports.layout import contrast_of, flaws, texts

CELLS = [
    Speeds(
        timing,
        method,
        {"printed": speed, "analysis": 1.01 * speed, "measured": 1.1 * speed},
        {"analysis": (speed, 1.02 * speed), "measured": (1.1 * speed, 1.3 * speed)},
        note,
    )
    for timing, note, *speeds in [
        (Timing(10, 4, 8), "", 2.81, 1.47, 0.78),
        (Timing(100, 10, 80), "not reached", 5.45, 1.47, 0.64),
    ]
    for method, speed in zip(("recalculate", "larsen", "dual-rate"), speeds, strict=True)
]


def test_all_cells_are_on_one_logarithmic_axis() -> None:
    figure = table4_figure(CELLS)
    assert flaws(figure) == []
    axes = figure.axes[0]
    assert axes.get_xscale() == "log"
    dots = [float(line.get_xdata()[0]) for line in axes.lines if line.get_label() == "printed"]
    assert dots == [cell.by_source["printed"] for cell in CELLS]
    assert [text.get_text() for text, _ in texts(figure)].count("not reached") == 3


def test_intervals_are_bars_and_that_of_the_analysis_goes_over_its_row() -> None:
    boxes = [patch for patch in table4_figure(CELLS).axes[0].patches if isinstance(patch, Rectangle)]
    tall = [box for box in boxes if box.get_height() > 0.8]
    found = [(box.get_x(), box.get_x() + box.get_width()) for box in tall]
    assert found == [pytest.approx(cell.intervals["analysis"]) for cell in CELLS]
    low = [(box.get_x(), box.get_x() + box.get_width()) for box in boxes if box not in tall]
    assert low == [pytest.approx(cell.intervals["measured"]) for cell in CELLS]


def test_intervals_stand_out_from_the_page() -> None:
    assert min(map(contrast_of, table4_figure(CELLS).axes[0].patches)) >= 3


def test_a_source_is_told_apart_by_its_own_sign() -> None:
    lines = table4_figure(CELLS).axes[0].lines
    assert {line.get_label(): line.get_marker() for line in lines if not str(line.get_label()).startswith("_")} == {
        "printed": SOURCES["printed"].marker,
        "analysis": SOURCES["analysis"].marker,
        "measured †": SOURCES["measured"].marker,
    }


def test_a_source_without_a_sign_is_refused() -> None:
    with pytest.raises(InputError, match="'guessed'"):
        table4_figure([CELLS[0]._replace(by_source={"guessed": 1.0}, intervals={})])
