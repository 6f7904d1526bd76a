"""Figures on the multirate gain: their numbers are those they were given, and they can be read."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from reports.charts.chart import gantt
from reports.multirate.accuracy import Curve, Family, start_figure, steady_figure
from reports.multirate.costs import least_time_of, our_forms, patents_form
from reports.multirate.figures import load_figure, one_loop_panel, two_rates_panel
from sched_sim.design.load import utilization
from sched_sim.design.timing import Timing
from sched_sim.processors.part import on_part
from sched_sim.processors.part_file import load_part
from sched_sim.schedule.intervals import bars
from tests.reports.layout import flaws, texts

PATENT = load_part("patent")
TABLE = on_part(patents_form().table, PATENT)
READINGS = {"averaged": "$K(R/n)/n$", "sampled": "$K(R)/n$", "skipped": "every $n$-th measurement"}


@pytest.mark.exhaust
def test_load_against_n() -> None:
    forms = [patents_form(), *our_forms().values()]
    figure = load_figure(
        {form.name: least_time_of(form, PATENT) for form in forms}, {1: ["16.7"], 5: ["4.1"]}, range(1, 21)
    )
    assert flaws(figure) == []
    curves = [line for line in figure.axes[0].lines if len(line.get_xdata()) == 20]
    for form, curve in zip(forms, curves, strict=True):
        costs = least_time_of(form, PATENT)
        expected = [100 * float(utilization(costs, Timing(n, 0, n), Fraction(1))) for n in range(1, 21)]
        assert list(curve.get_ydata()) == expected
    rings = [(line.get_xdata()[0], line.get_ydata()[0]) for line in figure.axes[0].lines if line.get_markersize() == 9]
    assert rings == [(1, 16.7), (5, 4.1)]
    assert {"printed: 16.7 %", "printed: 4.1 %"} <= {text.get_text() for text, _ in texts(figure)}


def test_the_rate_axis_is_the_inverse_of_the_load() -> None:
    figure = load_figure({"patent": least_time_of(patents_form(), PATENT)}, {}, range(1, 21))
    loads, rates = figure.axes[:2]
    assert loads.get_ylim() == rates.get_ylim()
    texts(figure)  # draws it
    labels = {label.get_text(): label.get_position()[1] for label in rates.get_yticklabels()}
    assert labels["50"] == pytest.approx(2)


@pytest.mark.parametrize("spread", [0.001, 0.3, 3.0])
def test_steady_state(spread: float) -> None:
    """Alike or far apart, the curves' labels do not cover one another."""

    def curves(count: int, factor: float) -> list[Curve]:
        return [
            Curve(f"{10.0**-number:g}", {n: 1 + factor * spread**number * (n - 1) ** 2 for n in range(1, 21)})
            for number in range(count)
        ]

    families = [
        Family(title, {reading: curves(count, 10.0**row) for row, reading in enumerate(READINGS)})
        for title, count in (("Random walk", 4), ("Tracker", 3), ("Receiver", 3))
    ]
    figure = steady_figure(families, READINGS)
    assert flaws(figure) == []
    first = next(line for line in figure.axes[0].lines if len(line.get_xdata()) == 19)
    assert list(first.get_xdata()) == list(range(2, 21))
    np.testing.assert_allclose(first.get_ydata(), [(n - 1) ** 2 for n in range(2, 21)])


def test_the_start() -> None:
    courses = {n: 1 + 100 * n * np.exp(-np.arange(401.0) / (5 * n)) for n in (2, 5, 10, 20)}
    starts = {n: {steps: 1 + n / (1 + steps) for steps in (0, 10, 60)} for n in courses}
    figure = start_figure(courses, starts)
    assert flaws(figure) == []
    drawn = [line for line in figure.axes[0].lines if len(line.get_xdata()) == 151]
    for line, course in zip(drawn, courses.values(), strict=True):
        np.testing.assert_allclose(line.get_ydata(), course[:151] - 1)
    assert "n = 20, peak 2001 in step 0" in {text.get_text() for text, _ in texts(figure)}


def test_one_loop_overruns_where_two_rates_do_not() -> None:
    """The same work, 82 % of the processor: with covariance and gain in the loop, three of five updates are late."""
    loop, rates = one_loop_panel(TABLE, 5, Fraction(20)), two_rates_panel(TABLE, 5, Fraction(20))
    assert loop.schedule.misses == 6
    assert rates.schedule.misses == 0
    assert list(rates.schedule.achieved) == [4]
    assert loop.schedule.utilization == rates.schedule.utilization == Fraction(5 * 7626 + 166870, 250_000)
    for panel in (loop, rates):
        assert {bar.style for bar in bars(panel.schedule)} == {"SU", "CG"}
    assert flaws(gantt([one_loop_panel(TABLE, 5, Fraction(20)), two_rates_panel(TABLE, 5, Fraction(20))])) == []
