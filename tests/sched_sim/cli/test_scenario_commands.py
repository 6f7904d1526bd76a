"""`sched-sim simulate --scenario`: the file, what comes out, and what wrong input gets."""

from __future__ import annotations

import csv
import io
import json
import re
from fractions import Fraction
from pathlib import Path

import pytest

from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario import Sensor
from sched_sim.scenario.scenario_file import read_scenario
from sched_sim.schedule.tasks import Task
from tests.command_line import Run, is_refused
from tests.scenarios import ROCKET
from tests.svg import texts_of

SHORT = """\
name = "short"
speed = 10
steps = 40
costs = "costs.toml"
[predictor]
[[sensor]]
name = "gps"
every = 10
delay = 2
priority = 10
"""
REST = SHORT[SHORT.index("costs =") :]
COSTS = """\
name = "c"
unit = "operation"
[operations]
predict = { multiply = 2, add = 1 }
predict_accumulate = { multiply = 4 }
[operations.correct]
gps = { add = 3 }
[operations.correct_late]
gps = { add = 7 }
"""


def write(folder: Path, scenario: str = SHORT, costs: str = COSTS) -> None:
    (folder / "s.toml").write_text(scenario)
    (folder / "costs.toml").write_text(costs)


def test_a_scenario_is_read_exactly() -> None:
    rocket = read_scenario(ROCKET)
    assert rocket.sensors == (
        Sensor("gps", 40, range(15, 31), land_by=69, dropout=0.1, priority=20),
        Sensor("barometer", 8, (0,), land_by=7, priority=10),
    )
    assert rocket.tasks == (Task("control", Fraction(2), Fraction(5, 10**4), priority=5),)
    assert rocket.costs["predict"] == (Fraction(5, 10**4), Fraction(6, 10**4), Fraction(9, 10**4))
    assert (rocket.speed, rocket.hr_hz, rocket.late) == (Fraction(1, 400), 400, "recalculate")


def test_costs_come_from_the_file_beside_it_and_from_the_scenario_first(tmp_path: Path) -> None:
    write(tmp_path, SHORT.replace("[predictor]", "[predictor]\ncost = [4, 5.5]"))
    found = read_scenario(tmp_path / "s.toml").costs
    assert (found["predict"], found["correct.gps"]) == ((Fraction(4), Fraction(11, 2)), (Fraction(3),))


def test_quotients_in_quotes_are_numbers(tmp_path: Path) -> None:
    quotients = SHORT.replace("speed = 10", 'speed = "1000/77"').replace(
        "[predictor]", '[predictor]\ncost = ["1/3", 2]'
    )
    write(tmp_path, quotients.replace("delay = 2", 'delay = 2\ndropout = "1/3"'))
    found = read_scenario(tmp_path / "s.toml")
    assert (found.speed, found.costs["predict"]) == (Fraction(1000, 77), (Fraction(1, 3), Fraction(2)))
    assert found.sensors[0].dropout == 1 / 3


def test_counts_are_seconds_on_a_processor(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(
        'name = "mine"\ntitle = "mine"\nprecision = "double"\nclock_mhz = 100\nlogic_per_arithmetic = 0\n'
        "[cycles]\nmultiply = 2\nadd = 1\n"
    )
    write(tmp_path, SHORT.replace("speed = 10", 'hr_hz = 100\nprocessor = "mine.toml"'))
    assert read_scenario(tmp_path / "s.toml").costs["predict"] == (Fraction(5, 10**8),)


def test_a_slower_processor_takes_longer_for_what_was_measured(tmp_path: Path) -> None:
    measured = 'name = "m"\nunit = "second"\n[samples]\npredict = [1e-6, 3e-6]\n[samples.correct]\ngps = [2e-6]\n'
    write(tmp_path, SHORT.replace("speed = 10", "hr_hz = 100\ntimes_slower = 50"), measured)
    assert read_scenario(tmp_path / "s.toml").costs["predict"] == (Fraction(5, 10**5), Fraction(15, 10**5))


def test_samples_may_be_in_any_unit_of_time(tmp_path: Path) -> None:
    for unit, scale in {"s": 1, "ms": 10**3, "us": 10**6, "ns": 10**9}.items():
        measured = f'name = "m"\nunit = "{unit}"\n[samples]\npredict = [3]\n[samples.correct]\ngps = [2]\n'
        write(tmp_path, SHORT.replace("speed = 10", "hr_hz = 100"), measured)
        assert read_scenario(tmp_path / "s.toml").costs["predict"] == (Fraction(3, scale),)
        write(tmp_path, SHORT, measured)
        assert read_scenario(tmp_path / "s.toml").costs["predict"] == (Fraction(3),)


def test_what_the_dual_rate_filter_lacks_is_written_as_the_message_says(sched_sim: Run, tmp_path: Path) -> None:
    """Then each of its jobs has figures, and the pictures and the trace are made."""
    stated = SHORT.replace('costs = "costs.toml"', 'late = "dual-rate"').replace("priority = 10", "dropout = 0.3")
    (tmp_path / "s.toml").write_text(stated)
    (entries,) = re.findall(r"write there (\[.*), beside", sched_sim("simulate --scenario s.toml").err)
    samples = entries.replace(" and ", ", ").replace("] ", "]\n").replace(", ", "\n").replace("...", "1")
    (tmp_path / "costs.toml").write_text(f'name = "c"\nunit = "ms"\n{samples}\n')
    (tmp_path / "s.toml").write_text(f'costs = "costs.toml"\n{stated}')
    line = "simulate --scenario s.toml --gantt g.svg --histogram h.svg --trace t.csv --format json"
    document = json.loads(sched_sim(line).out)
    assert list(document["jobs"]) == ["predict", "gain gps", "correct gps", "loss gps"]
    assert document["late"] == "dual-rate"
    assert document["misses"] == 0
    assert document["sensors"]["gps"]["achieved_l"] == {"3": 1.0}
    pieces = {row["piece"] for row in csv.DictReader((tmp_path / "t.csv").read_text().splitlines())}
    assert pieces == {"HRP", "HRU", "LRP", "LRG", "LRU"}


def test_json_has_the_distributions(sched_sim: Run) -> None:
    document = json.loads(sched_sim(f"simulate --scenario {ROCKET} --format json").out)
    outcome = run_scenario(read_scenario(ROCKET))
    assert list(document["jobs"]) == ["predict", "correct gps", "correct barometer", "task:control"]
    gps = document["jobs"]["correct gps"]
    assert gps["response_ms"]["maximum"] == pytest.approx(2.5 * max(outcome.jobs["correct gps"].responses))
    assert gps["response_periods"].keys() == {"minimum", "mean", "median", "p95", "p99", "maximum"}
    assert (gps["misses"], gps["miss_probability"]) == (0, None)
    assert gps["miss_interval"] == [0, 3 / gps["decided"]]
    found = document["sensors"]["gps"]
    assert found["taken"] == 50 == found["dropped"] + found["on_the_way"] + found["landed"] + found["not_landed"]
    assert sum(found["achieved_l"].values()) == pytest.approx(found["landed"] / found["arrived"])
    assert found["land_by"] == 30 + 40 - 1
    assert document["sensors"]["barometer"]["achieved_l"] == {"0": 1.0}
    assert document["utilization"] == float(outcome.schedule.utilization)


def test_csv_has_a_row_for_each_job(sched_sim: Run) -> None:
    rows = list(csv.DictReader(io.StringIO(sched_sim(f"simulate --scenario {ROCKET} --format csv").out)))
    assert [row["job"] for row in rows] == ["predict", "correct gps", "correct barometer", "task:control"]
    assert {row["misses"] for row in rows} == {"0"}


def test_people_get_two_tables(sched_sim: Run) -> None:
    out = sched_sim(f"simulate --scenario {ROCKET}").out
    for words in (
        "rocket: 2000 steps at 400 Hz",
        "P(miss)",
        "95 % interval",
        "response times in ms",
        "dropped",
        "most often",
    ):
        assert words in out


SAMPLED = 'name = "m"\nunit = "second"\n{}[samples]\npredict = [1e-6, 3e-6]\n[samples.correct]\ngps = [2e-6]\n'


TIMED = 'backend = "compiled"\n'


@pytest.mark.parametrize(
    ("about", "stated", "given"),
    [("", "", True), (TIMED, "", False), (TIMED, "cost_us = 1", True), (f"{TIMED}executions = true\n", "", True)],
)
def test_no_probability_of_a_miss_from_samples_of_several_executions(
    about: str, stated: str, given: bool, sched_sim: Run, tmp_path: Path
) -> None:
    """Most of such a sample is the loop that took it. Misses are counted all the same."""
    scenario = SHORT.replace("speed = 10", "hr_hz = 100").replace("[predictor]", f"[predictor]\n{stated}")
    write(tmp_path, scenario.replace('"gps"', f'"gps"\n{stated}'), SAMPLED.format(about))
    people = sched_sim("simulate --scenario s.toml").out
    document = json.loads(sched_sim("simulate --scenario s.toml --format json").out)
    table = list(csv.DictReader(io.StringIO(sched_sim("simulate --scenario s.toml --format csv").out)))
    for job, row in zip(document["jobs"].values(), table, strict=True):
        assert (job["miss_interval"] is not None) == (row["miss_probability_most"] != "") == given
        assert job["misses"] >= 0
    assert ("95 % interval" in people) == given
    assert ("no P(miss): these samples are of an earlier `measure --filter`" in " ".join(people.split())) != given
    assert (document["note"] is None) == given


def test_what_larsen_lacks_is_written_as_the_message_says(sched_sim: Run, tmp_path: Path) -> None:
    stated = SHORT.replace('costs = "costs.toml"', 'late = "larsen"').replace("[predictor]", "[predictor]\ncost = 3")
    (tmp_path / "s.toml").write_text(stated)
    (entries,) = re.findall(r"write there (\[.*), beside", sched_sim("simulate --scenario s.toml").err)
    samples = entries.replace(" and ", "\n").replace("] ", "]\n").replace("...", "4")
    (tmp_path / "costs.toml").write_text(f'name = "c"\nunit = "ms"\n{samples}\n')
    (tmp_path / "s.toml").write_text(f'costs = "costs.toml"\n{stated}')
    assert sched_sim("simulate --scenario s.toml").code == 0
    (tmp_path / "s.toml").write_text(f'costs = "costs.toml"\n{stated}cost = 3\n')
    assert "the cost of sensor gps has no meaning with late = " in sched_sim("simulate --scenario s.toml").err


def test_larsen_in_overload(sched_sim: Run, tmp_path: Path) -> None:
    """In a period of 5, step 2 takes 4 and 7 until 21, steps 3 and 4, still accumulating, until 29, step 5 until 32."""
    write(tmp_path, SHORT.replace("speed = 10", 'speed = 5\nlate = "larsen"'))
    document = json.loads(sched_sim("simulate --scenario s.toml --format json").out)
    assert document["sensors"]["gps"]["achieved_l"] == {"4": 1.0}
    assert document["jobs"]["predict"]["misses"] == 4 * 3
    assert "late measurements: larsen" in sched_sim("simulate --scenario s.toml").out


def test_pictures_and_traces_are_written(sched_sim: Run, tmp_path: Path) -> None:
    line = f"simulate --scenario {ROCKET} --gantt g.svg --histogram h.svg --trace t.csv --trace t.json"
    result = sched_sim(f"{line} --format json")
    assert result.code == 0
    assert {path.name for path in tmp_path.iterdir()} == {"g.svg", "h.svg", "t.csv", "t.json"}
    with (tmp_path / "t.csv").open() as file:
        finished = [row for row in csv.DictReader(file) if row["kind"] == "correct gps" and row["finished"] == "1"]
    assert len(finished) == json.loads(result.out)["sensors"]["gps"]["landed"]


def test_help_says_in_which_unit_costs_are_and_what_a_sensor_has_by_default(sched_sim: Run) -> None:
    words = " ".join(sched_sim("simulate --help").out.replace("│", " ").split())
    assert "name, hr_hz, duration_s, [predictor] cost_us, [[sensor]] name, hz, cost_us" in words
    assert "With speed, cost units per HR period: name, steps, [predictor] cost, [[sensor]] name, every, cost" in words
    assert "a sensor's delay_ms is 0 by default" in words
    assert "land_by is by default the longest delay + every - 1" in words


def test_what_unfinished_jobs_hide_is_not_claimed(sched_sim: Run, tmp_path: Path) -> None:
    """At speed 3, predict fills every step and no correction starts; the deadlines are beyond the end."""
    slow = SHORT.replace("speed = 10", "speed = 3").replace("priority = 10", "priority = 20\nland_by = 99")
    write(tmp_path, slow)
    (job,) = [one for one in json.loads(run_json(sched_sim))["jobs"].values() if not one["finished"]]
    assert (job["released"], job["response_periods"]) == (4, None)
    out = sched_sim("simulate --scenario s.toml").out
    assert "finished" in out
    assert "corrections of gps never catch up" in out
    write(tmp_path, SHORT.replace("speed = 10", "speed = 2"))
    job = json.loads(run_json(sched_sim))["jobs"]["predict"]
    assert 20 <= job["finished"] < job["released"] == 40
    assert job["response_periods"]["median"] is not None
    assert job["response_periods"]["p99"] is None
    out = sched_sim("simulate --scenario s.toml").out
    assert "Some jobs have not finished" in out
    assert "demand is 1" in out


def run_json(sched_sim: Run) -> str:
    return sched_sim("simulate --scenario s.toml --format json").out


def row_of(name: str, table: str) -> list[str]:
    """The cells of the one row that begins with this."""
    (row,) = [line for line in table.splitlines() if line.split()[:1] == [name]]
    return row.split()


def test_all_but_one_is_not_all(sched_sim: Run, tmp_path: Path) -> None:
    """Predict fills its step; from step 1 on a task has made it late."""
    late = '[[task]]\nname = "t"\noffset = 1\nperiod = 10000\ncost = 0.001\npriority = 1\n'
    write(tmp_path, SHORT.replace("speed = 10\nsteps = 40", "speed = 3\nsteps = 1199").replace("10", "5000") + late)
    row = row_of("predict", sched_sim("simulate --scenario s.toml").out)
    assert row[-5:] == ["1198", "0.999166", "0.9952", "to", "0.99986"]


def test_corrections_that_have_not_landed_count_as_later_than_all(sched_sim: Run, tmp_path: Path) -> None:
    """Work for 0.5 comes in each period of 0.4: of 8000 corrections 6400 land, number n in step n + n / 4."""
    (tmp_path / "s.toml").write_text(
        'name = "late"\nsteps = 8000\nspeed = 0.4\n[predictor]\ncost = 0.2\n'
        '[[sensor]]\nname = "gps"\nevery = 1\npriority = 10\ncost = 0.3\n'
    )
    document = json.loads(run_json(sched_sim))
    gps, response = document["sensors"]["gps"], document["jobs"]["correct gps"]["response_periods"]
    assert (gps["arrived"], gps["landed"], gps["not_landed"], gps["land_by"]) == (8000, 6400, 1600, 0)
    assert sum(gps["achieved_l"].values()) == pytest.approx(0.8)
    assert response["median"] == pytest.approx(1001, abs=1)
    assert response["p95"] is None
    out = sched_sim("simulate --scenario s.toml").out
    row = row_of("gps", out)
    assert row[5:10] == ["1600", "0", "1", "1000", "-"]
    assert "Some corrections have not landed" in out


def test_each_of_two_processors_has_a_busy_share(sched_sim: Run, tmp_path: Path) -> None:
    write(tmp_path, SHORT.replace("speed = 10", "speed = 10\ncpus = 2"))
    assert "Processors busy 30.0% and 9.0% of the time" in sched_sim("simulate --scenario s.toml").out


SPREAD = """name = "spread"
speed = 100
steps = 200
late = "carried-gain"
costs = "c.toml"
[[sensor]]
name = "imu"
every = 1
[[sensor]]
name = "gps"
every = 40
delay = 30
priority = 20
land_by = 60
"""
SPREAD_COSTS = """name = "c"
unit = "operation"
[samples]
predict = [30]
correct = { imu = [5], gps = [30] }
carry.gps = [9]
beside = { imu = [2], gps = [2] }
land.gps = [20]
"""


def test_a_picture_of_a_scenario_shows_the_steps_asked_for_and_says_whose_they_are(
    sched_sim: Run, tmp_path: Path
) -> None:
    (tmp_path / "s.toml").write_text(SPREAD)
    (tmp_path / "c.toml").write_text(SPREAD_COSTS)
    line = "simulate --scenario s.toml"
    assert sched_sim(f"{line} --gantt g.svg --from 25 --until 43").code == 0
    texts = texts_of(tmp_path / "g.svg")
    assert {"steps 25 to 42 of 200", "k, m, l of gps", "gps"} <= set(texts)
    assert all(any(label in text for text in texts) for label in ("carry", "land", "correct"))
    is_refused(sched_sim(f"{line} --gantt g.svg --until 201"), ["--until 201", "200 steps are simulated"])
    is_refused(sched_sim(f"{line} --from 25"), ["--from says what a picture shows", "--gantt"])


def test_a_picture_of_one_filter_shows_the_steps_asked_for(sched_sim: Run, tmp_path: Path) -> None:
    assert sched_sim("simulate -N 10 -M 4 --gantt g.svg --from 3 --until 9").code == 0
    assert "steps 3 to 8 of 30" in (tmp_path / "g.svg").read_text()
