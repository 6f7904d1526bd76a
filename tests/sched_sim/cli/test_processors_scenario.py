"""Which parts run a scenario without a miss: each by its own simulation."""

from __future__ import annotations

import csv
import io
import json
import re
from fractions import Fraction
from pathlib import Path

import pytest

from sched_sim.processors.part_file import shipped_parts
from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario_file import read_scenario
from sched_sim.schedule.outcome import Slice
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
PART = """\
name = "{}"
title = "t"
precision = "double"
logic_per_arithmetic = 0
clock_mhz = 100
[cycles]
multiply = 2
add = 1
divide = 9
"""
TASK = '[[task]]\nname = "control"\nhz = 200\ncost_us = 100\npriority = 15\n'


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


def test_what_fits_comes_first_and_of_these_what_just_does(sched_sim: Run) -> None:
    rows = list(csv.DictReader(io.StringIO(sched_sim("processors --scenario late.toml --format csv").out)))
    fitting = [row for row in rows if row["fits"] == "True"]
    assert 0 < len(fitting) < len(rows)
    assert rows[: len(fitting)] == fitting
    slack = [float(row["slack"]) for row in fitting]
    assert slack == sorted(slack)
    assert {row["slack"] for row in rows[len(fitting) :]} == {""}


def test_slack_is_the_least_share_of_the_time_to_a_deadline_that_is_left(sched_sim: Run) -> None:
    """Of a slice that ends its job, it is what is behind it, up to the deadline."""
    (row,) = json.loads(sched_sim("processors --scenario late.toml --processor cortex-m7 --format json").out)
    margins: dict[str, Fraction] = {}

    def least(piece: Slice) -> None:
        if piece.finished:
            left = Fraction(piece.deadline - piece.end, piece.deadline - piece.release)
            margins[piece.kind] = min(left, margins.get(piece.kind, left))

    outcome = run_scenario(read_scenario("late.toml", processor="cortex-m7"), on_slice=least)
    assert {kind: figures.least_margin for kind, figures in outcome.jobs.items()} == {
        kind: float(margin) for kind, margin in margins.items()
    }
    tightest = min(margins, key=margins.__getitem__)
    assert (row["slack"], row["slack_of"]) == (float(margins[tightest]), tightest)
    out = sched_sim("processors --scenario late.toml --processor cortex-m7").out
    shown = [float(cell) for cell in re.findall(r" ([\d.]+) % ", out)]
    assert any(0 <= 100 * row["slack"] - slack < 0.1 for slack in shown)
    assert tightest in out


def test_of_a_part_that_misses_something_there_is_no_slack(sched_sim: Run) -> None:
    line = "processors --scenario late.toml --processor rp2040"
    (row,) = json.loads(sched_sim(f"{line} --format json").out)
    assert row["misses"] > 0
    assert row["slack"] is row["slack_of"] is None
    assert " none " in sched_sim(line).out
    jobs = run_scenario(read_scenario("late.toml", processor="rp2040")).jobs
    margins = [figures.least_margin for figures in jobs.values() if figures.misses and figures.responses]
    assert all(margin is not None and margin < 0 for margin in margins)


def test_parts_without_a_time_stand_in_one_line(sched_sim: Run) -> None:
    counts = Path("counts.toml")
    counts.write_text(counts.read_text().replace("divide = 9", "divide = 9, sqrt = 2"))
    for other in ("mine", "other"):
        Path(f"{other}.toml").write_text(PART.format(other).replace("divide = 9\n", ""))
    line = "processors --scenario late.toml --processor leon3 --processor mine.toml --processor other.toml"
    out = sched_sim(line).out
    said = "no time for divide and sqrt on mine, other: add it to a copy of the file, see `reason` in --format"
    assert said in out
    assert sum("no time" in text for text in out.splitlines()) == 1
    rows = json.loads(sched_sim(f"{line} --format json").out)
    assert ["gives no time for divide and sqrt" in (row["reason"] or "") for row in rows] == [False, True, True]


def test_a_table_for_scripts_has_the_landings_of_each_sensor_in_columns(sched_sim: Run) -> None:
    """Also where one of the parts has no time for an operation."""
    Path("late.toml").write_text(SCENARIO + '[[sensor]]\nname = "camera"\nhz = 20\ncost_us = 20\n')
    counts = Path("counts.toml")
    counts.write_text(counts.read_text().replace("divide = 9", "divide = 9, sqrt = 2"))
    Path("mine.toml").write_text(PART.format("mine"))
    line = "processors --scenario late.toml --processor leon3 --processor mine.toml --format"
    rows = list(csv.DictReader(io.StringIO(sched_sim(f"{line} csv").out)))
    known, unknown = json.loads(sched_sim(f"{line} json").out)
    for key in ("latest_l", "correction_ms"):
        for sensor in ("gps", "camera"):
            assert float(rows[0][f"{key}_{sensor}"]) == known[key][sensor]
            assert rows[1][f"{key}_{sensor}"] == ""
        assert unknown[key] is None
    assert not {"latest_l", "correction_ms"} & rows[0].keys()


def test_a_processor_of_ones_own_has_the_name_that_its_file_gives_it(sched_sim: Run) -> None:
    Path("board.toml").write_text(PART.format("mine"))
    line = "--processor cortex-m7 --processor board.toml --format json"
    for command in ("processors --scenario late.toml", "processors -N 40 -M 20 --hr-hz 100", "processors"):
        rows = json.loads(sched_sim(f"{command} {line}").out)
        assert {row["processor"] for row in rows} == {"cortex-m7", "mine"}


def test_what_the_file_states_is_the_same_on_every_part_and_is_named(sched_sim: Run) -> None:
    Path("late.toml").write_text(SCENARIO + "[predictor]\ncost_us = 5\n" + TASK)
    out = sched_sim("processors --scenario late.toml --processor leon3 --processor cortex-m7").out
    assert "as long on every processor, as the file states: predict, control" in out
    assert "as the file states" not in sched_sim("processors --scenario late.toml --processor leon3").out


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
    stated = SCENARIO + "cost_us = 9\n[predictor]\ncost_us = 5\n"
    for text in (stated, stated.replace('costs = "counts.toml"', "")):
        Path("late.toml").write_text(text)
        said = ["all costs are stated, as times", "the same on every processor", "`sched-sim simulate --scenario FILE`"]
        is_refused(sched_sim("processors --scenario late.toml"), [*said, "leave out these costs", "--backend counted"])


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ([('costs = "counts.toml"', "")], ["needs counted operations, and there are none", "costs = ..."]),
        (
            [
                ("hr_hz = 400\nduration_s = 1", "speed = 1\nsteps = 400"),
                ('costs = "counts.toml"', "[predictor]\ncost = 0.1"),
                ("hz = 5", "every = 80\ncost = 0.2"),
                ("delay_ms = { least = 80, most = 120 }", ""),
            ],
            ["all costs are stated, in units", "`speed`", "give hr_hz"],
        ),
    ],
)
def test_a_scenario_that_no_part_can_run_is_refused_once(
    sched_sim: Run, changes: list[tuple[str, str]], said: list[str]
) -> None:
    text = SCENARIO
    for old, new in changes:
        text = text.replace(old, new)
    Path("late.toml").write_text(text)
    result = sched_sim("processors --scenario late.toml")
    is_refused(result, said)
    assert not any(part in result.err for part in shipped_parts())


def test_measured_times_are_of_no_part(sched_sim: Run) -> None:
    Path("counts.toml").write_text('name = "t"\nunit = "us"\n[samples]\npredict = [5]\n[samples.correct]\ngps = [9]\n')
    is_refused(sched_sim("processors --scenario late.toml"), ["no [operations]", "leave the processor out"])


def test_the_two_tasks_of_the_dual_rate_filter_have_a_verdict_too(sched_sim: Run, tmp_path: Path) -> None:
    parts = "hr_propagate = { multiply = 900 }\nhr_restart = { add = 90 }\nhr_update = { add = 90 }\n"
    parts += "lr_propagate = { multiply = 900 }\n"
    for kind in ("gain", "lr_correct", "hr_pass"):
        parts += f"[operations.{kind}]\ngps = {{ multiply = 100 }}\n"
    (tmp_path / "counts.toml").write_text(f'name = "c"\nunit = "operation"\n[operations]\n{parts}')
    (tmp_path / "late.toml").write_text(f'late = "dual-rate"\n{SCENARIO}')
    (tmp_path / "mine.toml").write_text(PART.format("mine"))
    rows = json.loads(sched_sim("processors --scenario late.toml --processor mine.toml --format json").out)
    (row,) = [row for row in rows if row["processor"] == "mine"]
    scenario = read_scenario("late.toml", processor="mine.toml")
    lags = [delay or 0 for _, delay in scenario.sensors[0].measurements(scenario.steps, scenario.seed)]
    assert (row["fits"], row["misses"], row["latest_l"]) == (True, 0, {"gps": 1 + max(lags)})
    assert row["slack_of"] == "predict"
    assert row["slack"] == pytest.approx(1 - 18e-6 * 400, abs=1e-3)
