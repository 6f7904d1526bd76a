"""What is told of a figure's curves is what was plotted, where it was plotted."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.figure import Figure

from reports.drawing.dark import themed
from reports.drawing.readout import INTERVALS, MOST_POINTS, plain_text, readout
from reports.drawing.style import METHOD_LINES
from reports.steffes.comparisons import cost_figure
from reports.steffes.figures import achieved_figure, least_speed_figure
from sched_sim.costs.table_file import load_costs
from sched_sim.design.least_speed import achieved_l, staircase
from sched_sim.design.methods import select
from sched_sim.design.timing import Timing

COSTS = load_costs("steffes2014")


def curve(plot: dict, name: str) -> dict:  # type: ignore[type-arg]
    (line,) = [line for line in plot["lines"] if line["name"] == name]
    return {**line, "x": plot["columns"][line["x"]], "y": plot["columns"][line["y"]]}


def test_least_speeds_are_those_of_the_staircase() -> None:
    told = readout(least_speed_figure(COSTS))
    assert told is not None
    for plot, (N, M) in zip(told["plots"], ((10, 4), (100, 10)), strict=True):
        assert plot["title"] == f"N = {N}, M = {M}"
        assert plot["x"]["name"] == "L asked for (high-rate steps after k)"
        assert plot["y"]["name"] == "least speed (standard steps per HR period)"
        assert plot["y"]["scale"] == "log"
        stairs, line = staircase(select(COSTS, "dual-rate"), N, M), curve(plot, "Dual-rate")
        assert line["x"] == [stair.L for stair in stairs]
        assert line["y"] == pytest.approx([float(stair.speed) for stair in stairs], rel=1e-3)
        assert line["colour"] == themed(METHOD_LINES["dual-rate"].colour)
        assert set(curve(plot, "Recalculate")["y"]) == {{4: 2.81, 10: 5.51}[M]}


def test_a_step_of_a_staircase_is_told_where_it_begins() -> None:
    told = readout(achieved_figure(COSTS))
    assert told is not None
    line, costs = curve(told["plots"][0], "Dual-rate"), select(COSTS, "dual-rate")
    assert line["step"]
    assert line["y"] == [10, 9, 8, 7, 6, 5, 5]
    for speed, L in [*zip(line["x"], line["y"], strict=True)][1:]:
        assert achieved_l(costs, Timing(10, 4, 10), f"{speed:.4f}") in (L, L + 1)  # the speed is told to four digits


def test_a_marker_is_told_where_there_is_one() -> None:
    axes = (figure := Figure()).add_subplot()
    axes.plot([0, 1], [0, 1], "^-", label="signs")
    axes.plot([0, 1], [1, 0], label="none")
    told = readout(figure)
    assert told is not None
    assert [line.get("marker") for line in told["plots"][0]["lines"]] == ["^", None]


def test_what_has_no_name_is_not_told() -> None:
    figure = Figure()
    figure.add_subplot().plot([0, 1], [0, 1])
    assert readout(figure) is None


@given(st.lists(st.floats(-1e6, 1e6), min_size=2, max_size=3 * MOST_POINTS), st.sampled_from(["linear", "log"]))
def test_curves_are_thinned_and_their_ends_and_values_kept(values: list[float], scale: str) -> None:
    axes = (figure := Figure()).add_subplot()
    axes.plot(np.arange(len(values)), values, label="curve")
    axes.set(xscale="linear", yscale="linear" if min(values) <= 0 else scale, xlim=(-1, len(values)))
    told = readout(figure)
    assert told is not None
    line = curve(told["plots"][0], "curve")
    assert len(line["x"]) == min(len(values), MOST_POINTS)
    assert (line["x"][0], line["x"][-1]) == (0, len(values) - 1)
    assert line["y"] == pytest.approx([values[x] for x in line["x"]], rel=1e-3, abs=1e-12)


def test_points_outside_the_axes_and_gaps_are_not_told() -> None:
    axes = (figure := Figure()).add_subplot()
    axes.plot([0, 1, 2, 3, 4], [0, np.nan, 2, 30, 4], label="curve")
    axes.set(xlim=(0.5, 4), ylim=(0, 10))
    told = readout(figure)
    assert told is not None
    assert curve(told["plots"][0], "curve")["x"] == [2, 4]


def test_numbers_of_another_kind_are_told_in_the_words_of_the_axis() -> None:
    axes = (figure := Figure()).add_subplot()
    axes.plot([2, 10], [1, 2], label="curve")
    axes.fmt_xdata = lambda gap: f"{100 * (1 - 1 / gap):g}"
    told = readout(figure)
    assert told is not None
    (plot,) = told["plots"]
    assert plot["columns"][plot["lines"][0]["said"]["x"]] == ["50", "90"]


def test_an_axis_of_another_scale_is_told_by_the_values_at_even_places() -> None:
    axes = (figure := Figure()).add_subplot()
    axes.plot([0, 1], [0, 100], label="curve")
    axes.set_yscale("function", functions=(lambda share: np.sqrt(np.maximum(share, 0)), np.square))
    axes.set_ylim(0, 100)
    told = readout(figure)
    assert told is not None
    places = told["plots"][0]["y"]["places"]
    assert places == pytest.approx([100 * (place / INTERVALS) ** 2 for place in range(INTERVALS + 1)], rel=1e-3)
    assert all(low < high for low, high in pairwise(places))


@pytest.mark.parametrize(
    ("label", "said"),
    [
        ("$L$ asked for", "L asked for"),
        (r"Tracker, by $\sqrt{q\,\Delta T^3/R}$", "Tracker, by √(q ΔT³/R)"),
        (r"costs 3 \$", "costs 3 $"),
        ("Dual-rate, $Q'$ or $Q''$", "Dual-rate, Q′ or Q″"),
        (r"$\hat{x}_{k^+}$", "x(k⁺)"),
        (r"$Q_{k-N\to k}$ in $P_{k^-}$", "Q(k \N{MINUS SIGN} N → k) in P(k⁻)"),
        ("$l - k$ (high-rate steps)", "l \N{MINUS SIGN} k (high-rate steps)"),
        ("lands at $l = m = k+4$", "lands at l = m = k + 4"),
        ("no formula", "no formula"),
    ],
)
def test_a_label_without_its_formula_signs(label: str, said: str) -> None:
    assert plain_text(label) == said


def test_dots_tell_their_row() -> None:
    told = readout(cost_figure({"printed": COSTS, "counted": COSTS}))
    assert told is not None
    (plot,) = told["plots"]
    assert (plot["x"]["name"], plot["y"]["name"]) == ("cost (standard filter's propagate + update = 1)", "")
    rows = {
        (line["name"], plot["columns"][line["said"]["y"]][0]): plot["columns"][line["x"]][0] for line in plot["lines"]
    }
    assert rows["printed", "Dual-rate, LR update"] == rows["counted", "Dual-rate, LR update"] == 0.56
    assert rows["printed", "Larsen, update"] == pytest.approx(0.81)


def test_a_name_that_stands_at_one_plot_is_that_of_all() -> None:
    figure = Figure()
    left, right = figure.subplots(1, 2)
    for axes in (left, right):
        axes.plot([0, 1], [0, 1], label="curve")
    left.set_xlabel("speed")
    left.set_ylabel("l")
    told = readout(figure)
    assert told is not None
    assert [(plot["x"]["name"], plot["y"]["name"]) for plot in told["plots"]] == [("speed", "l"), ("speed", "l")]
