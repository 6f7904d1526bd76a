"""Which parts run a scenario without a miss: each by its own simulation."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import pytest

from sched_sim.processors.part_file import shipped_parts
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario_file import read_scenario
from tests.command_line import Run, is_refused

SCENARIO = """\
name = "late GPS"
hr_hz = 400
duration_s = 1
costs = "counts.toml"
[[sensor]]
name = "gps"
hz = 5
delay_ms = { least = 80, most = 120 }
"""
COUNTS = """\
name = "counts"
unit = "operation"
[operations]
predict = { multiply = 900, add = 800 }
[operations.correct]
gps = { multiply = 2500, add = 2300, divide = 9 }
"""


@pytest.fixture(autouse=True)
def files(tmp_path: Path) -> None:
    (tmp_path / "late.toml").write_text(SCENARIO)
    (tmp_path / "counts.toml").write_text(COUNTS)


def test_each_part_has_the_verdict_of_its_own_simulation(sched_sim: Run) -> None:
    rows = json.loads(sched_sim("processors --scenario late.toml --format json").out)
    assert sorted(row["processor"] for row in rows) == shipped_parts()
    for row in rows:
        if row["fits"] is None:
            assert row["processor"] in row["reason"]
            continue
        outcome = run_scenario(read_scenario("late.toml", processor=row["processor"]))
        assert row["fits"] == (outcome.misses == 0)
        assert row["misses"] == outcome.misses
        assert row["utilization"] == float(outcome.schedule.utilization)
        assert row["latest_l"] == {"gps": max(outcome.sensors["gps"].achieved, default=None)}


def test_what_fits_comes_first_and_of_these_the_busiest(sched_sim: Run) -> None:
    rows = list(csv.DictReader(io.StringIO(sched_sim("processors --scenario late.toml --format csv").out)))
    fitting = [row for row in rows if row["fits"] == "True"]
    assert 0 < len(fitting) < len(rows)
    assert rows[: len(fitting)] == fitting
    busy = [float(row["utilization"]) for row in fitting]
    assert busy == sorted(busy, reverse=True)


def test_a_person_is_told_when_the_corrections_land(sched_sim: Run) -> None:
    out = sched_sim("processors --scenario late.toml --processor cortex-m7").out
    latest = max(run_scenario(read_scenario("late.toml", processor="cortex-m7")).sensors["gps"].achieved)
    assert "gps lands, ms" in out
    assert f" {latest * 2.5:g} " in out


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("-N 10", ["-N and --scenario late.toml exclude each other"]),
        ("--hr-hz 400 --method larsen", ["--hr-hz, --method and --scenario"]),
        ("--processor none.toml", ["none.toml"]),
    ],
)
def test_what_does_not_go_together_is_refused(sched_sim: Run, line: str, said: list[str]) -> None:
    is_refused(sched_sim(f"processors --scenario late.toml {line}"), said)


def test_costs_that_are_times_are_of_one_processor(sched_sim: Run) -> None:
    Path("late.toml").write_text(
        SCENARIO.replace('costs = "counts.toml"', "[predictor]\ncost_us = 5") + "cost_us = 9\n"
    )
    said = [
        "--scenario 'late.toml': it names no costs file, and stated costs take the same time on every processor",
        '`sched-sim measure --filter ... --backend counted --output counts.toml`, and write costs = "counts.toml"',
        "`sched-sim simulate --scenario`",
    ]
    is_refused(sched_sim("processors --scenario late.toml"), said)
