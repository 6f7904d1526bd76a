"""Figures on modular filters: their numbers are those they were given, and they can be read."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from filters.arrays import FloatArray
from reports.modular.costs import MEDIAN, OPERATIONS, SECONDS, cost_figure
from reports.modular.late import late_figure
from reports.modular.oscillator import (
    NOISES,
    OSCILLATOR_AMPLITUDES,
    QUANTITIES,
    SENSORS,
    UNITS,
    dropout_figure,
    history_figure,
    nees_figure,
    rate_figure,
)
from reports.modular.rocket import DROPOUTS, HALVES, SHOWN, flight_figure, residual_figure
from reports.modular.rocket import nees_figure as rocket_nees_figure
from tests.reports.layout import flaws, texts


def curves(figure: Figure, axes: int, points: int) -> list[FloatArray]:
    """The lines of so many points in one of the plots, each (2, points); signs alone are none."""
    lines = [line for line in figure.axes[axes].lines if line.get_linestyle() != "None"]
    return [np.array(line.get_data(), dtype=float) for line in lines if len(line.get_xdata()) == points]


def run(samples: int = 301) -> dict[str, FloatArray]:
    """An oscillation with constant errors, every other measurement lost."""
    time_s = np.arange(samples) / 50
    columns = {"time_s": time_s}
    for name, error in zip(QUANTITIES, (0.02, 0.1, 0.5), strict=True):
        truth = OSCILLATOR_AMPLITUDES[name] * np.sin(3 * time_s)
        columns |= {f"{name} true": truth, f"{name} estimate": truth + error, f"{name} sigma": np.full(samples, error)}
        columns[f"{name} measured"] = np.where(np.arange(samples) % 2, np.nan, truth)
    return columns


def dropout_rows(rate: int = 100) -> list[dict[str, str]]:
    """Errors in proportion to the time between measurements."""
    found = []
    for dropout in (0.0, 0.1, 0.5, 0.8, 0.99):
        gap = 1 / (1 - dropout)
        row = {"dropout": str(dropout), "interval": str(gap / rate), "still": "0.6", "nees": "2.5"}
        for what, names in (("error", QUANTITIES), ("innovation", SENSORS), ("after", SENSORS)):
            for name in names:
                ends = {"": 0.1, "low ": 0.09, "high ": 0.12}
                row |= {f"{what} {end}{UNITS[name]}": str(factor * gap) for end, factor in ends.items()}
        found.append(row)
    return found


def test_a_run() -> None:
    columns = run()
    figure = history_figure(columns, 6.0)
    assert flaws(figure) == []
    for row, error in enumerate((0.02, 0.1, 0.5)):
        estimate, truth = curves(figure, 2 * row, 301)
        np.testing.assert_allclose(estimate[1], truth[1] + error)
        (drawn,) = curves(figure, 2 * row + 1, 301)
        np.testing.assert_allclose(drawn, [columns["time_s"], np.full(301, error)])


def test_residuals_against_dropout() -> None:
    figure = dropout_figure(dropout_rows())
    assert flaws(figure) == []
    gaps = np.array([1 / 0.9, 2, 5, 100])
    errors = curves(figure, 0, 4)
    assert len(errors) == 3
    for (across, up), amplitude in zip(errors, OSCILLATOR_AMPLITUDES.values(), strict=True):
        np.testing.assert_allclose(across, gaps)
        np.testing.assert_allclose(up, 10 * gaps / amplitude)
    (bars, *_) = (drawn for drawn in figure.axes[0].collections if isinstance(drawn, LineCollection))
    for (low, high), gap in zip(bars.get_segments(), gaps, strict=True):
        np.testing.assert_allclose([low[1], high[1]], [9 * gap, 12 * gap])  # of the position, whose amplitude is 1
    for axes in (1, 2):
        for (_, up), noise in zip(curves(figure, axes, 4), NOISES.values(), strict=True):
            np.testing.assert_allclose(up, 0.1 * gaps / noise)
    shown = [text.get_text() for text, _ in texts(figure)]
    assert [name for name in ("10", "50", "80", "90", "95", "98", "99") if name not in shown] == []


def test_sampling_rates_lie_on_one_curve_against_the_gap() -> None:
    figure = rate_figure({50: dropout_rows(50), 200: dropout_rows(200)}, 0.11)
    assert flaws(figure) == []
    (slow, fast) = curves(figure, 1, 4)
    np.testing.assert_allclose(slow[0], 4 * fast[0])
    np.testing.assert_allclose(slow[1], fast[1])


def test_consistency() -> None:
    time_s = np.linspace(4, 20, 101)
    course = {"time_s": time_s, "usual": np.full(101, 1.7), "own": 3 + 0.5 * np.sin(time_s)}
    bounds = {"50 runs": (2.4, 3.7), "100 runs": (2.5, 3.5)}
    figure = nees_figure(course, bounds, {"usual": dropout_rows(), "own": dropout_rows()})
    assert flaws(figure) == []
    usual, own = curves(figure, 0, 101)
    np.testing.assert_allclose([usual[1], own[1]], [course["usual"], course["own"]])
    for _, up in curves(figure, 1, 4):
        assert up == pytest.approx([2.5] * 4)
    assert "95 % bounds, 50 runs" in {text.get_text() for text, _ in texts(figure)}


def test_a_flight() -> None:
    time_s = np.linspace(-1, 22, 231)
    columns = {"time_s": time_s}
    for name in SHOWN:
        truth = 100 * np.maximum(time_s, 0)
        columns |= {f"{name} true": truth, f"{name} estimate": truth + 0.3, f"{name} error": np.full(231, 0.3)}
        columns[f"{name} sigma"] = np.full(231, 0.2)
    figure = flight_figure(columns, 3.5)
    assert flaws(figure) == []
    for row in range(len(SHOWN)):
        estimate, truth = curves(figure, 2 * row, 231)
        np.testing.assert_allclose(estimate[1] - truth[1], 0.3)
        (error,) = curves(figure, 2 * row + 1, 231)
        np.testing.assert_allclose(error[1], 0.3)


def test_readings_of_the_claim_over_time() -> None:
    time_s = np.geomspace(0.1, 22, 70)
    readings = [f"reading {number} / what it is of" for number in range(4)]
    columns = {"time_s": time_s}
    for number, reading in enumerate(readings):
        for dropout in DROPOUTS:
            columns |= {f"{reading}, {dropout}, {half}": (number + 1) / time_s for half in HALVES}
    figure = residual_figure(columns, readings)
    assert flaws(figure) == []
    for number in range(4):
        drawn = curves(figure, number, 70)
        assert len(drawn) == len(DROPOUTS) * len(HALVES)
        for curve in drawn:
            np.testing.assert_allclose(curve, [time_s, (number + 1) / time_s])
    assert {"Reading 0 over what it is of", "15 %"} <= {text.get_text() for text, _ in texts(figure)}


def test_consistency_of_the_rocket() -> None:
    time_s = np.linspace(-0.5, 22, 450)
    course = {"time_s": time_s, **{dropout: np.full(450, 15.0 + at) for at, dropout in enumerate(DROPOUTS)}}
    phases = {name: [(3.0, 0.5)] * 5 for name in ("on the pad", "thrust onset", "powered", "burnout", "coast")}
    figure = rocket_nees_figure(course, phases, (13.1, 17.0), (2.2, 3.9))
    assert flaws(figure) == []
    assert [curve[1][0] for curve in curves(figure, 0, 450)] == [15, 16, 17, 18]


def test_late_measurements() -> None:
    ways = {"recalculate": 2, "larsen": 2, "dual-rate": 4, "fuse-as-fresh": 8}
    rows = [
        {"way": way, "delay": str(delay), "error": str(0.01 * factor), "se": "0.001", "longest": str(100 * factor)}
        for way, factor in ways.items()
        for delay in (0, 5, 10)
    ]
    figure = late_figure({"position": rows, "position and acceleration": rows[:6]})
    assert flaws(figure) == []
    assert [curve[1][0] for curve in curves(figure, 0, 3)] == pytest.approx([2, 2, 4, 8])
    assert [curve[1][0] for curve in curves(figure, 2, 3)] == [200, 200, 400, 800]
    assert len(curves(figure, 1, 3)) == 2


def test_costs_of_parts() -> None:
    rows = [
        {
            "kind": kind,
            "part": part,
            "states": str(n),
            OPERATIONS: str(10 * n**3 * factor),
            SECONDS: str(0.02 * factor),
            MEDIAN: str(0.03 * factor),
        }
        for factor, kind in enumerate(("linear", "extended", "unscented"), start=1)
        for part in ("predict", "correct")
        for n in (3, 9)
    ]
    figure = cost_figure(rows)
    assert flaws(figure) == []
    for axes in (0, 1):
        assert [curve[1][0] for curve in curves(figure, axes, 2)] == [270, 540, 810]
    for axes in (2, 3):
        assert [curve[1][0] for curve in curves(figure, axes, 2)] == pytest.approx([0.02, 0.04, 0.06])
        ranges = [lines for lines in figure.axes[axes].collections if isinstance(lines, LineCollection)]
        (segments,) = (np.array(lines.get_segments()) for lines in ranges[:1])
        np.testing.assert_allclose(segments, [[(3, 0.02), (3, 0.03)]])
        assert len(ranges) == 6
