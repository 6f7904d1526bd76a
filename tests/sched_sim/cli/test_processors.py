"""`processors` is `minimum` transposed: whatever `minimum` says of a method on a part, `processors` says too."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest

from sched_sim.costs.table_file import load_costs
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.processors.part import on_part
from sched_sim.processors.part_file import load_part, shipped_parts
from tests.command_line import Run, is_refused

TASKS = '[[task]]\nname = "control"\nperiod = 2\ncost_us = 100\npriority = 15\n'


@pytest.mark.parametrize(
    "options",
    [
        "",
        "--gain precomputed",
        "--low-rate-noise sum",
        "--low-rate-noise euler --gain precomputed",
        "--lr-propagate-by l",
        "--feedback same-step",
        "--cpus 2",
        "--context-switch 0.00001",
        "--statistic p95",
        "--tasks tasks.toml",
        "--tasks tasks.toml --gain precomputed --cpus 2",
    ],
)
def test_it_says_what_minimum_says(sched_sim: Run, tmp_path: Path, options: str) -> None:
    (tmp_path / "tasks.toml").write_text(TASKS)
    line = f"-N 10 -M 2 --hr-hz 400 --method dual-rate --method larsen {options} --format json"
    parts = ["cortex-m4f", "leon3"]
    asked = " ".join(f"--processor {part}" for part in parts)
    rows = json.loads(sched_sim(f"processors {asked} {line}").out)
    minimum = [row for part in parts for row in json.loads(sched_sim(f"minimum --processor {part} {line}").out)]
    assert [row.pop("reason") for row in rows] == [None] * 4
    assert {row.pop("cost_unit") for row in minimum} == {"second"}
    assert rows == minimum


def test_a_gain_computed_early_needs_less_of_a_part(sched_sim: Run) -> None:
    """L = M + 1: of the LR update only the correction is left to step m."""
    line = "processors -N 10 -M 4 -L 5 --hr-hz 400 --processor cortex-m4f --format json"
    (late,), (early,) = (json.loads(sched_sim(line + gain).out) for gain in ("", " --gain precomputed"))
    costs = select(on_part(load_costs("counted-9-3-3"), load_part("cortex-m4f")), "dual-rate", EARLY)
    speed = Fraction(early["min_speed_exact"])
    assert early["needed_share"] < late["needed_share"]
    assert simulate(costs, Timing(10, 4, 5), speed, 4, EARLY).misses == 0
    assert simulate(costs, Timing(10, 4, 5), speed * Fraction(999999, 1000000), 4, EARLY).misses > 0


EARLY = Options(gain="precomputed")


def test_a_calibration_gives_a_range_of_what_a_part_needs_and_changes_no_verdict(sched_sim: Run) -> None:
    line = "processors -N 10 -M 4 --hr-hz 400 --format json"
    rows = {row["processor"]: row for row in json.loads(sched_sim(line).out)}
    row = rows["cortex-m4f"]
    assert row["needed_share_least"] == pytest.approx(0.68 * row["needed_share"])
    assert row["needed_share_most"] == pytest.approx(1.05 * row["needed_share"])
    assert row["fits"] == (row["needed_share"] <= 1)
    assert rows["leon3"]["needed_share_least"] is rows["leon3"]["needed_share_most"] is None


def test_the_list_has_the_calibrations(sched_sim: Run) -> None:
    rows = {row["processor"]: row for row in json.loads(sched_sim("processors --format json").out)}
    assert [rows["cortex-m4f"][f"calibration_{key}"] for key in ("least", "most")] == [0.68, 1.05]
    assert rows["leon3"]["calibration_source"] is None
    assert "calibration_least,calibration_most,calibration_source" in sched_sim("processors --format csv").out


@pytest.mark.exhaust
def test_a_task_takes_its_share_of_every_part(sched_sim: Run, tmp_path: Path) -> None:
    """100 us in every second period of 2.5 ms are 2 %, whatever the part."""
    (tmp_path / "tasks.toml").write_text(TASKS)
    line = "processors -N 10 -M 4 --hr-hz 400 --processor leon3 --processor cortex-m7"
    alone, beside = (
        {row["processor"]: row["load"] for row in json.loads(sched_sim(f"{line} {tasks} --format json").out)}
        for tasks in ("", "--tasks tasks.toml")
    )
    assert beside == {part: pytest.approx(share + 0.02) for part, share in alone.items()}
    said = "the tasks of --tasks take the same seconds on every processor"
    assert said in sched_sim(f"{line} --tasks tasks.toml").out


def test_several_methods_are_told_apart(sched_sim: Run) -> None:
    line = "processors -N 10 -M 4 --hr-hz 400 --processor leon3 --method larsen --method dual-rate --method larsen"
    assert [row["method"] for row in json.loads(sched_sim(f"{line} --format json").out)] == ["larsen", "dual-rate"]
    table = sched_sim(line).out
    assert "larsen, dual-rate, HR loop at 400 Hz" in table
    assert "method" in table


MINE = """\
name = "mine"
title = "my own part"
precision = "double"
clock_mhz = {clock_mhz}
logic_per_arithmetic = 0
[cycles]
multiply = 2
add = 1
divide = 10
"""


@pytest.mark.parametrize(
    ("named", "listed"),
    [
        ("", shipped_parts()),
        ("--processor mine.toml", [*shipped_parts(), "mine"]),
        ("--processor leon3", ["leon3"]),
        ("--processor mine.toml --processor leon3 --processor mine.toml", ["leon3", "mine"]),
    ],
)
@pytest.mark.parametrize("design", ["", "-N 10 -M 4 --hr-hz 400"])
def test_a_file_of_ones_own_is_listed_beside_the_others(
    sched_sim: Run, tmp_path: Path, named: str, listed: list[str], design: str
) -> None:
    (tmp_path / "mine.toml").write_text(MINE.format(clock_mhz=100))
    rows = json.loads(sched_sim(f"processors {design} {named} --format json").out)
    assert [row["processor"] for row in rows] == listed


def test_the_table_begins_with_what_just_fits(sched_sim: Run, tmp_path: Path) -> None:
    """What fits, the least slack first; what does not, the nearest first; what is not known."""
    (tmp_path / "mine.toml").write_text(MINE.format(clock_mhz="0.1"))
    (tmp_path / "other.toml").write_text(MINE.format(clock_mhz=1).replace("divide", "sqrt").replace("mine", "other"))
    line = "processors -N 10 -M 4 --hr-hz 400 --processor mine.toml --processor other.toml --method larsen"
    line += " --method dual-rate"
    rows = {(row["processor"], row["method"]): row for row in json.loads(sched_sim(f"{line} --format json").out)}
    table = [text.split() for text in sched_sim(line).out.splitlines()]
    order = [(words[0], words[2]) for words in table if words[1:2] in (["single"], ["double"], ["unstated"])]
    assert sorted(order) == sorted(rows)
    verdicts = [rows[key]["fits"] for key in order]
    assert verdicts == sorted(verdicts, key=[True, False, None].index)
    for fits in (True, False):
        shares = [rows[key]["needed_share"] for key in order if rows[key]["fits"] is fits]
        assert shares == sorted(shares, reverse=fits)
    assert {key[0] for key in order[-2:]} == {"other"}


def test_parts_that_can_do_no_job_of_a_table_are_listed_with_the_reason(sched_sim: Run) -> None:
    line = "processors -N 40 --hr-hz 400 --costs erkf-position --method robust-closed --format json"
    rows = {row["processor"]: row for row in json.loads(sched_sim(line).out)}
    assert rows["leon3"]["fits"] is True
    assert rows["patent"]["fits"] is None
    assert "no time for sqrt" in rows["patent"]["reason"]
    (note,) = (text for text in sched_sim(line.removesuffix("--format json")).out.splitlines() if "no time" in text)
    lacking = [part for part, row in rows.items() if row["fits"] is None]
    assert (
        note == f"no time for sqrt on {', '.join(lacking)}: add it to a copy of the file, see `reason` in --format json"
    )


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("processors --gain precomputed", ["-N is missing"]),
        ("processors --tasks tasks.toml -N 10", ["--hr-hz is missing"]),
        ("processors --cpus 2", ["-N is missing"]),
        ("processors -N 10 -M 4 --hr-hz 400 --gain early", ["--gain", "early", "precomputed"]),
        ("processors -N 10 -M 4 --hr-hz 400 --tasks none.toml", ["--tasks", "none.toml"]),
        ("processors -N 10 -M 4 --hr-hz 400 --tasks two.toml", ["task 'control'", "cpu 2", "--cpus 2"]),
        ("processors -N 10 -M 4 --hr-hz 400 --context-switch -1", ["--context-switch is -1"]),
        ("processors -N 10 -M 4 --hr-hz 400 --method larson", ["--method 'larson'", "larsen"]),
        ("processors -N 10 -M 4 --hr-hz 400 --costs steffes2014", ["steffes2014", "no operation counts", "counted"]),
        ("processors -N 10 --hr-hz 400 --method robust-lu", ["[operations.robust-lu]", "erkf-attitude"]),
        ("minimum -N 10 -M 4 --tasks two.toml", ["task 'control'", "cpu 2", "--cpus 2"]),
        ("simulate -N 10 -M 4 --tasks two.toml", ["task 'control'", "cpu 2", "--cpus 2"]),
        ("gantt -N 10 -M 4 --tasks two.toml", ["task 'control'", "cpu 2", "--cpus 2"]),
        ("minimum -N 40 --costs erkf-position --processor patent", ["'patent'", "no time for sqrt"]),
    ],
)
def test_wrong_input_is_refused(sched_sim: Run, tmp_path: Path, line: str, said: list[str]) -> None:
    (tmp_path / "tasks.toml").write_text(TASKS)
    two = TASKS if line.startswith("processors") else TASKS.replace("cost_us", "cost")
    (tmp_path / "two.toml").write_text(f"{two}cpu = 2\n")
    is_refused(sched_sim(line), said)
