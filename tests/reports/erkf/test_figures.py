"""Figures on the robust filter: their numbers are those they were given, and they can be read."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.path import Path
from matplotlib.text import Annotation

from filters.arrays import FloatArray
from reports.charts.chart import gantt
from reports.drawing.style import SMALL_PT
from reports.erkf import styles
from reports.erkf.cost_figure import Way, cost_figure
from reports.erkf.drive import (
    attitude_figure,
    errors_figure,
    position_figure,
    windowed_rms,
    wrapped_deg,
)
from reports.erkf.parallel import parallel_figure
from reports.erkf.route import HEIGHT_TIMES, projected, route_figure
from reports.erkf.schedule import millions, one_period, speed_figure, two_rates
from reports.erkf.scheme import filters_figure, imu_figure
from reports.erkf.singular import WAYS, singular_figure
from reports.erkf.stability import LEAST, LINES, TITLES, stability_figure
from reports.erkf.ways import Response, response_s, ways_figure
from sched_sim.design.least_speed import least_speed
from sched_sim.design.pieces import RobustCosts
from sched_sim.design.timing import Timing
from sched_sim.schedule.intervals import jobs
from tests.reports.layout import flaws, texts

COSTS = RobustCosts(Fraction(10), Fraction(900))


def curves(figure: Figure, axes: int, points: int) -> list[tuple[list[float], list[float]]]:
    """The lines of so many points in one of the plots."""
    return [
        (list(map(float, line.get_xdata())), list(map(float, line.get_ydata())))
        for line in figure.axes[axes].lines
        if len(line.get_xdata()) == points
    ]


def written(figure: Figure) -> set[str]:
    return {text.get_text() for text, _ in texts(figure)}


def test_costs() -> None:
    ways = [
        Way(
            "inverse: N eliminations, as in the paper",
            {"attitude": 200_000, "position": 600_000},
            {"attitude": (2e-5, 2e-5), "position": (5e-5, 7e-5)},
        ),
        Way("closed form", {"attitude": 1_900, "position": 3_500}),
    ]
    figure = cost_figure(ways, {"attitude": 47, "position": 67}, 1 / 400)
    assert flaws(figure) == []
    signs = curves(figure, 0, 1)
    assert [x[0] for x, _ in signs] == [2e5, 6e5, 1900, 3500]
    (first, same, second, _) = (y[0] for _, y in signs)
    assert first == same < second
    assert [x[0] for x, _ in curves(figure, 1, 1)] == pytest.approx([20, 50])
    (until,) = (lines for lines in figure.axes[1].collections if isinstance(lines, LineCollection))
    np.testing.assert_allclose(until.get_segments(), [[(50, first), (70, first)]])
    assert {"attitude filter, N = 47", "closed form", "Compiled code †", "one step at 400 Hz"} <= {
        text.get_text() for text, _ in texts(figure)
    }


def test_parallel_times() -> None:
    P = [1, 4, 16, 64]
    times = {
        "dense": dict(zip(P, [140_000, 26_000, 8_000, 7_000], strict=True)),
        "sparse": dict(zip(P, [100, 50, 49, 49], strict=True)),
    }
    figure = parallel_figure({"Attitude": times, "Position": times})
    assert flaws(figure) == []
    assert curves(figure, 1, 4) == [(P, list(times["dense"].values())), (P, list(times["sparse"].values()))]
    assert {"20×", "2×"} <= {text.get_text() for text, _ in texts(figure)}


def test_singular_values() -> None:
    """A way that is nan throughout and one that never differs are left out without harm."""
    time_s = np.linspace(0, 100, 401)
    found: dict[str, FloatArray] = {"time_s": time_s}
    for system in ("a", "b"):
        found |= {f"{system} largest": np.exp(-time_s / 9) + 0.1, f"{system} smallest": np.full(401, 1e-5)}
        found |= {f"{system} largest {way}": np.full(401, 1e-14) for way in WAYS}
    found["b largest lu without pivoting"] = np.full(401, np.nan)
    found["b largest lu"] = np.zeros(401)
    figure = singular_figure(found, {"a": "Attitude", "b": "Position"})
    assert flaws(figure) == []
    (_, largest), (_, smallest) = curves(figure, 0, 401)
    np.testing.assert_allclose(largest, found["a largest"])
    np.testing.assert_allclose(smallest, found["a smallest"])
    assert all(line.get_markeredgewidth() > 0 for line in figure.axes[1].lines), "signs are seen without colour"


def course(samples: int = 1000) -> dict[str, FloatArray]:
    """A drive once around, with constant errors."""
    time_s = np.arange(samples) / 10
    turn = 2 * np.pi * time_s / 100
    columns = {"time_s": time_s}
    for what, metres, degrees in (("true", 0.0, 0.0), ("gps", 0.5, 0.3), ("imu", 0.0, 8.0)):
        columns |= {
            f"{what} north": 100 * np.sin(turn) + metres,
            f"{what} east": 100 * (1 - np.cos(turn)) + metres,
            f"{what} up": 0 * turn + metres,
            f"{what} roll": np.sin(turn) + degrees,
            f"{what} pitch": np.cos(turn) + degrees,
            f"{what} yaw": wrapped_deg(np.degrees(turn) + degrees),
        }
    for name, error in (("EKF", 0.2), ("ERKF", 0.1)):
        for scale in ("2 %", "10 %"):
            for side in ("north", "east", "up", "roll", "pitch"):
                columns[f"{name} {scale} {side}"] = columns[f"true {side}"] + error
            columns[f"{name} {scale} yaw"] = wrapped_deg(np.degrees(turn) + error)
    return columns


def test_the_drive() -> None:
    columns = course()
    close_up = {name: values[400:411] for name, values in columns.items()}
    for figure in (
        route_figure(columns, close_up, "2 %"),
        attitude_figure(columns, "10 %"),
        position_figure(columns, "2 %"),
    ):
        assert flaws(figure) == []


def test_the_attitude_has_the_yaw_of_gps_and_of_the_inertial_unit() -> None:
    named = {str(line.get_label()): line for line in attitude_figure(course(), "10 %").axes[2].lines}
    assert {"true", "GPS", "IMU", "EKF", "ERKF"} <= set(named)
    truth = np.asarray(named["true"].get_ydata(), dtype=float)
    np.testing.assert_allclose(np.asarray(named["IMU"].get_ydata(), dtype=float) - truth, 8.0)
    np.testing.assert_allclose(np.asarray(named["GPS"].get_ydata(), dtype=float) - truth[::20], 0.3)


def test_the_route_is_in_three_dimensions() -> None:
    """East and north go different ways on the page, up goes up, and it is said that heights are larger."""
    east, north, up = (projected(*np.transpose([axis]))[:, 0] for axis in np.eye(3))
    assert abs(np.linalg.det([east, north])) > 0.5
    np.testing.assert_array_equal(up, [0.0, HEIGHT_TIMES])
    figure = route_figure(course(), {name: values[400:411] for name, values in course().items()}, "2 %")
    assert {"The route; heights 10 times", "60 m east", "60 m north", "5 m up"} <= written(figure)


def test_the_drawn_figures_can_be_read() -> None:
    for figure in (imu_figure(), filters_figure()):
        assert flaws(figure) == []
    said = " ".join(written(imu_figure()))
    assert all(sign in said for sign in (r"\delta_g", r"\delta_a", "b_g", "b_a", r"\eta_g", r"\eta_a"))


def test_no_arrow_of_the_scheme_runs_through_a_text() -> None:
    figure = filters_figure()
    (axes,) = figure.axes
    pieces = [axes.transData.transform(line.get_xydata()) for line in axes.lines]
    pieces += [
        axes.transData.transform([note.xyann, note.xy])
        for note in axes.texts
        if isinstance(note, Annotation) and not note.get_text()
    ]
    assert len(pieces) > 8
    for text, box in texts(figure):
        for piece in pieces:
            assert not Path(piece).intersects_bbox(box, filled=False), text.get_text()


def test_the_first_figure_can_be_read_on_a_phone_and_two_of_the_drive_fit_on_a_page() -> None:
    """Small letters are more than 6.5 px where a figure is 320 px wide; at print size figures are as high as in mm."""
    found = [Response("position", "Givens", 1e-3)]
    across = ways_figure(found, {"one period": 2.5e-3, "next fix": 0.1}).get_size_inches()[0]
    assert SMALL_PT / 72 / across * 320 > 6.5
    columns = course()
    close_up = {name: values[400:411] for name, values in columns.items()}
    pages = (
        (route_figure(columns, close_up, "2 %"), attitude_figure(columns, "10 %")),
        (position_figure(columns, "2 %"), errors_figure(columns, ["2 %", "10 %"])),
    )
    for figures in pages:
        assert sum(figure.get_size_inches()[1] for figure in figures) * 25.4 < 215


def test_responses_are_bars_that_end_where_the_result_is_there() -> None:
    costs = RobustCosts(Fraction(1, 40_000), Fraction(1, 1000))
    late = RobustCosts(Fraction(1, 40_000), Fraction(4, 1000))
    timing = Timing(40, 0, 40)
    assert response_s(costs, timing, 400) == pytest.approx(1e-3 + 25e-6)
    assert response_s(late, timing, 400) == pytest.approx(4e-3 + 2 * 25e-6)  # the next propagation comes between
    with pytest.raises(ValueError, match="before the next fix"):
        response_s(RobustCosts(Fraction(1, 40_000), Fraction(1)), timing, 400)
    found = [Response(system, "Givens", seconds) for system, seconds in (("attitude", 1e-3), ("position", 4e-3))]
    figure = ways_figure(found, {"one period": 2.5e-3, "next fix": 0.1})
    assert flaws(figure) == []
    bars = [bar for bar in figure.axes[0].patches if isinstance(bar, Rectangle)]
    assert [bar.get_x() + bar.get_width() for bar in bars] == pytest.approx([1.0, 4.0])
    deadlines = {"one period: 2.5 ms", "next fix: 100 ms"}
    assert {"1.00", "4.00", *deadlines} <= written(figure)


def test_stability() -> None:
    steps = np.arange(61.0)
    found: dict[str, FloatArray] = {"step": steps}
    for system in TITLES:
        for name in LINES:
            found |= {f"{system}, {name}: P from {start:g}": start ** (0.9**steps) for start in (1e-2, 1.0, 1e4)}
            found[f"{system}, {name}: apart"] = np.where(0.8**steps >= LEAST, 0.8**steps, np.nan)
    figure = stability_figure(found)
    assert flaws(figure) == []
    assert len(curves(figure, 0, 61)) == 9
    np.testing.assert_allclose(curves(figure, 1, 61)[0][1][:5], 0.8 ** np.arange(5))


def test_what_is_told_apart_looks_different_without_colour() -> None:
    for looks in ([*styles.WAYS.values()], [*styles.FILTERS.values(), styles.LIMIT]):
        assert len({line.marker for line in looks}) == len(looks)


def test_yaw_has_no_jump_where_the_vehicle_has_none() -> None:
    figure = attitude_figure(course(), "10 %")
    for _, yaw in curves(figure, 2, 1000):
        assert np.abs(np.diff(yaw)).max() < 1


def test_position_is_drawn_as_an_error() -> None:
    found = curves(position_figure(course(), "2 %"), 0, 1000)
    np.testing.assert_allclose([found[0][1][0], found[1][1][0]], [0.2, 0.1])


def test_errors_are_root_mean_squares_of_5_s() -> None:
    np.testing.assert_allclose(windowed_rms(np.tile([3.0, -3.0], 60)), [3.0, 3.0])
    figure = errors_figure(course(), ["2 %", "10 %"])
    assert flaws(figure) == []
    for axes in range(6):
        ekf, erkf = curves(figure, axes, 19)
        np.testing.assert_allclose(ekf[1], 0.2, atol=1e-9)
        np.testing.assert_allclose(erkf[1], 0.1, atol=1e-9)


def test_least_speeds() -> None:
    figure = speed_figure({"Attitude": {"Givens": COSTS}, "Position": {"Givens": COSTS}}, 40, 400)
    assert flaws(figure) == []
    ((L, speeds),) = curves(figure, 0, 40)
    assert list(range(1, 41)) == L
    assert speeds == [millions(least_speed(COSTS, Timing(40, 0, L)).speed, 400) for L in range(1, 41)]
    assert speeds[0] == pytest.approx(910 * 400 / 1e6)


def test_in_one_period_the_propagation_misses_what_two_rates_meet() -> None:
    timing = Timing(40, 0, 10)
    speed = least_speed(COSTS, timing).speed
    apart = two_rates(COSTS, timing, speed, "Two rates", "slow")
    together = one_period(COSTS, 40, speed, "In one period", "slow")
    assert list(apart.schedule.achieved) == [10]
    assert [job.deadline for job in jobs(apart.schedule) if job.row.name == "LR"] == [10 * apart.schedule.period]
    assert (apart.schedule.misses, together.schedule.misses) == (0, 9)
    assert flaws(gantt([apart, together])) == []
