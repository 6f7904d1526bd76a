"""Figures on modular filters: their numbers are those they were given, and they can be read."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from filters.arrays import FloatArray
from reports.drawing.legend import _lines, line_entry
from reports.drawing.sheet import LEFT_MM, RIGHT_MM
from reports.drawing.style import METHOD_LINES, WIDTH_MM
from reports.modular.costs import OPERATIONS, cost_figure
from reports.modular.future import covariance_figure, stiffness_figure
from reports.modular.gap import gap_figure
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
)
from reports.modular.residual_time import HIGH, UNIT_M, residual_time_figure
from reports.modular.rocket import DROPOUTS, HALVES, SHOWN, flight_figure, phase_figure, residual_figure
from reports.modular.rocket import nees_figure as rocket_nees_figure
from reports.modular.styles import DROPOUT_LINES, KIND_LINES, QUANTITY_LINES, WAY_LINES, apart
from studies.machines.parts import Micros, PartTimes
from tests.reports.explorer.test_palette import contrast
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


def test_sampling_rates_against_what_gets_through_and_80_percent_dropout_has_a_ring() -> None:
    figure = gap_figure({50: dropout_rows(50), 200: dropout_rows(200)}, 20.0)
    assert flaws(figure) == []
    (slow, fast) = curves(figure, 0, 5)
    np.testing.assert_allclose(slow[0], np.multiply(50, (1, 0.9, 0.5, 0.2, 0.01)))
    np.testing.assert_allclose(fast[0], 4 * slow[0])
    np.testing.assert_allclose(slow[1], fast[1])
    rings = [line for line in figure.axes[0].lines if line.get_markerfacecolor() == "none"]
    assert [float(ring.get_xdata()[0]) for ring in rings] == pytest.approx([10, 40])
    assert [float(ring.get_ydata()[0]) for ring in rings] == pytest.approx([slow[1][3]] * 2)
    assert "one measurement: 5 %" in {text.get_text() for text, _ in texts(figure)}


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
    figure = rocket_nees_figure(course, (13.1, 17.0))
    assert flaws(figure) == []
    assert [curve[1][0] for curve in curves(figure, 0, 450)] == [15, 16, 17, 18]


def test_each_quantity_in_each_phase_of_the_flight() -> None:
    names = ("on the pad", "thrust onset", "powered", "burnout", "coast")
    phases = {name: [(3.0 + at, 0.5)] * 5 for at, name in enumerate(names)}
    figure = phase_figure(phases, (2.2, 3.9))
    assert flaws(figure) == []
    bars = [drawn for drawn in figure.axes[0].collections if isinstance(drawn, LineCollection)]
    ends = [np.array(drawn.get_segments()[0])[:, 1] for drawn in bars]
    np.testing.assert_allclose(ends, [(3.0 + at - 1.0, 3.0 + at + 1.0) for at in range(5) for _ in range(5)])


def test_dropout_and_quantity_never_look_alike() -> None:
    """Nor do the methods, and a way with unscented parts has their sign."""
    looks = [(line.colour, line.marker) for lines in (DROPOUT_LINES, QUANTITY_LINES) for line in lines.values()]
    assert len({colour for colour, _ in looks}) == len({marker for _, marker in looks}) == len(looks)
    assert WAY_LINES["larsen, extended"] == METHOD_LINES["larsen"]
    assert WAY_LINES["recalculate, unscented"].marker == KIND_LINES["unscented"].marker
    assert WAY_LINES["recalculate, unscented"].colour == METHOD_LINES["recalculate"].colour


def test_what_is_drawn_stands_out_from_the_page() -> None:
    for lines in (DROPOUT_LINES, KIND_LINES):
        for line in lines.values():
            assert contrast(line.colour, "#ffffff") >= 3


def test_each_group_of_a_legend_begins_a_line() -> None:
    entries = apart({"one": [line_entry("a", WAY_LINES["larsen, extended"])], "two": [], "three": []})
    lines = _lines(entries, WIDTH_MM - LEFT_MM - RIGHT_MM)
    assert [line[0][1].text for line in lines] == ["one:", "two:", "three:"]


def course_rows(dropouts: tuple[str, ...], windows: int = 20) -> list[dict[str, str]]:
    found = []
    for dropout in dropouts:
        for window in range(windows):
            row = {"dropout": dropout, "runs": "7", "time_s": str(window)}
            for what, factor in (("error", 1.0), ("unlucky", 2.0), ("innovation", 3.0)):
                value = UNIT_M * factor / (1.0 - float(dropout))
                row |= {what: str(value), f"{what} low": str(0.9 * value), f"{what} high": str(1.1 * value)}
            found.append(row)
    return found


def test_residuals_against_time() -> None:
    dropouts = ("0.1", "0.5", "0.8", "0.999")
    time_s = np.linspace(0, 20, 51)
    run = {"time_s": time_s}
    for dropout in dropouts:
        error = UNIT_M / (1.0 - float(dropout)) * np.sin(time_s)
        run |= {f"error {dropout}": 20 * error, f"sigma {dropout}": np.full(51, UNIT_M)}
    figure = residual_time_figure(run, course_rows(dropouts))
    assert flaws(figure) == []
    for row, (dropout, scale) in enumerate(zip(dropouts, (1, 1, 1, 100), strict=True)):
        level = 1.0 / (1.0 - float(dropout))
        (drawn,) = curves(figure, 2 * row, 51)
        np.testing.assert_allclose(drawn[1], 20 * level * np.sin(time_s) / scale)
        of_all = [curve[1][0] for curve in curves(figure, 2 * row + 1, 20)]
        assert of_all == pytest.approx([level, 2 * level, 3 * level])
    assert [figure.axes[2 * row + 1].get_ylim()[1] for row in range(4)] == [HIGH] * 3 + [20_000]
    assert "99.9 % lost, ×100" in {text.get_text() for text, _ in texts(figure)}


def test_errors_with_and_without_the_spring() -> None:
    rows = []
    for dropout in ("0.1", "0.8", "0.99"):
        row = {"dropout": dropout}
        for what, value in (("unaware", 0.05), ("aware", 0.01)):
            row |= {what: str(value), f"{what} low": str(0.8 * value), f"{what} high": str(1.5 * value)}
        rows.append(row)
    figure = stiffness_figure(rows)
    assert flaws(figure) == []
    assert [curve[1][0] for curve in curves(figure, 0, 3)] == pytest.approx([5, 1])


def test_covariances_found() -> None:
    row = {"truth": "one"}
    for part, factor in (("position", 1.0), ("acceleration", 0.5), ("jerk", 2.0)):
        for level, value in (("5 %", 0.9), ("50 %", 1.0), ("95 %", 1.1)):
            row |= {f"{part} {level}{end}": str(factor * value) for end in ("", " low", " high")}
    figure = covariance_figure([row, row | {"truth": "two"}])
    assert flaws(figure) == []
    ranges = [curve[1] for curve in curves(figure, 0, 2)][0:6:2]
    np.testing.assert_allclose(ranges, [(0.9, 1.1), (0.45, 0.55), (1.8, 2.2)])
    assert {"Truth: one", "Truth: two"} <= {text.get_text() for text, _ in texts(figure)}


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


KINDS = ("linear", "extended", "unscented")


def _micros(kind: str, least: float) -> Micros:
    """The second costs twice as much as the first, and the third three times."""
    return Micros(least * (1 + KINDS.index(kind)), 1.0)


def test_costs_of_parts() -> None:
    rows = [
        {
            "kind": kind,
            "part": part,
            "states": str(n),
            OPERATIONS: str(10 * n**3 * factor),
        }
        for factor, kind in enumerate(KINDS, start=1)
        for part in ("predict", "correct")
        for n in (3, 9)
    ]
    measurements = [
        PartTimes({}, {(r["kind"], r["states"], r["part"]): _micros(r["kind"], least) for r in rows})
        for least in (0.03, 0.025, 0.02)
    ]
    figure = cost_figure(rows, measurements)
    assert flaws(figure) == []
    for axes in (0, 1):
        assert [curve[1][0] for curve in curves(figure, axes, 2)] == [270, 540, 810]
    for axes in (2, 3):
        assert [curve[1][0] for curve in curves(figure, axes, 2)] == pytest.approx([0.02, 0.04, 0.06])
        ranges = [lines for lines in figure.axes[axes].collections if isinstance(lines, LineCollection)]
        (segments,) = (np.array(lines.get_segments()) for lines in ranges[:1])
        np.testing.assert_allclose(segments, [[(3, 0.02), (3, 0.03)]])
        assert len(ranges) == 6
