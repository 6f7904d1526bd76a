"""Pictures of a scenario: their numbers are the simulation's, and they can be read."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from reports.distributions import distributions_figure
from reports.gantt import gantt
from reports.intervals import bars, jobs, rows
from reports.scenario_panel import scenario_panel
from sched_sim.scenario import Scenario, Sensor
from sched_sim.scenario_file import read_scenario
from sched_sim.scenario_run import run_scenario
from tests.reports.layout import flaws, texts

ROCKET = read_scenario(Path(__file__).parents[1] / "sched_sim" / "rocket.toml")
OVERLOAD = Scenario(
    "overload",
    steps=400,
    speed=Fraction(10),
    sensors=[
        Sensor("gps $1$", 20, (4, 5, 6), land_by=11, dropout=0.1),
        Sensor("a barometer with a long name", 3, (0,), land_by=2, priority=10),
        Sensor("lost", 3, (2,), land_by=2, dropout=1.0),
    ],
    costs={
        "predict": [Fraction(value) for value in ("3", "4", "5", "9.5")],
        "correct.gps $1$": [Fraction(3)],
        "correct.a barometer with a long name": [Fraction(1), Fraction(2)],
        "correct.lost": [Fraction(1)],
    },
)


def bars_of(figure: Figure, title: str) -> dict[float, float]:
    """Height by left edge of the bars in the plot of this title."""
    (axes,) = [axes for axes in figure.axes if title in {text.get_text() for text in axes.texts}]
    return {
        patch.get_x(): patch.get_height()
        for patch in axes.patches
        if isinstance(patch, Rectangle) and patch.get_height()
    }


def test_bars_are_the_shares_of_the_achieved_l() -> None:
    outcome = run_scenario(ROCKET)
    drawn = bars_of(distributions_figure(ROCKET, outcome), "gps: achieved l")
    achieved = outcome.sensors["gps"].achieved
    expected = {step - 0.4: 100 * count / achieved.total() for step, count in achieved.items()}
    assert {round(x, 6): height for x, height in drawn.items()} == pytest.approx(
        {round(x, 6): height for x, height in expected.items()}
    )


def test_histograms_hold_every_response_time_where_it_is() -> None:
    outcome = run_scenario(ROCKET)
    drawn = bars_of(distributions_figure(ROCKET, outcome), "correct gps")
    responses = [2.5 * response for response in outcome.jobs["correct gps"].responses]
    assert sum(drawn.values()) == pytest.approx(100)
    width = 1.05 * max(responses) / 40
    shares = [100 * sum(x <= time < x + width for time in responses) / len(responses) for x in drawn]
    assert list(drawn.values()) == pytest.approx(shares)


@pytest.mark.parametrize("scenario", [ROCKET, OVERLOAD], ids=["rocket", "overload"])
def test_both_pictures_can_be_read(scenario: Scenario) -> None:
    outcome = run_scenario(scenario)
    assert flaws(distributions_figure(scenario, outcome)) == []
    assert flaws(gantt([scenario_panel(scenario, outcome)])) == []


def test_the_deadline_of_l_is_behind_the_last_step_that_meets_it() -> None:
    gps = replace(ROCKET.sensors[0], land_by=30)
    scenario = replace(ROCKET, sensors=[gps, *ROCKET.sensors[1:]])
    figure = distributions_figure(scenario, run_scenario(scenario))
    (axes,) = [axes for axes in figure.axes if "gps: achieved l" in {text.get_text() for text in axes.texts}]
    assert [list(line.get_xdata()) for line in axes.lines] == [[30.5, 30.5]]


def test_misses_are_told() -> None:
    outcome = run_scenario(OVERLOAD)
    said = {text.get_text() for text, _ in texts(distributions_figure(OVERLOAD, outcome))}
    missed = outcome.jobs["predict"].misses
    assert {f"{missed} of 400 missed", "no job finished", "deadline"} <= said
    assert f"{outcome.sensors['gps $1$'].not_landed} not landed" in said


def test_the_chart_shows_each_sensor_on_a_line_of_its_own_up_to_the_first_miss() -> None:
    outcome = run_scenario(OVERLOAD)
    panel = scenario_panel(OVERLOAD, outcome)
    assert outcome.first_miss is not None
    assert panel.first < outcome.first_miss <= panel.end
    assert {row.name for row in rows(panel.schedule)} == {"predict", "gps $1$", "a barometer with a long name"}
    assert {bar.style for bar in bars(panel.schedule)} <= {"PR", "CO", "RP", "CU"}
    assert min(job.deadline for job in jobs(panel.schedule) if job.missed) == outcome.first_miss * panel.schedule.period


def test_the_chart_without_a_miss_shows_the_first_steps() -> None:
    outcome = run_scenario(ROCKET)
    panel = scenario_panel(ROCKET, outcome)
    assert outcome.first_miss is None
    assert (panel.first, panel.end) == (0, 60)
    assert {"PR", "CO", "RP", "CU", "task:control"} == {bar.style for bar in bars(panel.schedule)}
