"""`sched-sim simulate --scenario` with `--engine` and `--rare`."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import pytest

from sched_sim.scenario.engine import splitting
from tests.command_line import Run, is_refused
from tests.scenarios import ROCKET

TWO_LONG_ONES = """\
name = "log"
speed = 30
steps = 40
[predictor]
cost = [10, 10, 10, 10, 10, 29]
[[sensor]]
name = "gps"
every = 100
cost = 1
[[task]]
name = "log"
period = 2
cost = 15
priority = 30
offset = 0
"""
"""Of the six, two long ones in a row leave the task too little."""
SAMPLED = """\
name = "m"
unit = "second"
backend = "compiled"
[samples]
predict = [1e-6]
correct.gps = [1e-6]
"""
OF_SAMPLES = 'name = "m"\nhr_hz = 100\nsteps = 9\ncosts = "c.toml"\n[predictor]\n[[sensor]]\nname = "gps"\nevery = 3\n'


@pytest.mark.parametrize("format", ["table", "json", "csv"])
def test_both_engines_print_the_same(format: str, sched_sim: Run) -> None:
    line = f"simulate --scenario {ROCKET} --format {format} --engine"
    printed = [sched_sim(f"{line} {engine}") for engine in ("simpy", "compiled")]
    assert printed[0] == printed[1]
    assert printed[0].code == 0


def test_traces_are_simpys(sched_sim: Run, tmp_path: Path) -> None:
    line = f"simulate --scenario {ROCKET} --trace t.csv --engine"
    is_refused(sched_sim(f"{line} compiled"), ["--engine compiled has no slices"])
    assert sched_sim(f"{line} auto").code == 0
    assert (tmp_path / "t.csv").stat().st_size


def test_rare_misses_of_what_never_missed(sched_sim: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """From seed 0 no job misses; the predict jobs never do."""
    monkeypatch.setattr(splitting, "MOST_PILOTS", splitting.NEXT_PILOTS)
    (tmp_path / "s.toml").write_text(TWO_LONG_ONES)
    line = "simulate --scenario s.toml --rare --format"
    document = json.loads(sched_sim(f"{line} json").out)
    rare = document["rare"]
    assert rare.keys() == {"predict", "correct gps", "task:log"}
    assert rare["predict"]["miss_probability"] is None
    least, most = rare["task:log"]["miss_interval"]
    assert 0.02 < least < rare["task:log"]["miss_probability"] < most < 0.06
    of_log = next(row for row in csv.DictReader(io.StringIO(sched_sim(f"{line} csv").out)) if row["job"] == "task:log")
    assert [float(of_log[f"rare_miss_{name}"]) for name in ("least", "most")] == [least, most]
    assert of_log["miss_probability"] == ""
    people = sched_sim(f"{line} table").out
    assert "Misses that one simulation does not show" in people
    assert people.count("not resolved ") == 3 + 2  # of all in the simulation, of two by splitting


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("simulate -N 10 -M 4 --rare", "--rare is of a scenario: give --scenario FILE.toml too"),
        (
            "simulate --scenario s.toml --rare",
            "--rare asks for P(miss); from samples of `measure --filter` none",
        ),
    ],
)
def test_rare_is_refused(line: str, said: str, sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(OF_SAMPLES)
    (tmp_path / "c.toml").write_text(SAMPLED)
    is_refused(sched_sim(line), [said])
