"""Pictures of a scenario: their numbers are the simulation's, and they can be read."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from fractions import Fraction
from math import log
from typing import Any

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from reports.charts.chart import gantt
from reports.scenario.distributions import distributions_figure
from reports.scenario.panel import scenario_panel
from sched_sim.scenario.outcome import JobFigures, Outcome, SensorFigures
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Scenario, Sensor
from sched_sim.scenario.scenario_file import read_scenario
from sched_sim.schedule.tasks import Task
from studies.probability.beside_sampled import beside_sampled
from tests import scenarios
from tests.reports.layout import flaws, texts

ROCKET = read_scenario(scenarios.ROCKET)
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
        if isinstance(patch, Rectangle) and patch.get_height() and not patch.get_hatch()
    }


def words(figure: Figure) -> set[str]:
    return {text.get_text().removesuffix(",") for text, _ in texts(figure)}


def plot(figure: Figure, title: str) -> Axes:
    (axes,) = [axes for axes in figure.axes if title in {text.get_text() for text in axes.texts}]
    return axes


def slow(name: str, **sensor: Any) -> Scenario:
    """Predict takes a third of each step; a correction takes little and is replayed."""
    one = Sensor(name, **({"every": 20, "delays": (0,), "land_by": 12, "priority": 5} | sensor))
    costs = {"predict": [Fraction(3)], f"correct.{name}": [Fraction(1)]}
    task = Task("t", Fraction(10), Fraction(1), priority=1)
    return Scenario("s", steps=60, speed=Fraction(9), sensors=[one], costs=costs, tasks=[task])


def test_shares_are_on_a_logarithmic_axis_down_to_one_of_all_and_what_they_do_not_resolve_is_shaded() -> None:
    scenario = slow("s")
    figure = distributions_figure(scenario, run_scenario(scenario))
    assert [axes.get_yscale() for axes in figure.axes] == ["log"] * 4
    assert [axes.get_ylim() for axes in figure.axes] == [(0.01, 1), (0.1, 1), (0.1, 1), (0.1, 1)]
    shaded = [patch for axes in figure.axes for patch in axes.patches if patch.get_hatch()]
    assert [patch.get_y() + patch.get_height() for patch in shaded] == pytest.approx(
        [log(20) / n for n in (60, 10, 10, 10)]
    )


LONG = "a name that would not fit if there were three of it " * 3


@pytest.mark.parametrize("land_by", [6, 20_000])
def test_long_names_and_large_numbers_stay_in_their_plots(land_by: int) -> None:
    late = 5
    scenario = slow(LONG, every=3, delays=(late,), land_by=land_by, priority=20)
    scenario = replace(scenario, tasks=[Task(LONG, Fraction("99999.1"), Fraction("0.3"), 4)])
    jobs = JobFigures(20_000, [12345.678] * 19_000, 19_976, 20_000)
    sensor = SensorFigures(20_000, 19_000, 18_000, Counter({late: 9_000, late + 900: 3}))
    outcome = Outcome(
        dict.fromkeys(("predict", f"correct {LONG}", f"task:{LONG}"), jobs),
        {LONG: sensor},
        run_scenario(scenario).schedule,
        None,
        [0],
    )
    figure = distributions_figure(scenario, outcome)
    said = {text.get_text() for axes in figure.axes for text in axes.texts}
    assert {"19976 of 20000 missed", "19000 of 20000 finished,"} <= said
    assert flaws(figure) == []


def achieved(scenario: Scenario, *landed: int) -> Figure:
    outcome = run_scenario(scenario)
    sensor = SensorFigures(len(landed), 0, len(landed), Counter(landed))
    return distributions_figure(scenario, replace(outcome, sensors={"s": sensor}))


@pytest.mark.parametrize(
    ("land_by", "landed", "shown"),
    [
        (16, [10, 11, 12, 13], True),
        (50, [10, 11, 12, 13], False),
        (3, [15, 40], True),
        (3, [40, 45], False),
    ],
)
def test_a_deadline_has_a_line_or_is_in_the_subtitle(land_by: int, landed: list[int], shown: bool) -> None:
    figure = achieved(slow("s", land_by=land_by), *landed)
    axes = plot(figure, "s: achieved l")
    lines = [line.get_xdata()[0] for line in axes.lines]
    named = [text for text in axes.texts if text.get_text() == "deadline"]
    assert (lines == [land_by + 0.5]) == (len(named) == 1) == shown
    assert any(text.get_text().startswith(f"deadline k + {land_by}") for text in axes.texts) != shown
    low, high = axes.get_xlim()
    assert all(low < line < high for line in lines)
    assert flaws(figure) == []


def test_a_wide_range_of_achieved_l_has_whole_steps_in_each_bar() -> None:
    figure = achieved(slow("s", land_by=70), *range(10, 110), 10, 11, 12)
    axes = plot(figure, "s: achieved l")
    assert "3 in each bar" in axes.get_xlabel()
    drawn = bars_of(figure, "s: achieved l")
    assert len(drawn) == 34
    assert sum(drawn.values()) == pytest.approx(1)
    assert drawn[min(drawn)] == pytest.approx(6 / 103)


def test_what_unfinished_jobs_hide_is_not_claimed() -> None:
    scenario = slow("s")
    outcome = run_scenario(scenario)
    jobs = outcome.jobs | {"correct s": JobFigures(40, [25.9], 39, 40)}
    axes = plot(distributions_figure(scenario, replace(outcome, jobs=jobs)), "correct s")
    said = {text.get_text().removesuffix(",") for text in axes.texts}
    assert {"1 of 40 finished", "39 of 40 missed"} <= said
    assert not [text for text in said if "99 %" in text or "median" in text]


def test_bars_are_the_shares_of_the_achieved_l() -> None:
    outcome = run_scenario(ROCKET)
    drawn = bars_of(distributions_figure(ROCKET, outcome), "gps: achieved l")
    achieved = outcome.sensors["gps"].achieved
    expected = {step - 0.4: count / achieved.total() for step, count in achieved.items()}
    assert {round(x, 6): height for x, height in drawn.items()} == pytest.approx(
        {round(x, 6): height for x, height in expected.items()}
    )


ONE_LATE = Scenario(
    "one",
    steps=400,
    speed=Fraction(10),
    sensors=[Sensor("s", every=20, delays=(4,), land_by=6)],
    costs={"predict": [Fraction(3)] * 19 + [Fraction(6)], "correct.s": [Fraction(1)] * 9 + [Fraction(12)]},
)


def test_what_is_exact_is_drawn_over_what_was_simulated() -> None:
    exact = beside_sampled(ONE_LATE)
    figure = distributions_figure(ONE_LATE, run_scenario(ONE_LATE), exact=exact)
    (circles,) = [line for line in plot(figure, "s: achieved l").lines if line.get_marker() == "o"]
    known = {L: one.bounds.upper for L, one in exact.landing.items()}
    steps, heights = (np.asarray(data, dtype=float) for data in circles.get_data())
    assert dict(zip(steps, heights, strict=True)) == {L: share for L, share in known.items() if share > 1e-12}
    assert sum(known.values()) == pytest.approx(1)
    assert plot(figure, "s: achieved l").get_ylim()[0] < heights.min() < 1e-9
    (dashed,) = [line for line in plot(figure, "predict").lines if line.is_dashed()]
    times, longer = (np.asarray(data, dtype=float) for data in dashed.get_data())
    assert longer[(times > 0.3) & (times < 0.6)] == pytest.approx(0.05)
    assert flaws(figure) == []


def test_histograms_hold_every_response_time_where_it_is() -> None:
    outcome = run_scenario(ROCKET)
    drawn = bars_of(distributions_figure(ROCKET, outcome), "correct gps")
    responses = [2.5 * response for response in outcome.jobs["correct gps"].responses]
    assert sum(drawn.values()) == pytest.approx(1)
    width = 1.05 * max(responses) / 40
    shares = [sum(x <= time < x + width for time in responses) / len(responses) for x in drawn]
    assert list(drawn.values()) == pytest.approx(shares)


BETWEEN_STEPS = replace(
    OVERLOAD,
    sensors=[replace(OVERLOAD.sensors[0], every=Fraction(40, 3), delays=(Fraction(9, 2),)), *OVERLOAD.sensors[1:]],
)


@pytest.mark.parametrize("scenario", [ROCKET, OVERLOAD, BETWEEN_STEPS], ids=["rocket", "overload", "between steps"])
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
    said = words(distributions_figure(OVERLOAD, outcome))
    missed = outcome.jobs["predict"].misses
    assert {f"{missed} of 400 missed", "no job released", "deadline"} <= said
    assert f"{outcome.sensors['gps $1$'].not_landed} not landed" in said
