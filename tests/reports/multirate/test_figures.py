"""Figures on the multirate gain: their numbers are those they were given, and they can be read."""

from __future__ import annotations

from fractions import Fraction
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from reports.charts.chart import gantt
from reports.drawing.sheet import sheet
from reports.drawing.style import drawing
from reports.multirate.costs import least_period, least_time_of, our_forms, patents_form
from reports.multirate.gain_figure import gain_figure
from reports.multirate.lead_figure import lead_figure
from reports.multirate.limit_figure import limit_figure
from reports.multirate.load_figure import Printed, load_figure
from reports.multirate.ratio_axis import ratio_axis
from reports.multirate.results import Course
from reports.multirate.schedule import RATES_HZ, frames_over_rate, one_loop_panel, schedule_rows, two_rates_panel
from reports.multirate.start_figure import start_figure
from reports.multirate.steady_figures import Point, readings_figure, rule_figure
from reports.multirate.styles import FAMILY_LINES, FORM_LINES, PERIOD_LINES, READING_LINES, VEHICLE_LINES
from reports.multirate.words import EACH_GAIN, READING_NAMES
from sched_sim.design.load import utilization
from sched_sim.design.timing import Timing
from sched_sim.processors.part import on_part
from sched_sim.processors.part_file import load_part
from sched_sim.schedule.intervals import bars
from studies.multirate.accuracy import READINGS
from studies.multirate.limit import Tending
from tests.reports.layout import flaws, texts

PATENT = load_part("patent")
TABLE = on_part(patents_form().table, PATENT)
COSTS = least_time_of(patents_form(), PATENT)


def curve(axes: Axes, name: str) -> Line2D:
    return next(line for line in axes.lines if line.get_label() == name)


def load(n: int) -> Fraction:
    return 100 * utilization(COSTS, Timing(n, 0, n), Fraction(1))


@pytest.mark.parametrize("lines", [VEHICLE_LINES, READING_LINES, PERIOD_LINES, FAMILY_LINES])
def test_what_is_told_apart_differs_in_colour_marker_and_dashes(lines: dict[str, object]) -> None:
    for attribute in ("colour", "marker") if lines is FAMILY_LINES else ("colour", "marker", "dashes"):
        values = [getattr(line, attribute) for line in lines.values()]
        assert len(set(values)) == len(values), attribute


def test_forms_differ_in_colour_and_marker() -> None:
    assert len({(line.colour, line.marker) for line in FORM_LINES}) == len(FORM_LINES)


SPEEDS = {"calm": 0.003, "road": 0.03, "aircraft": 0.2}
RATIOS = {name: {n: 1 + speed * (n - 1) ** 2 for n in range(1, 11)} for name, speed in SPEEDS.items()}


@cache
def lead() -> Figure:
    return lead_figure(COSTS, {1: "16.7", 5: "4.1"}, 4, RATIOS)


def test_the_answer_for_a_phone_says_the_same() -> None:
    narrow = lead_figure(COSTS, {1: "16.7", 5: "4.1"}, 4, RATIOS, narrow=True)
    assert flaws(narrow) == []
    assert {text.get_text() for text, _ in texts(narrow)} == {text.get_text() for text, _ in texts(lead())}


def test_the_answer() -> None:
    figure = lead()
    assert flaws(figure) == []
    left, right = figure.axes[:2]
    np.testing.assert_allclose(curve(left, "the patent's counts").get_ydata(), [float(load(n)) for n in range(1, 11)])
    assert float(figure.get_size_inches()[1]) * 25.4 <= 95
    for name, of in RATIOS.items():
        np.testing.assert_allclose(curve(right, name).get_ydata(), [ratio - 1 for n, ratio in of.items() if n > 1])
    rings = [line.get_xydata()[0] for line in (*left.lines, *right.lines) if line.get_markerfacecolor() == "none"]
    np.testing.assert_allclose(rings, [(4, float(load(4))), *((4, of[4] - 1) for of in RATIOS.values())])
    said = {text.get_text() for text, _ in texts(figure)}
    assert {"4.93 %", "×1.03", "×1.27", "×2.80", "as the patent prints it"} <= said


def test_the_patents_counts_look_alike_in_both_figures_of_loads() -> None:
    loads = load_figure(dict.fromkeys(("the patent's counts", "two", "three"), COSTS), 1, [], range(1, 21))
    lines = [curve(figure.axes[0], "the patent's counts") for figure in (lead(), loads)]
    assert len({(line.get_color(), line.get_marker(), line.get_linestyle()) for line in lines}) == 1


@given(st.fractions(Fraction(8, 10), 17, max_denominator=1000))
def test_the_least_period_is_the_least(percent: Fraction) -> None:
    n = least_period(COSTS, percent / 100)
    assert n is not None
    assert load(n) <= percent < load(n - 1)


def test_no_period_is_enough_where_the_state_update_alone_is_too_long() -> None:
    assert least_period(COSTS, COSTS.state_update) is None
    assert least_period(COSTS, Fraction(1)) == 1


@pytest.mark.exhaust
def test_load_against_n() -> None:
    forms = [patents_form(), *our_forms().values()]
    costs = {form.name: least_time_of(form, PATENT) for form in forms}
    printed = [Printed(1, "4.2", " in 4 s"), Printed(1, "16.7", ""), Printed(5, "4.1", "")]
    figure = load_figure(costs, 2, printed, range(1, 21))
    assert flaws(figure) == []
    left, right = figure.axes[:2]
    loads = {
        name: np.array([100 * float(utilization(of, Timing(n, 0, n), Fraction(1))) for n in range(1, 21)])
        for name, of in costs.items()
    }
    for name in list(costs)[:3]:
        np.testing.assert_allclose(curve(left, name).get_ydata(), loads[name])
    for name in ("U-D", "square-root"):
        above = 100 * (loads[name] / loads["conventional, short"] - 1)
        np.testing.assert_allclose(curve(right, name).get_ydata(), above)
    strokes = {(line.get_xdata()[0], line.get_ydata()[0]) for line in left.lines if line.get_marker() == "_"}
    assert strokes == {(1, 4.2), (1, 16.7), (5, 4.1)}


@pytest.mark.parametrize("spread", [0.001, 0.3, 3.0])
def test_three_filters_in_steady_state(spread: float) -> None:
    vehicles = {
        title: {
            reading: {n: 1 + spread**row * 10.0**number * (n - 1) ** 2 for n in range(1, 21)}
            for number, reading in enumerate(READINGS)
        }
        for row, title in enumerate(("Hardly manoeuvres", "On the road", "Aircraft that turns"))
    }
    figure = readings_figure(vehicles, READING_NAMES)
    assert flaws(figure) == []
    drawn = curve(figure.axes[0], READING_NAMES["averaged"])
    np.testing.assert_allclose(drawn.get_ydata(), [(n - 1) ** 2 for n in range(2, 21)])


def test_the_axis_of_ratios_tells_all_as_so_many_times_the_optimum() -> None:
    with drawing():
        figure, [[axes]] = sheet(1, 1, [])
        ratio_axis(axes, 1e4)
        figure.draw_without_rendering()
    names = [tick.get_text() for tick in axes.yaxis.get_ticklabels()]
    np.testing.assert_allclose([float(name[1:].replace(",", "")) for name in names], 1 + np.array(axes.get_yticks()))
    assert names == ["×1.001", "×1.01", "×1.1", "×2", "×10", "×100", "×1,000"]
    assert "within 5 % of the optimum" in {text.get_text() for text in axes.texts}


def test_the_rule() -> None:
    points = {kind: [Point(spent, 1 + spent**2 / 8) for spent in (0.1, 0.5, 3.0)] for kind in FAMILY_LINES}
    figure = rule_figure(points, 0.632)
    assert flaws(figure) == []
    assert figure.axes[0].get_title(loc="left")
    drawn = curve(figure.axes[0], "tracker")
    np.testing.assert_allclose(drawn.get_ydata(), np.square(drawn.get_xdata()) / 8)


def test_the_gain_over_time() -> None:
    courses = {
        title: Course(1 / (1 + np.arange(401.0)), np.full(401, 0.2)) for title in ("Calm", "Road", "An aircraft")
    }
    figure = gain_figure(courses, dict.fromkeys(courses, 33))
    assert flaws(figure) == []
    np.testing.assert_allclose(curve(figure.axes[1], EACH_GAIN).get_ydata(), 1 / (1 + np.arange(101)))
    assert curve(figure.axes[1], f"{READING_NAMES['averaged']}, of every 5th step").get_drawstyle() == "steps-post"


def test_what_many_measurements_tend_to() -> None:
    more = [Tending(n, 5 / n, 1 - 0.7 / n, 0.3, 0.3 / n**0.2, 1.0, 1.0) for n in (1, 2, 5, 10, 20, 50, 100)]
    faster = [Tending(5, 1 / hz, 1 - 0.1 / hz, 1 - 0.2 / hz, 0.6, 1.0, 1.0) for hz in (0.5, 1, 2, 5, 10, 20, 50, 100)]
    figure = limit_figure(more, faster)
    assert flaws(figure) == []
    left, right = figure.axes[:2]
    assert list(curve(left, EACH_GAIN).get_xdata()) == [row.n for row in more]
    np.testing.assert_allclose(curve(right, READING_NAMES["averaged"]).get_ydata(), [row.averaged for row in faster])


def test_the_start() -> None:
    courses = {n: 1 + 100 * n * np.exp(-np.arange(401.0) / (5 * n)) for n in (2, 5, 10, 20)}
    starts = {n: {steps: 1 + n / (1 + steps) for steps in (0, 10, 60)} for n in courses}
    figure = start_figure(courses, starts)
    assert flaws(figure) == []
    drawn = [line for line in figure.axes[0].lines if len(line.get_xdata()) == 151]
    for line, course in zip(drawn, courses.values(), strict=True):
        np.testing.assert_allclose(line.get_ydata(), course[:151] - 1)
    assert "$n$ = 20, peak 2001 in step 0" in {text.get_text() for text, _ in texts(figure)}


def test_one_loop_overruns_where_two_rates_do_not() -> None:
    """The same work, 82 % of the processor: with covariance and gain in the loop, three of five updates are late."""
    loop, rates = one_loop_panel(TABLE, 5, Fraction(20)), two_rates_panel(TABLE, 5, Fraction(20))
    assert loop.schedule.misses == 3
    assert rates.schedule.misses == 0
    assert list(rates.schedule.achieved) == [4]
    assert loop.schedule.utilization == rates.schedule.utilization == Fraction(5 * 7626 + 166870, 250_000)
    for panel in (loop, rates):
        assert {bar.style for bar in bars(panel.schedule)} == {"SU", "CG"}


def test_at_each_rate_of_the_slider_the_label_says_who_is_late() -> None:
    """One loop where a state update and a gain do not fit a step, two rates where the processor is not enough."""
    frames = frames_over_rate(TABLE, 5)
    assert len(frames) <= 12
    assert Fraction(20) in RATES_HZ
    for hz, (label, panels) in zip(RATES_HZ, frames, strict=True):
        loop, rates = (panel.schedule.misses for panel in panels)
        assert (loop > 0) == (hz * (COSTS.state_update + COSTS.covariance_gain) > 1)
        assert (rates > 0) == (hz * load(5) / 100 > 1)
        late = f"one loop misses {loop}, two rates {rates or 'none'}" if loop or rates else "neither misses a deadline"
        assert label == f"{float(hz):g} Hz: {late}"
        assert len(label) <= 40


@given(st.integers(1, 12), st.fractions(1, 12, max_denominator=20))
def test_one_loop_bears_no_higher_rate_however_seldom_a_gain_comes(n: int, hz: Fraction) -> None:
    fits = hz * (COSTS.state_update + COSTS.covariance_gain) <= 1
    assert (one_loop_panel(TABLE, n, hz, cycles=2).schedule.misses == 0) == fits


def test_the_rows_of_the_schedules_are_all_the_work() -> None:
    panels = [one_loop_panel(TABLE, 5, Fraction(20)), two_rates_panel(TABLE, 5, Fraction(20))]
    _, *pieces = schedule_rows(panels, Fraction(20))
    for panel in panels:
        of = [piece for piece in pieces if piece[0] == panel.title]
        assert sum(float(piece[5]) - float(piece[4]) for piece in of) == pytest.approx(5 * 7.626 + 166.87)
    assert {piece[0] for piece in pieces if piece[-1] == "yes"} == {"One loop"}


def test_each_label_of_both_schedules_stands_in_its_block() -> None:
    figure = gantt([one_loop_panel(TABLE, 5, Fraction(20)), two_rates_panel(TABLE, 5, Fraction(20))])
    assert flaws(figure) == []
    for axes in figure.axes:
        blocks = [path.get_extents() for group in axes.collections for path in group.get_paths()]
        for text in axes.texts:
            if text.get_text() in ("SU", "CG"):
                x, y = text.get_position()
                assert any(block.x0 <= x <= block.x1 and block.y0 <= y <= block.y1 for block in blocks)
