"""The drawn tails are the exact ones, and can be read."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from reports.probability.tails import tails_figure
from sched_sim.costs.table import CostTable
from sched_sim.design.options import Options
from sched_sim.design.timing import Timing
from sched_sim.probability.stated import StatedCost
from studies.probability.answer import Answer, answer
from studies.probability.question import Question, certain, stated_and_constant
from tests.reports.layout import flaws

RARE = StatedCost([Fraction(10), Fraction(31)], [Fraction(999, 1000), Fraction(1, 1000)])
FIGURE_3 = {"hr_propagate": 63, "hr_restart": 4, "hr_update": 3, "lr_propagate": 41}
SAMPLE = StatedCost([Fraction(10), Fraction(12)] * 500, autocorrelation=0.0)


def found(high: StatedCost, bins: int | None = None) -> Answer:
    stated = {kind: certain(Fraction(1)) for kind in ("hr_update", "lr_propagate", "lr_update")}
    stated |= {"hr_propagate": high, "hr_restart": high}
    costs, constant, pieces = stated_and_constant(CostTable("", "us", {}), "dual-rate", Options(), stated, "minimum")
    question = Question("dual-rate", costs, constant, pieces, Timing(4, 0, 1), Fraction(30), cycles=3, bins=bins)
    return answer(question)


def plot(figure: Figure, title: str) -> Axes:
    (axes,) = [axes for axes in figure.axes if axes.get_title(loc="left") == title]
    return axes


def at(axes: Axes, x: float) -> float:
    """The height of its first curve."""
    across, up = (np.asarray(data, dtype=float) for data in axes.lines[0].get_data())
    return float(up[np.searchsorted(across, x, side="right") - 1])


def test_curves_are_the_tails() -> None:
    figure = tails_figure(found(RARE), None)
    high, landing = plot(figure, "hr"), plot(figure, "landing")
    assert at(high, 0.9) == pytest.approx(1e-3)
    assert at(landing, 1.5) == pytest.approx(1e-3)
    assert at(landing, 2.5) == pytest.approx(1e-6)
    assert {1.0, 1.5} <= {line.get_xdata()[0] for axes in (high, landing) for line in axes.lines}  # deadlines
    assert not [patch for axes in figure.axes for patch in axes.patches if patch.get_hatch()]


def test_the_rarest_landing_is_above_the_end_of_the_axis() -> None:
    stated = {kind: certain(Fraction(work)) for kind, work in FIGURE_3.items()}
    stated["lr_update"] = StatedCost([Fraction(56), Fraction(61)], [1 - Fraction(1, 10**6), Fraction(1, 10**6)])
    costs, constant, pieces = stated_and_constant(CostTable("", "us", {}), "dual-rate", Options(), stated, "minimum")
    asked = Question("dual-rate", costs, constant, pieces, Timing(10, 4, 8), Fraction(78), cycles=3, bins=None)
    landing = plot(tails_figure(answer(asked), None), "landing")
    assert at(landing, 8.5) == pytest.approx(1e-6)
    assert at(landing, 8.5) > 2 * landing.get_ylim()[0]


@pytest.mark.parametrize(
    ("high", "bins", "rate"),
    [(RARE, None, None), (RARE, 64, Fraction(400)), (SAMPLE, None, Fraction(100_000))],
    ids=["periods", "bounds, ms", "sample, us"],
)
def test_it_can_be_read(high: StatedCost, bins: int | None, rate: Fraction | None) -> None:
    assert flaws(tails_figure(found(high, bins), rate)) == []


def test_what_samples_do_not_resolve_is_shaded() -> None:
    answered = found(SAMPLE)
    figure = tails_figure(answered, None)
    for title, floor in (("hr", answered.resolution.job), ("landing", answered.resolution.cycle)):
        (shade,) = [patch for patch in plot(figure, title).patches if patch.get_hatch()]
        assert shade.get_y() + shade.get_height() == pytest.approx(floor)
