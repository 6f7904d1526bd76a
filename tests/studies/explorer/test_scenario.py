"""What is known of a scenario as plain data: the same as its outcome, and as the command line says."""

from __future__ import annotations

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from urllib.parse import quote

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sched_sim.errors import InputError
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Scenario
from sched_sim.scenario.scenario_file import read_scenario
from studies.explorer.scenario import ScenarioView, explore_scenario
from studies.explorer.scenario_asked import ScenarioAsked
from studies.explorer.scenario_runs import Runs
from studies.probability.beside_sampled import beside_sampled
from studies.selection.in_scenario import accuracy_along, question_of
from tests.command_line import Run
from tests.random_scenarios import random_scenario
from tests.scenarios import BY_HAND, ROCKET, scenario, sensor

WORTH = Path(__file__).parent / "worth.toml"

URGENT = scenario(10, BY_HAND | {"predict": [4] * 19 + [9]}, sensor("gps", 20, 8, priority=5), steps=400)


@settings(max_examples=60)
@given(st.integers(0, 10**6))
def test_its_figures_are_those_of_the_outcome(seed: int) -> None:
    of = random_scenario(seed)
    outcome, view = run_scenario(of), explore_scenario(of)
    assert view.misses == outcome.misses
    assert view.busy == [busy / outcome.schedule.horizon for busy in outcome.busy]
    for job, (kind, figures) in zip(view.jobs, outcome.jobs.items(), strict=True):
        assert (job.kind, job.released, job.misses) == (kind, figures.released, figures.misses)
        assert (job.miss_probability, job.miss_interval) == (figures.miss_probability, figures.miss_interval)
        assert job.finished == len(figures.responses) == (sum(job.histogram.counts) if job.histogram else 0)
    for sensor_view, (name, landed) in zip(view.sensors, outcome.sensors.items(), strict=True):
        assert sensor_view.name == name
        assert dict(zip(sensor_view.L, sensor_view.counts, strict=True)) == landed.achieved
        assert (sensor_view.taken, sensor_view.not_landed) == (landed.taken, landed.not_landed)


@given(st.integers(0, 10**6))
def test_it_goes_through_json(seed: int) -> None:
    document = explore_scenario(random_scenario(seed)).document()
    assert json.loads(json.dumps(document, allow_nan=False))["misses"] == document["misses"]


def test_what_cannot_be_seen_of_a_name_is_told_by_its_escape_and_may_be_asked_for_so() -> None:
    """It would turn the direction of what is written behind it, or be copied unseen."""
    names = ("a\u202eb", "a\u2068b")
    runs = Runs(scenario(10, {"predict": 4} | {f"correct.{name}": 9 for name in names},
                         *(sensor(name, 5, 2) for name in names)))  # fmt: skip
    view = runs.view("")
    steps = runs.schedule("first=0&until=20")
    told = [view, steps, runs.next("")]
    assert json.dumps(told, ensure_ascii=False).isprintable()
    assert [job["kind"] for job in view["jobs"]] == view["kinds"]
    assert {*steps["schedule"]["jobs"]["kind"]} == {*view["kinds"]}
    assert {of["kind"] for of in view["sensors"]} <= {*view["kinds"]}
    for kind in view["kinds"]:
        assert runs.view(f"shown={quote(kind)}")["shown"] == kind
    assert runs.view("shown=" + quote(f"correct {names[0]}"))["shown"] == r"correct a\u202eb"


def test_it_says_what_the_command_line_says(sched_sim: Run) -> None:
    told = json.loads(sched_sim(f"simulate --scenario {ROCKET} --format json").out)
    view = explore_scenario(read_scenario(ROCKET))
    assert (view.misses, view.warnings, view.demand) == (told["misses"], told["causes"], told["demand"])
    for job in view.jobs:
        said = told["jobs"][job.kind]
        assert job.response == pytest.approx(said["response_ms"])
        assert (job.decided, job.miss_probability) == (said["decided"], said["miss_probability"])


def test_a_link_has_another_seed_other_steps_and_another_processor() -> None:
    asked = ScenarioAsked(seed=7, steps=300, times_slower=2)
    meant = replace(URGENT, seed=7, steps=300, speed=URGENT.speed / 2)
    view, own = explore_scenario(URGENT, asked), explore_scenario(meant)
    assert replace(view, query="", asked={}, own={}) == replace(own, query="", asked={}, own={})
    assert view.query == "seed=7&steps=300&times_slower=2"


def test_what_is_exact_is_asked_for() -> None:
    assert explore_scenario(URGENT).exact.state == "not asked"
    view, beside = explore_scenario(URGENT, ScenarioAsked(exact=True)), beside_sampled(URGENT)
    assert (view.exact.state, view.cycles) == ("found", beside.cycles)
    predict, correct = view.jobs
    assert predict.exact is not None
    assert beside.longer is not None
    for x, share in zip(predict.exact.x[:-1], predict.exact.y[:-1], strict=True):
        assert share == beside.longer.exceedance[round(x * beside.longer.ticks)]
    assert correct.exact is None
    assert correct.exact_miss == "impossible"
    (gps,) = view.sensors
    assert gps.exact is not None
    assert dict(zip(gps.L, gps.exact, strict=True)) == {L: one.bounds.upper for L, one in beside.landing.items()}


def test_where_nothing_is_exact_it_says_why() -> None:
    (two,) = [explore_scenario(scenario(10, BY_HAND, sensor("gps", 20, 8), sensor("imu", 1))).exact]
    assert (two.state, two.why) == ("none", "there are 2 sensors, and a design has one")


def test_the_sentence_that_answers() -> None:
    """The urgent correction takes 2 and 8 predictions of 4, in a period of 10: five predict jobs are late each time."""
    missed = explore_scenario(replace(URGENT, costs={**URGENT.costs, "predict": [Fraction(4)]})).answer
    assert missed["state"] == "misses"
    assert missed["sentence"] == "In 400 steps 100 of 400 predict jobs finished late, 25 %, 95 % interval 21 % to 30 %"
    fine = explore_scenario(replace(URGENT, speed=Fraction(100))).answer
    assert fine["state"] == "holds"
    assert fine["sentence"] == (
        "In 400 steps no deadline was missed; what is rarer than in 15 % of the corrections of gps would not have been "
        "seen"
    )


def test_the_accuracy_is_that_along_the_run() -> None:
    of = read_scenario(WORTH)
    question = question_of(of, WORTH.parent)
    view, found = explore_scenario(of, question=question), accuracy_along(question, of, run_scenario(of))
    assert view.accuracy is not None
    assert view.accuracy.output.worst == found.spread.worst
    assert sum(view.accuracy.output.histogram.counts) == found.counted.size
    assert view.accuracy.remarks == found.remarks
    assert explore_scenario(of).accuracy_is is None


def test_a_long_accuracy_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    of = read_scenario(WORTH)
    monkeypatch.setattr("studies.explorer.scenario_found.SHORT", of.steps)
    question = question_of(of, WORTH.parent)
    assert _state(explore_scenario(of, question=question)) == "not asked"
    assert _state(explore_scenario(of, ScenarioAsked(accuracy=True), question)) == "found"


def _state(view: ScenarioView) -> str:
    assert view.accuracy_is is not None
    return view.accuracy_is.state


def test_more_steps_than_a_page_has_time_for_are_refused() -> None:
    with pytest.raises(InputError, match="steps is 990000: give at most 952,380, which are a million jobs"):
        explore_scenario(URGENT, ScenarioAsked(steps=990_000))


def test_of_a_long_file_the_first_steps_are_simulated(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("studies.explorer.scenario_asked.MOST_JOBS", 210)
    view = explore_scenario(URGENT)
    assert (view.steps, view.notes[0]) == (200, "200 of the 400 steps of the file are simulated")


@pytest.mark.parametrize(
    ("of", "at"),
    [
        (scenario(1000, BY_HAND, sensor("imu", 1), sensor("gps", 100, 70)), 66),  # 4 steps before its first arrival
        (scenario(100, BY_HAND, sensor("imu", 1)), 0),
        (scenario(3, BY_HAND, sensor("gps", 100, 70)), 0),  # the first predict job is late
    ],
)
def test_the_trace_begins_where_something_happens(of: Scenario, at: int) -> None:
    assert explore_scenario(of).trace["at"] == at
