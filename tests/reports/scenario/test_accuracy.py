"""The accuracy in the picture of a scenario: its bars are its numbers, and it can be read."""

from __future__ import annotations

from pathlib import Path

import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from reports.scenario.distributions import distributions_figure
from sched_sim.scenario.outcome import Outcome
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Scenario
from studies.selection.in_scenario import ScenarioAccuracy, accuracy_along, question_of
from tests.reports.layout import flaws, texts
from tests.scenarios import scenario, sensor


def drawn(of: Scenario, **asked: object) -> tuple[Figure, Outcome, ScenarioAccuracy]:
    outcome = run_scenario(of)
    accuracy = accuracy_along(question_of(of, Path(), **{"model": "ins-gps"} | asked), of, outcome)  # type: ignore[arg-type]
    return distributions_figure(of, outcome, accuracy), outcome, accuracy


def plot(figure: Figure, title: str) -> Axes:
    (axes,) = [axes for axes in figure.axes if title in {text.get_text() for text in axes.texts}]
    return axes


def bars(axes: Axes) -> list[tuple[float, float, float]]:
    """Left, right, height."""
    found = [patch for patch in axes.patches if isinstance(patch, Rectangle)]
    return [(bar.get_x(), bar.get_x() + bar.get_width(), bar.get_height()) for bar in found]


COSTS = {"predict": [0.3, 0.6], "correct.gps": 1}


@pytest.mark.parametrize(
    ("every", "hr_hz"),
    [(80, 400), (13, 100), *(pytest.param(*both, marks=pytest.mark.exhaust) for both in ((80, 100), (13, 400)))],
)
def test_bars_are_shares_of_the_steps(every: int, hr_hz: int) -> None:
    of = scenario(2, COSTS, sensor("gps", every, range(20, 40), dropout=0.2), steps=3000, hr_hz=hr_hz)
    figure, _, accuracy = drawn(of)
    assert not flaws(figure)
    output, age = plot(figure, "position: accuracy"), plot(figure, "gps: age of its information")
    ages = accuracy.ages["gps"]
    assert ages is not None
    for axes, values in ((output, accuracy.counted), (age, 1000 / hr_hz * ages)):
        assert sum(height for _, _, height in bars(axes)) == pytest.approx(100)
        assert len(bars(axes)) <= 41
        for left, right, height in bars(axes)[:-1]:
            assert height == pytest.approx(100 * ((left <= values) & (values < right)).mean(), abs=0.2)
    assert (output.get_xlabel(), age.get_xlabel()) == ("standard deviation (m)", "age (ms)")
    assert output.get_ylabel() == "% of the steps"
    said = {text.get_text().removesuffix(",") for text, _ in texts(figure)}
    assert f"median {accuracy.spread.median:.3g}" in said
    assert f"worst {accuracy.spread.worst:.3g} m" in said


def test_what_has_not_landed_is_said_and_what_does_not_vary_is_drawn() -> None:
    of = scenario(100, COSTS, sensor("gps", 80, 20, dropout=1.0), steps=2, hr_hz=400)
    figure, _, _ = drawn(of, output="tilt", initial_std=[1.0] * 9)
    assert not flaws(figure)
    assert "nothing of it has landed" in {text.get_text() for text, _ in texts(figure)}
    assert sum(height for _, _, height in bars(plot(figure, "tilt: accuracy"))) == pytest.approx(100)


def test_names_are_not_taken_for_formulas() -> None:
    of = scenario(100, {"predict": 1, "correct.a $1$ b": 1}, sensor("a $1$ b", 80, 20), steps=800, hr_hz=400)
    figure, _, _ = drawn(of, output="x $1$ y=0,2")
    assert not flaws(figure)


def test_small_numbers_can_be_read() -> None:
    of = scenario(10, COSTS, sensor("gps", 50, 20), steps=4000, hr_hz=100)
    figure, _, _ = drawn(of, model="star-tracker", output="attitude")
    assert not flaws(figure)
