"""Plots: their numbers are those of the analysis, and they can be read."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from reports.drawing.style import METHOD_LINES, SOURCES
from reports.steffes.comparisons import cost_figure, cost_rows
from reports.steffes.curves import achieved_curve, hr_limit, knee, speed_grid
from reports.steffes.figures import achieved_figure, least_speed_figure
from reports.steffes.signs import shown
from sched_sim.costs.table import Cost, CostTable
from sched_sim.costs.table_file import load_costs
from sched_sim.design.least_speed import achieved_l, least_speed, staircase
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.pieces import DualRateCosts
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from tests.designs import Design, designs
from tests.reports.layout import contrast_of, flaws, texts

PAPER, COUNTED = load_costs("steffes2014"), load_costs("counted-9-3-3")
DUAL_RATE = select(PAPER, "dual-rate", Options())
BLUE = METHOD_LINES["dual-rate"].colour
SAME_STEP = Options(feedback="same-step", lr_propagate_by="l")


def test_the_knee_of_the_papers_last_case_is_29() -> None:
    found = knee(staircase(DUAL_RATE, 100, 10))
    assert found is not None
    assert (float(found.speed), found.achieved, found.latest) == (0.66, 29, 100)
    assert knee(staircase(DUAL_RATE, 10, 4)) is None
    assert knee([]) is None


def test_the_knee_is_where_the_plotted_curve_becomes_flat() -> None:
    figure = least_speed_figure(PAPER)
    curves = [line for line in figure.axes[1].lines if line.get_color() == BLUE and len(line.get_xdata()) > 1]
    asked, speeds = curves[0].get_xdata(), curves[0].get_ydata()
    assert min(L for L, speed in zip(asked, speeds, strict=True) if speed == min(speeds)) == 29
    assert [list(asked), list(speeds)] == [
        list(range(11, 101)),
        [float(least_speed(DUAL_RATE, Timing(100, 10, L)).speed) for L in range(11, 101)],
    ]
    said = " ".join(text.get_text() for text, _ in texts(figure))
    assert "0.66 already lands at L = 29" in said
    for constant in ("2.81", "5.51", "1.47"):
        assert constant in said


def test_the_achieved_curve_starts_at_the_knee() -> None:
    (curve,) = [
        line for line in achieved_figure(PAPER).axes[1].lines if line.get_color() == BLUE and len(line.get_xdata()) > 1
    ]
    assert (curve.get_xdata()[0], curve.get_ydata()[0]) == (0.66, 29)
    assert min(curve.get_ydata()) == 11


@settings(max_examples=60)
@given(designs, st.lists(st.fractions(Fraction(1, 4), 3, max_denominator=20), min_size=1, max_size=5))
def test_the_achieved_curve_is_the_analysis_at_each_speed(design: Design, factors: list[Fraction]) -> None:
    least = least_speed(*design).speed
    speeds = [least * factor for factor in factors]
    N, M = design.timing.N, design.timing.M
    expected = [achieved_l(design.costs, design.timing, speed, design.options) for speed in speeds]
    assert achieved_curve(design.costs, N, M, speeds, design.options) == expected


@settings(max_examples=60)
@given(designs)
def test_below_the_hatched_limit_the_hr_loop_overruns(design: Design) -> None:
    if not isinstance(design.costs, DualRateCosts):
        return
    limit = Fraction(hr_limit(design.costs, design.timing.N, design.options))
    slower = limit - Fraction(1, 1000)
    schedule = simulate(design.costs, design.timing, slower, 3, design.options)
    lands = achieved_l(design.costs, design.timing, slower, design.options)
    assert lands is None or lands == 1 or schedule.responses["hr"].misses > 0


def test_a_speed_grid_holds_what_it_must() -> None:
    grid = speed_grid(0.5, 2, 5, [Fraction(2, 3)])
    assert grid == sorted(grid)
    assert Fraction(2, 3) in grid
    assert (grid[0], grid[-1]) == (Fraction(1, 2), 2)


@pytest.mark.parametrize("draw", [least_speed_figure, achieved_figure])
@pytest.mark.parametrize(
    ("table", "plots", "options"),
    [
        (PAPER, [(10, 4), (100, 10)], Options()),
        (COUNTED, [(10, 4), (100, 10)], Options()),
        (PAPER, [(10, 1), (30, 0)], SAME_STEP),
        (PAPER, [(10, 10), (1, 0)], Options()),
        (PAPER, [(20, 3)], Options(cpus=2)),
    ],
)
def test_plots_can_be_read(draw, table, plots, options) -> None:
    assert flaws(draw(table, plots, options)) == []


def test_costs_of_several_tables_beside_one_another() -> None:
    figure = cost_figure({"printed": PAPER, "counted": COUNTED})
    assert flaws(figure) == []
    shown = {float(line.get_xdata()[0]) for line in figure.axes[0].lines if line.get_marker() in "|o"}
    assert {0.45, 0.66, 0.81, 0.63, 0.04, 0.03, 0.41, 0.56} <= shown
    assert "HR propagate, $Q'$" not in [text.get_text() for text, _ in texts(figure)]  # the paper has no such cost


def test_one_table_shows_all_its_jobs_and_the_range_of_the_least_over_all_measurements() -> None:
    larsen = {**COUNTED.costs["larsen"], "update": Cost(Fraction(6000), Fraction(8000), Fraction(20000))}
    slower = replace(COUNTED, costs={**COUNTED.costs, "larsen": larsen})
    figure = cost_figure({"measured": COUNTED}, [COUNTED, slower])
    assert flaws(figure) == []
    ends = [float(table.normalised().entry("larsen", "update").minimum) for table in (COUNTED, slower)]
    bars = [(bar.get_x(), bar.get_x() + bar.get_width()) for bar in figure.axes[0].patches]
    assert bars == [pytest.approx(ends)]
    assert not cost_figure({"measured": slower}).axes[0].patches


def test_each_cost_that_is_drawn_is_listed() -> None:
    tables = {"printed": PAPER, "counted": COUNTED}
    heading, *rows = cost_rows(tables, [COUNTED])
    assert heading == ["Method", "Job", "printed", "counted", "all measurements †"]
    for column, source in enumerate(tables, start=2):
        drawn = [line for line in cost_figure(tables).axes[0].lines if line.get_label() == source]
        assert [row[column] for row in rows if row[column]] == [f"{line.get_xdata()[0]:.3f}" for line in drawn]


def test_bars_stand_out_from_the_page() -> None:
    """By their fill, or by their edge if that is pale."""
    slower = replace(COUNTED, costs={**COUNTED.costs, "larsen": {**COUNTED.costs["larsen"], "update": Cost.of(9000)}})
    bars = cost_figure({"measured": COUNTED}, [COUNTED, slower]).axes[0].patches
    assert bars
    assert min(map(contrast_of, bars)) >= 3


def test_a_job_that_an_earlier_measurement_lacks_has_the_range_of_those_that_timed_it() -> None:
    larsen = {kind: cost for kind, cost in COUNTED.costs["larsen"].items() if kind != "update"}
    earlier = replace(COUNTED, costs={**COUNTED.costs, "larsen": larsen})
    assert flaws(cost_figure({"measured": COUNTED}, [earlier])) == []
    assert not cost_figure({"measured": COUNTED}, [COUNTED, earlier]).axes[0].patches


def test_a_source_has_the_same_sign_in_every_figure_and_a_dagger_if_measured() -> None:
    """By its name, whatever its place."""
    for tables in (
        {"counted": COUNTED, "measured": COUNTED},
        {"measured": COUNTED, "printed": PAPER, "counted": COUNTED},
    ):
        lines = [line for line in cost_figure(tables).axes[0].lines if not str(line.get_label()).startswith("_")]
        looks = {line.get_label(): (line.get_marker(), line.get_color()) for line in lines}
        assert looks == {shown(source): (SOURCES[source].marker, SOURCES[source].colour) for source in tables}
        assert "measured †" in looks


@pytest.mark.parametrize("tables", [{}, {"printed": PAPER, "guessed": PAPER}])
def test_a_source_without_a_sign_is_refused(tables: dict[str, CostTable]) -> None:
    with pytest.raises(InputError, match=r"sources of numbers .*: give some of 'printed'"):
        cost_figure(tables)
