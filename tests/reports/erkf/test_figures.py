"""Figures on the robust filter: their numbers are those they were given, and they can be read."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from filters.arrays import FloatArray
from reports.charts.chart import gantt
from reports.erkf.cost_figure import Way, cost_figure
from reports.erkf.drive import (
    attitude_figure,
    errors_figure,
    position_figure,
    route_figure,
    windowed_rms,
    wrapped_deg,
)
from reports.erkf.parallel import parallel_figure
from reports.erkf.schedule import millions, one_period, speed_figure, two_rates
from reports.erkf.singular import WAYS, singular_figure
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


def test_costs() -> None:
    ways = [
        Way(
            "inverse: N eliminations, as in the paper",
            {"attitude": 200_000, "position": 600_000},
            {"attitude": (2e-5, 2e-5), "position": (5e-5, 7e-5)},
        ),
        Way("closed form", {"attitude": 1_900, "position": 3_500}),
    ]
    figure = cost_figure(ways, 1 / 400)
    assert flaws(figure) == []
    assert [(x[0], y[0]) for x, y in curves(figure, 0, 1)] == [(2e5, 1), (6e5, 1), (1900, 2), (3500, 2)]
    assert [x[0] for x, _ in curves(figure, 1, 1)] == pytest.approx([20, 50])
    (until,) = (lines for lines in figure.axes[1].collections if isinstance(lines, LineCollection))
    np.testing.assert_allclose(until.get_segments(), [[(50, 1), (70, 1)]])
    assert {"closed form", "Compiled code †", "one step at 400 Hz"} <= {text.get_text() for text, _ in texts(figure)}


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
    figure = speed_figure({"Attitude": {"one": COSTS}, "Position": {"one": COSTS}}, 40, 400)
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
