"""Gantt charts of scenarios: which steps they show, and every job of those steps, whether it ran or not."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from fractions import Fraction

import pytest
from matplotlib.collections import PolyCollection

from reports.charts.chart import gantt
from reports.scenario.panel import LEAST_BAR_MM, Late, first_late, scenario_panel, window
from sched_sim.scenario.draws import fates
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Scenario, Sensor
from sched_sim.schedule.intervals import bars, jobs, rows
from sched_sim.schedule.tasks import Task
from tests import scenarios
from tests.reports.layout import flaws, texts
from tests.reports.scenario.test_distributions import LONG, OVERLOAD, ROCKET

STARVED = Scenario(
    "starved",
    steps=60,
    speed=Fraction(10),
    sensors=[Sensor("s", 7, (4, 5, 6), land_by=12, dropout=0.2)],
    costs={
        "predict": [Fraction(9)],
        "correct.s": [Fraction(3)],
        "predict_accumulate": [Fraction(8)],
        "correct_late.s": [Fraction(3)],
    },
    tasks=[Task("urgent", Fraction(1), Fraction(3), priority=5), Task("idle", Fraction(3), Fraction(1), priority=30)],
)


BETWEEN_STEPS = replace(
    STARVED,
    speed=Fraction(20),
    sensors=[Sensor("s", Fraction(20, 3), (Fraction(7, 2), 5), land_by=12, offset=Fraction(1, 2))],
)

TWO_TASKS = scenarios.scenario(
    11,
    dict.fromkeys(("hr_propagate", "hr_restart", "hr_update", "lr_propagate"), 3)
    | {
        f"{kind}.{name}": 4
        for kind in ("gain", "lr_correct", "hr_pass", "gain_again", "gain_kept")
        for name in ("gps", "camera")
    },
    scenarios.sensor("gps", 9, range(4, 7), dropout=0.2),
    scenarios.sensor("camera", 5, 2),
    steps=60,
    late="dual-rate",
)
"""Too slow."""


def test_gains_and_losses_are_on_the_line_of_their_sensor_and_l_is_the_step_of_the_landing() -> None:
    scenario = replace(TWO_TASKS, speed=Fraction(40))
    outcome = run_scenario(scenario)
    panel = scenario_panel(scenario, outcome)
    assert {row.name for row in rows(panel.schedule)} == {"predict", "gps", "camera"}
    assert {bar.style for bar in bars(panel.schedule)} == {"HRP", "HRU", "LRP", "LRG", "LRU"}
    assert {mark.text: mark.step for mark in panel.marks} == {"k": 0, "m": 2, "l": 3}
    assert (0, 3) in outcome.sensors["camera"].landings
    assert flaws(gantt([panel])) == []


def test_a_measurement_between_steps_is_shown_where_it_is_used() -> None:
    """The first, at 1/2 step, is of step 1; it arrives at 4 or 5 1/2."""
    late = first_late(BETWEEN_STEPS)
    assert late is not None
    assert (late.k, late.m) in {(1, 4), (1, 6)}
    panel = scenario_panel(BETWEEN_STEPS, run_scenario(BETWEEN_STEPS))
    marks = {mark.text: mark.step for mark in panel.marks}
    assert (marks["k"], marks.get("m", marks.get("m = l"))) == (late.k, late.m)
    assert flaws(gantt([panel])) == []


def test_the_chart_shows_each_sensor_on_a_line_of_its_own_up_to_the_first_miss() -> None:
    outcome = run_scenario(OVERLOAD)
    panel = scenario_panel(OVERLOAD, outcome)
    assert outcome.first_miss is not None
    assert panel.first < outcome.first_miss <= panel.end
    assert {row.name for row in rows(panel.schedule)} == {"predict", "gps $1$", "a barometer with a long name"}
    assert {bar.style for bar in bars(panel.schedule)} <= {"PR", "CO", "RP", "CU"}
    assert min(job.deadline for job in jobs(panel.schedule) if job.missed) == outcome.first_miss * panel.schedule.period


def test_the_chart_without_a_miss_shows_the_first_late_measurement() -> None:
    outcome = run_scenario(ROCKET)
    panel = scenario_panel(ROCKET, outcome)
    assert outcome.first_miss is None
    late = first_late(ROCKET)
    assert late is not None
    assert (panel.first, panel.end) == (late.m - 4, late.m + 20)
    assert {"PR", "CO", "RP", "task:control"} <= {bar.style for bar in bars(panel.schedule)}


@pytest.mark.parametrize(
    ("every", "first_miss", "arrival", "expected"),
    [
        (80, None, 40, (36, 60)),
        (80, None, 16, (0, 24)),
        (80, None, 995, (976, 1000)),
        (80, 500.0, 40, (478, 502)),
        (80, 3.5, 40, (0, 24)),
        (80, 1000.0, 40, (976, 1000)),
        (8, None, None, (0, 16)),
        (1, None, None, (0, 12)),
    ],
)
def test_the_window_is_short_and_about_what_matters(
    every: int, first_miss: float | None, arrival: int | None, expected: tuple[int, int]
) -> None:
    scenario = replace(STARVED, steps=1000, sensors=[Sensor("s", every, (0,), land_by=12)])
    late = None if arrival is None else Late(arrival, 0, "correct s")
    assert window(scenario, first_miss, late) == expected


@pytest.mark.parametrize(
    "scenario",
    [
        STARVED,
        replace(STARVED, cpus=2),
        replace(STARVED, speed=Fraction(14)),
        replace(STARVED, speed=Fraction(17), late="larsen"),
        replace(OVERLOAD, steps=60),
        replace(OVERLOAD, steps=60, cpus=2, speed=Fraction(6)),
        replace(ROCKET, steps=60, cpus=2),
        BETWEEN_STEPS,
        TWO_TASKS,
        replace(TWO_TASKS, cpus=2),
    ],
)
def test_every_job_is_drawn_whether_it_ran_or_not(scenario: Scenario, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("reports.scenario.panel.CYCLES", 60)
    monkeypatch.setattr("reports.scenario.panel.MOST_STEPS", 60)
    outcome = run_scenario(scenario)
    drawn = jobs(scenario_panel(scenario, outcome).schedule)
    released = {kind: figures.released for kind, figures in outcome.jobs.items() if figures.released}
    assert Counter(job.kind for job in drawn) == released
    assert sum(job.missed for job in drawn) == outcome.misses
    for kind, figures in outcome.jobs.items():
        found = [(job.finish - job.release) for job in drawn if job.kind == kind and job.finish is not None]
        period = outcome.schedule.period
        assert sorted(found) == [round(each * period) for each in sorted(figures.responses)]


def test_arrived_measurements_have_their_release_arrows_without_ever_running() -> None:
    outcome = run_scenario(STARVED)
    panel = scenario_panel(STARVED, outcome)
    drawn = [job for job in jobs(panel.schedule) if job.kind == "correct s"]
    delays = fates((4, 5, 6), 0.2, 2, 0, "s")
    taken = [step for step, delay in zip((0, 7), delays, strict=True) if delay is not None and step + delay < panel.end]
    assert [job.step for job in drawn] == taken != []
    assert not [bar for bar in bars(panel.schedule) if bar.kind == "correct s"]
    assert flaws(gantt([panel])) == []


def test_the_headline_counts_the_whole_simulation_and_what_is_shown() -> None:
    outcome = run_scenario(STARVED)
    panel = scenario_panel(STARVED, outcome)
    released = sum(figures.released for figures in outcome.jobs.values())
    shown = sum(job.missed for job in jobs(panel.schedule))
    said = {text.get_text() for text, _ in texts(gantt([panel]))}
    assert f"✗ {outcome.misses} of all {released} jobs miss their deadline, {shown} of them shown" in said
    assert f"first {panel.end} of 60 steps" in said
    of_rocket = scenario_panel(ROCKET, run_scenario(ROCKET))
    assert f"steps {of_rocket.first} to {of_rocket.end - 1} of 2000" in of_rocket.notes


def test_a_long_name_and_short_work_can_be_seen() -> None:
    """A predict job takes a hundredth of its step."""
    scenario = replace(STARVED, name=LONG, speed=Fraction(900), tasks=[Task(LONG, Fraction(1), Fraction(3), 5)])
    figure = gantt([scenario_panel(scenario, run_scenario(scenario))])
    assert flaws(figure) == []
    axes = figure.axes[0]
    mm = figure.get_size_inches()[0] * 25.4 * axes.get_position().width / (axes.get_xlim()[1] - axes.get_xlim()[0])
    boxes = [path for found in axes.collections if isinstance(found, PolyCollection) for path in found.get_paths()]
    wide = [mm * (box.vertices[:, 0].max() - box.vertices[:, 0].min()) for box in boxes if len(box.vertices)]
    tall = [box.vertices[:, 1].max() - box.vertices[:, 1].min() for box in boxes if len(box.vertices)]
    assert min(width for width, height in zip(wide, tall, strict=True) if height > 1) == pytest.approx(LEAST_BAR_MM)
