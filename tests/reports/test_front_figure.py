"""The figure of power against accuracy: what it draws is what was found."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from filters.accuracy import shipped_model
from reports.drawing.picture import image
from reports.selection.front_figure import COLUMN_MM, front_figure
from studies.selection.conditions import Conditions
from studies.selection.costs import tables_for
from studies.selection.front import Front, front
from studies.selection.model import load_model
from studies.selection.outputs import outputs_of
from studies.selection.question import Question
from studies.selection.sampling import Sampling

METHODS = ["recalculate", "larsen", "dual-rate"]


@cache
def front_of(name: str, within: float) -> Front:
    model = load_model(name, None)
    sampling = Sampling.of(shipped_model(name))
    question = Question(model, outputs_of(model), sampling, within, "worst", Conditions(), tables_for(model, None))
    return front(question, METHODS, (1, 2))


@pytest.mark.exhaust
@pytest.mark.parametrize(
    ("name", "within"),
    [
        ("ins-gps", 0.38),
        *(
            pytest.param(name, within, marks=pytest.mark.exhaust)
            for name, within in (("camera", 0.03), ("star-tracker", 5e-6))
        ),
    ],
)
def test_each_design_is_where_it_belongs(name: str, within: float) -> None:
    found = front_of(name, within)
    figure = front_figure(found)
    axes, right = figure.axes[0], figure.axes[-1]
    drawn = {
        (round(float(x), 6), round(float(y), 6))
        for line in axes.lines
        for x, y in zip(np.atleast_1d(line.get_xdata()), np.atleast_1d(line.get_ydata()), strict=True)
    }
    for point in found.points:
        over = 100 * (point.std / found.no_delay - 1)
        assert (round(point.speed, 6), round(over, 6)) in drawn
        low, high = axes.get_xlim()
        assert low < point.speed < high
        assert axes.get_ylim()[0] < over < axes.get_ylim()[1]
    assert figure.get_size_inches()[0] * 25.4 == pytest.approx(COLUMN_MM)
    texts = {text.get_text() for text in axes.texts}
    assert {"all used", "every 2nd"} <= texts
    assert any(text.startswith("L=") for text in texts)
    assert right is not axes


def test_its_bytes_are_the_same_every_time() -> None:
    found = front_of("ins-gps", 0.38)
    assert image(front_figure(found), "svg") == image(front_figure(found), "svg")
