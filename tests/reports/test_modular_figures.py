"""Figures on modular filters: their numbers are those they were given, and they can be read."""

from __future__ import annotations

import numpy as np
import pytest
from matplotlib.figure import Figure

from filters.arrays import FloatArray
from reports.modular_oscillator import (
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
                row |= {f"{what} {UNITS[name]}": str(0.1 * gap), f"{what} se {UNITS[name]}": str(0.01 * gap)}
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
