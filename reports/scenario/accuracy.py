"""How the output's standard deviation, and the age of each sensor's information, are spread over a scenario's steps."""

from __future__ import annotations

from math import ceil

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from filters.accuracy.trace import Spread
from filters.arrays import FloatArray
from reports.charts.lanes import shortened
from reports.drawing.style import FILLS
from reports.scenario.cells import BINS, Cell, Note, share_axis
from studies.selection.in_scenario import ScenarioAccuracy

OF_STEPS = "% of the steps"
CONSTANT = 1e-4
"""Relative: what differs by less is one bar."""


def accuracy_cells(accuracy: ScenarioAccuracy) -> list[Cell]:
    """One of the output, one of each sensor; over the steps that the figures are of."""
    return [_output(accuracy), *(_age(accuracy, sensor) for sensor in accuracy.ages)]


def _output(accuracy: ScenarioAccuracy) -> Cell:
    outputs, values = accuracy.question.outputs, accuracy.counted
    low, high = float(values.min()), float(values.max())
    edges = np.linspace(low, high, BINS + 1) if high - low > CONSTANT * high else np.array([0.99, 1.01]) * (high or 1.0)
    unit = f" ({shortened(outputs.unit)})" if outputs.unit else ""

    def draw(axes: Axes) -> None:
        _bars(axes, values, edges, FILLS["LRU"].colour, FILLS["LRU"].ink)
        axes.ticklabel_format(axis="x", useOffset=False)
        axes.set_xlabel(f"standard deviation{unit}", labelpad=2)

    return Cell(f"{shortened(outputs.name)}: accuracy", _notes(accuracy.spread, outputs.unit), draw, OF_STEPS)


def _age(accuracy: ScenarioAccuracy, sensor: str) -> Cell:
    ages, figures = accuracy.ages[sensor], accuracy.age(sensor)
    title = f"{shortened(sensor)}: age of its information"
    if ages is None or figures is None:
        return Cell(title, [Note("nothing of it has landed", missed=True)], lambda axes: axes.set_axis_off(), OF_STEPS)
    per_bar = ceil((ages.max() - ages.min() + 1) / BINS)
    bars = ceil((ages.max() - ages.min() + 1) / per_bar)
    edges = accuracy.age_scale * (np.floor(ages.min()) - 0.5 + per_bar * np.arange(bars + 2))
    edges = edges[: np.searchsorted(edges, accuracy.age_scale * ages.max()) + 1]

    def draw(axes: Axes) -> None:
        _bars(axes, accuracy.age_scale * ages, edges, FILLS["CO"].colour, FILLS["CO"].ink)
        axes.set_xlabel(f"age ({accuracy.age_unit})", labelpad=2)

    return Cell(title, _notes(figures, accuracy.age_unit), draw, OF_STEPS)


def _bars(axes: Axes, values: FloatArray, edges: FloatArray, colour: str, ink: str) -> None:
    counts, _ = np.histogram(values, bins=edges)
    shares = 100 * counts / len(values)
    axes.bar(edges[:-1], shares, np.diff(edges), align="edge", color=colour, edgecolor=ink, lw=0.3)
    free = 0.04 * (edges[-1] - edges[0])
    axes.set_xlim(max(edges[0] - free, min(edges[0], 0.0)), edges[-1] + free)
    axes.xaxis.set_major_locator(MaxNLocator(nbins=6))
    share_axis(axes, shares.tolist())


def _notes(figures: Spread, unit: str) -> list[Note]:
    said = [f"median {figures.median:.3g}", f"95 % within {figures.p95:.3g}", f"worst {figures.worst:.3g}"]
    return [Note(text) for text in [*said[:-1], f"{said[-1]} {shortened(unit)}".rstrip()]]
