"""Numbers, files and simulations of any size end with one message, before anything computes with them."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import pytest

from sched_sim.bounds import short
from sched_sim.errors import InputError
from sched_sim.scenario.scenario_file import read_scenario
from sched_sim.ticks import exact
from tests.command_line import Run, is_refused

COSTS = 'name = "c"\nunit = "u"\n[costs.standard]\nupdate = 1\npropagate = '
TASK = '[[task]]\nname = "t"\ncost = 0.1\npriority = 5\nperiod = '


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("simulate -N 9223372036854775807 -M 4", ["-N", "9223372036854775807", "10,000,000"]),
        (f"simulate -N {'1' * 4301} -M 4", ["-N", "1111 ... 1111"]),
        ("simulate -N 10 -M 4 --cycles 1000000000000", ["--cycles", "1000000000000", "10,000,000"]),
        ("simulate -N 10 -M 4 --speed 1 --cycles 1000001", ["1000001 cycles", "N=10", "10,000,000"]),
        (f"simulate -N 10 -M 4 --speed {'1' * 400}", ["--speed", "50 digits"]),
        ("simulate -N 10 -M 4 --speed 1e999999999", ["--speed", "1e999999999", "1e18"]),
        ("simulate -N 10 -M 4 --speed 1e99999999999999999999", ["--speed", "1e99999999999999999999"]),
        ("sweep -N 1:1000000", ["-N", "pairs", "10,000,000"]),
        ("sweep -N 10000001", ["-N", "10000001"]),
        ("sweep -N 4 --speed 1:1e9:1", ["--speed", "1,000,000"]),
        ("measure --states 100000", ["--states", "100000"]),
    ],
)
def test_options(sched_sim: Run, line: str, said: list[str]) -> None:
    is_refused(sched_sim(line), said)


@pytest.mark.parametrize(
    ("number", "said"),
    [
        ("1" * 4301, "too long"),
        ("1" * 400, "costs.standard.propagate is about 1e399"),
        ("0." + "1" * 400, "costs.standard.propagate"),
        ("1e99", "costs.standard.propagate"),
        ("1e999999999", "costs.standard.propagate"),
        ("1e99999999999999999999", "too long"),
        ("[" * 3000 + "]" * 3000, "nested too deep"),
        ("1\n" + "a." * 3000 + "b = 1", "nested too deep"),
    ],
)
def test_numbers_and_nesting_in_files(sched_sim: Run, tmp_path: Path, number: str, said: str) -> None:
    (tmp_path / "c.toml").write_text(COSTS + number)
    is_refused(sched_sim("minimum -N 10 -M 4 --costs c.toml"), ["c.toml", said])


def test_thirty_digits_stay_exact() -> None:
    assert exact("0." + "3" * 30, "cost") == exact("3" * 30 + "/1" + "0" * 30, "cost")


@pytest.mark.parametrize("option", ["--costs", "--tasks", "--processor"])
def test_only_regular_files_are_read(sched_sim: Run, tmp_path: Path, option: str) -> None:
    os.mkfifo(tmp_path / "fifo.toml")
    (tmp_path / "loop.toml").symlink_to("loop.toml")
    line = f"minimum -N 10 -M 4 {option}"
    is_refused(sched_sim(f"{line} /dev/zero"), ["/dev/zero", "no regular file"])
    is_refused(sched_sim(f"{line} fifo.toml"), ["fifo.toml", "no regular file"])
    is_refused(sched_sim(f"{line} loop.toml"), ["loop.toml", "cannot be read"])
    is_refused(sched_sim(f"{line} {'a' * 300}"), ["aaa", "cannot be read"])


def test_a_large_file_is_not_read(sched_sim: Run, tmp_path: Path) -> None:
    with (tmp_path / "c.toml").open("wb") as file:
        file.truncate(10**9)
    is_refused(sched_sim("minimum -N 10 -M 4 --costs c.toml"), ["c.toml", "1,000,000,000 bytes", "64,000,000"])


@pytest.mark.parametrize(
    "command",
    [
        "simulate --speed 1",
        "gantt --speed 1",
        "minimum",
        "simulate",
        "gantt",
        "sweep",
        "processors --hr-hz 400 --processor leon3",
    ],
)
def test_tasks_that_release_jobs_without_end(sched_sim: Run, tmp_path: Path, command: str) -> None:
    costs = TASK.replace("cost", "cost_us") if command.startswith("processors") else TASK
    for offset in ('"any"', "0"):
        (tmp_path / "t.toml").write_text(f"{costs}1e-18\noffset = {offset}\n")
        said = ["'t'", "alone needs"] if command.startswith("processors") else ["'t'", "1e-18", "check its period"]
        is_refused(sched_sim(f"{command} -N 10 -M 4 --tasks t.toml"), said)


def test_values_in_messages_are_short() -> None:
    assert short(10**5000) == "about 1e5000"
    assert short("x") == "x"
    assert len(short("x" * 5000)) < 70
    with pytest.raises(InputError, match="about -1e60"):
        exact(-(10**60), "--speed")


@pytest.mark.parametrize(
    ("command", "count", "said"),
    [
        ("minimum", 1001, ["1,001 tasks", "at most 1,000"]),
        ("gantt", 1001, ["1,001 tasks"]),
        ("gantt --speed 100", 400, ["m high", "leave out tasks"]),
        ("minimum", 800, ["only after about 1e", "t9 10, ...)"]),
    ],
)
def test_more_tasks_than_anyone_has(sched_sim: Run, tmp_path: Path, command: str, count: int, said: list[str]) -> None:
    entry = '[[task]]\nname = "t{}"\ncost = 0.001\npriority = 5\noffset = 0\nperiod = {}\n'
    (tmp_path / "t.toml").write_text("".join(entry.format(number, number + 1) for number in range(count)))
    is_refused(sched_sim(f"{command} -N 10 -M 4 --tasks t.toml"), said)


def test_more_sensors_than_any_filter_has(sched_sim: Run, tmp_path: Path) -> None:
    head = 'name = "s"\nsteps = 9\nspeed = 1000\n[predictor]\ncost = 1\n'
    entries = [f'[[sensor]]\nname = "s{number}"\nevery = 3\ncost = 1\n' for number in range(101)]
    (tmp_path / "s.toml").write_text(head + "".join(entries))
    is_refused(sched_sim("simulate --scenario s.toml"), ["s.toml", "there are 101 sensors: give at most 100"])
    (tmp_path / "s.toml").write_text(head + "".join(entries[:100]))
    scenario = read_scenario(tmp_path / "s.toml")
    more = [*scenario.sensors, replace(scenario.sensors[0], name="another")]
    costs = {**scenario.costs, "correct.another": [1]}
    with pytest.raises(InputError, match="there are 101 sensors: give at most 100"):
        replace(scenario, sensors=more, costs=costs)


def test_more_workers_than_any_machine_runs(sched_sim: Run) -> None:
    is_refused(sched_sim("sweep -N 4 --workers 1000000000"), ["--workers", "1000"])


@pytest.mark.parametrize("cost", ["1e-300", "1e999999999"])
def test_a_cost_that_no_unit_gives_is_told_the_range(sched_sim: Run, tmp_path: Path, cost: str) -> None:
    (tmp_path / "mine.toml").write_text(f'name = "m"\nunit = "ms"\n[costs.standard]\npropagate = {cost}\nupdate = 1\n')
    refused = sched_sim("minimum -N 4 -M 1 --costs mine.toml")
    assert refused.code == 2
    assert "give a number between 1e-18 and 1e18" in refused.err


def test_whatever_is_wrong_with_a_task_the_file_is_named(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "t.toml").write_text('[[task]]\nname = "a"\nperiod = 2\ncost = 1\npriority = 5\noffset = -1\n')
    refused = sched_sim("minimum -N 4 -M 1 --tasks t.toml")
    assert refused.code == 2
    assert "--tasks 't.toml': task 'a': offset -1" in refused.err
