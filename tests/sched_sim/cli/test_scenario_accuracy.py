"""`simulate --scenario` with a model: what it shows of the accuracy, and what it refuses."""

from __future__ import annotations

import csv
import io
import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from filters.accuracy import lossless
from sched_sim.scenario.accuracy_asked import AccuracyAsked, Seen
from sched_sim.scenario.scenario_file import read_scenario
from tests.command_line import Run, is_refused
from tests.filters.accuracy.cases import INS, POSITION, SCALAR

SCENARIO = """\
name = "inertial and GPS"
hr_hz = 400
steps = 8000
[predictor]
cost_us = 300
[[sensor]]
name = "gps"
hz = 5
delay_ms = 110
cost_us = 500
"""
MODELS = """\
import numpy as np
from filters.accuracy import SensorsModel, linear_model

def wrong(): return SensorsModel(np.eye(2), np.eye(2), {"GPS": ([[1, 0]], [[1]])})
def nan(): return SensorsModel([[1, np.nan], [0, 1]], np.eye(2), {"gps": ([[1, 0]], [[1]])})
def singular(): return SensorsModel(np.eye(2), np.eye(2), {"gps": ([[1, 0], [1, 0]], np.ones((2, 2)))})
def hidden(): return SensorsModel(np.eye(2), np.eye(2), {"gps": ([[1, 0]], [[1]])})
def one(): return linear_model([[1]], [[0.01]], [[1]], [[1]])
def nothing(): return None
def fails(): raise ValueError("no file")
"""


@pytest.fixture(autouse=True)
def files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    (tmp_path / "s.toml").write_text(SCENARIO)
    (tmp_path / "models.py").write_text(MODELS)
    monkeypatch.chdir(tmp_path)
    yield
    __import__("sys").modules.pop("models", None)


def exact(L: int) -> float:
    return lossless(INS, POSITION, 80, L).worst


def test_json_has_the_accuracy_and_the_ages(sched_sim: Run) -> None:
    found = json.loads(sched_sim("simulate --scenario s.toml --model ins-gps --format json").out)["accuracy"]
    assert (found["model"], found["output"], found["unit"], found["linearised"]) == ("ins-gps", "position", "m", False)
    assert found["worst_std"] == pytest.approx(exact(51), rel=1e-9)
    assert (found["from_step"], found["to_step"], found["from_ms"]) == (51, 7999, 127.5)
    assert found["median_std"] < found["p95_std"] < found["worst_std"]
    ages = found["ages"]["gps"]
    assert ages.keys() == {"age_median_ms", "age_p95_ms", "age_worst_ms"}
    assert ages["age_worst_ms"] == 2.5 * (51 + 79)


def test_a_processor_twice_as_slow_costs_so_much_of_the_accuracy(sched_sim: Run) -> None:
    command = "simulate --scenario s.toml --model ins-gps --times-slower 2"
    found = json.loads(sched_sim(f"{command} --format json").out)["accuracy"]
    (slower,) = found["slower"]
    assert slower["times_slower"] == 2
    assert slower["worst_std"] == pytest.approx(exact(64), rel=1e-9)
    assert slower["over_worst"] == pytest.approx(exact(64) / exact(51) - 1, rel=1e-9)
    assert slower["ages"]["gps"]["age_worst_ms"] == 2.5 * (64 + 79)
    said = " ".join(sched_sim(command).out.split())
    over = f"{100 * (exact(64) / exact(51) - 1):.2f} %"
    assert "a processor 2 times as slow: the standard deviation of position is higher by: median" in said
    assert f"worst {over}" in said
    assert "all over steps 64 to 7999, with the same draws" in said


def test_csv_has_columns_of_it(sched_sim: Run) -> None:
    rows = list(csv.DictReader(io.StringIO(sched_sim("simulate --scenario s.toml --model ins-gps --format csv").out)))
    assert [row["job"] for row in rows] == ["predict", "correct gps"]
    assert {row["worst_std"] for row in rows} == {rows[0]["worst_std"]}
    assert [row["age_worst_ms"] for row in rows] == ["", str(2.5 * (51 + 79))]
    command = "simulate --scenario s.toml --model ins-gps --times-slower 2 --times-slower 1.5 --format csv"
    rows = list(csv.DictReader(io.StringIO(sched_sim(command).out)))
    assert [row["times_slower"] for row in rows] == ["1.0", "2.0", "1.5"]
    assert rows[0]["over_worst"] == "0.0" < rows[2]["over_worst"] < rows[1]["over_worst"]
    assert rows[1]["gps age_worst_ms"] == str(2.5 * (64 + 79))


def test_without_a_rate_ages_are_in_steps(sched_sim: Run, tmp_path: Path) -> None:
    without = SCENARIO.replace("hr_hz = 400", "speed = 10").replace("cost_us = ", "cost = ").replace("300", "3")
    without = without.replace("500", "5").replace("hz = 5", "every = 10").replace("delay_ms = 110", "delay = 4")
    (tmp_path / "s.toml").write_text(without)
    result = sched_sim("simulate --scenario s.toml --model models:one --output 0")
    assert re.search(r"age of gps +steps +\d", result.out)
    found = json.loads(sched_sim("simulate --scenario s.toml --model models:one --output x=0 --format json").out)
    (L,) = map(int, found["sensors"]["gps"]["achieved_l"])
    assert found["accuracy"]["worst_std"] == pytest.approx(lossless(SCALAR, [0], 10, L).worst, rel=1e-9)
    assert found["accuracy"]["ages"]["gps"] == {
        "age_median_steps": pytest.approx(L + 4.5, abs=0.5),
        "age_p95_steps": L + 9,
        "age_worst_steps": L + 9,
    }


def test_the_file_may_ask(sched_sim: Run, tmp_path: Path) -> None:
    asked = """
[accuracy]
model = "ins-gps"
output = "velocity"
initial_std = [1, 1, 1, 0.5, 0.5, 0.5, 0.01, 0.01, "1/50"]
[accuracy.sensors.gps]
R = [[0.25, 0, 0], [0, 0.25, 0], [0, 0, 1]]
"""
    (tmp_path / "s.toml").write_text(SCENARIO + asked)
    assert read_scenario("s.toml").accuracy == AccuracyAsked(
        "ins-gps",
        "velocity",
        None,
        (1, 1, 1, 0.5, 0.5, 0.5, 0.01, 0.01, 0.02),
        {"gps": Seen(None, ((0.25, 0, 0), (0, 0.25, 0), (0, 0, 1)))},
    )
    found = json.loads(sched_sim("simulate --scenario s.toml --format json").out)["accuracy"]
    assert (found["output"], found["unit"]) == ("velocity", "m/s")
    other = json.loads(sched_sim("simulate --scenario s.toml --output position --unit m --format json").out)
    assert (other["accuracy"]["output"], other["accuracy"]["unit"]) == ("position", "m")


def test_a_model_of_the_file_is_looked_for_beside_it(sched_sim: Run, tmp_path: Path) -> None:
    folder = tmp_path / "there"
    folder.mkdir()
    (tmp_path / "models.py").rename(folder / "models.py")
    (folder / "s.toml").write_text(f'{SCENARIO}[accuracy]\nmodel = "models:one"\noutput = "x=0"\n')
    assert "age of gps" in sched_sim("simulate --scenario there/s.toml").out


def test_parts_are_compared(sched_sim: Run, tmp_path: Path) -> None:
    counts = 'name = "c"\nunit = "operation"\n[operations]\npredict = { multiply = 9000, add = 9000 }\n'
    (tmp_path / "c.toml").write_text(f"{counts}[operations.correct]\ngps = {{ multiply = 3000, add = 3000 }}\n")
    uncosted = re.sub("cost_us = .*\n", "", SCENARIO).replace("steps", 'costs = "c.toml"\nsteps')
    (tmp_path / "s.toml").write_text(f'{uncosted}[accuracy]\nmodel = "ins-gps"\n')
    command = "processors --scenario s.toml --processor desktop --processor cortex-m7 --processor cortex-m4f"
    rows = {row["processor"]: row for row in json.loads(sched_sim(f"{command} --format json").out)}
    for row in rows.values():
        assert row["worst_std"] == pytest.approx(exact(row["latest_l"]["gps"]), rel=1e-9)
        assert (row["output"], row["output_unit"]) == ("position", "m")
    assert rows["desktop"]["worst_std"] < rows["cortex-m4f"]["worst_std"]
    said = sched_sim(command).out
    assert "worst std, m" in said
    assert "std: of position, steps" in said


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (
            "--model models:wrong --output 0",
            ["--model 'models:wrong' has no sensor 'gps', but GPS", "[accuracy.sensors"],
        ),
        ("--model models:nan --output 0", ["--model 'models:nan': Phi holds a value that is not finite, at [0, 1]"]),
        ("--model models:singular --output 0", ["'models:singular': sensor 'gps': R", "not positive definite"]),
        ("--model models:hidden --output 0,1", ["--output", "state 1", "without bound", "--initial-std"]),
        ("--model models:hidden --output x=1:5", ["--output x=1:5", "not of this model, which has the states 0 to 1"]),
        ("--model models:hidden", ["--output is missing", "states 0 to 1"]),
        ("--model models:nothing --output 0", ["nothing() returned a NoneType", "SensorsModel"]),
        (
            "--model models:fails --output 0",
            ["--model 'models:fails': fails() failed: ValueError: no file (models.py, line "],
        ),
        ("--model models:none --output 0", ["has no function 'none'"]),
        ("--model nope --output 0", ["--model 'nope' is unknown", "ins-gps"]),
        ("--output 0", ["--model is missing"]),
        ("--unit m", ["--model", "[accuracy]"]),
        ("--times-slower 2", ["--times-slower", "--model", "[accuracy]"]),
        ("--model ins-gps --times-slower 0", ["--times-slower is 0"]),
        ("--model ins-gps --times-slower x", ["--times-slower is 'x'"]),
        ("--model ins-gps --initial-std 1,2", ["--initial-std", "9 numbers"]),
        ("--model ins-gps --initial-std 1,x", ["--initial-std is 'x'"]),
        (f"--model ins-gps --initial-std {','.join(['-1'] * 9)}", ["--initial-std", "0 or more"]),
    ],
)
def test_what_cannot_be_is_refused(sched_sim: Run, options: str, said: list[str]) -> None:
    is_refused(sched_sim(f"simulate --scenario s.toml {options}"), said)


@pytest.mark.parametrize(
    ("entry", "said"),
    [
        ('modle = "x"', ["accuracy.modle", "did you mean model?"]),
        ("initial_std = 3", ["accuracy.initial_std", "must be a list of numbers"]),
        ("initial_std = [1, true]", ["accuracy.initial_std", "entry 1"]),
        ("sensors.gps = { H = [[1, 2], [1]] }", ["accuracy.sensors", "H", "different lengths"]),
        ('sensors.gps = { H = [["x"]] }', ["accuracy.sensors", "row 0, entry 0", "must be a number"]),
        ("sensors.gps = { R = 1 }", ["accuracy.sensors", "must be a matrix"]),
        ('model = "models:wrong"\noutput = "0"', ["[accuracy] model 'models:wrong' has no sensor 'gps'"]),
        ('model = "models:one"\noutput = "3"', ["[accuracy] output 3"]),
        ('model = "models:one"', ["--output is missing"]),
    ],
)
def test_what_the_file_asks_and_cannot_be_is_refused(
    sched_sim: Run, tmp_path: Path, entry: str, said: list[str]
) -> None:
    (tmp_path / "s.toml").write_text(f"{SCENARIO}[accuracy]\n{entry}\n")
    is_refused(sched_sim("simulate --scenario s.toml"), said)


def test_it_is_of_a_scenario(sched_sim: Run) -> None:
    is_refused(sched_sim("simulate -N 10 -M 4 --model ins-gps"), ["--model", "--scenario", "sched-sim accuracy"])
