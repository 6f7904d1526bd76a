"""Tasks beside the filter, on the command line: `--tasks`."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.command_line import Run, is_refused

DESIGN = "-N 10 -M 4 -L 8 --costs steffes2014"


def test_user_tasks_take_part(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "tasks.toml").write_text('[[task]]\nname = "control"\nperiod = 2\ncost = 0.1\npriority = 5\n')
    alone = json.loads(sched_sim(f"minimum {DESIGN} --format json").out)[-1]
    shared = json.loads(sched_sim(f"minimum {DESIGN} --format json --tasks tasks.toml").out)[-1]
    assert shared["min_speed"] == pytest.approx(alone["min_speed"] + 0.2 / 4)  # twice in the four steps from m to l


def test_with_tasks_the_landing_is_the_simulated_one_and_too_few_cycles_are_told(
    sched_sim: Run, tmp_path: Path
) -> None:
    """Two tasks that meet the measurements only after 91 cycles: three cycles do not show it all, of misses either."""
    task = '[[task]]\nname = "{}"\nperiod = {}\ncost = 0.1\npriority = {}\n'
    task += "offset = 0\n"
    (tmp_path / "tasks.toml").write_text(task.format("a", 7, 5) + task.format("b", 13, 15))
    line = "-N 10 -M 4 --method larsen --tasks tasks.toml --format json"
    assert json.loads(sched_sim(f"minimum {line} --hr-hz 400").out)[0]["correction_ms_at_min_speed"] == 10.0
    assert "with these tasks all is seen after 91: --cycles 91" in sched_sim(f"simulate {line} --speed 1.8").err
    (tmp_path / "tasks.toml").write_text(task.format("c", 11, 5))  # first released with the update of m in step 44
    later = sched_sim(f"simulate {line} --speed 1.56")
    assert json.loads(later.out)["misses"] == 0
    assert "a deadline is missed within 7: --cycles 7" in later.err


def test_a_simulation_says_where_tasks_of_any_phase_are_released_and_what_may_be_late_elsewhere(
    sched_sim: Run, tmp_path: Path
) -> None:
    """At 1.26 only the step of the correction is full, and at 1.25 late where the task meets it: not at step 0."""
    task = '[[task]]\nname = "control"\nperiod = 4\ncost = 0.6\npriority = 5\n'
    (tmp_path / "tasks.toml").write_text(task)
    line = "simulate -N 40 -M 13 --method {} --tasks tasks.toml"
    full = sched_sim(line.format("larsen"))
    assert full.err == (
        "Note: tasks of any phase are released together at step 13, the worst for the job with the least slack, not "
        "for the landing\n"
    )
    late = sched_sim(line.format("dual-rate --speed 1.25")).err.splitlines()
    assert late[0].startswith("Note: tasks of any phase are released together at step ")
    assert late[1:] == ["Note: at another phase of the tasks one HR job may be late"]
    (tmp_path / "tasks.toml").write_text(task + "jitter = 1\n")
    waits = sched_sim(line.format("larsen --format json"))
    load = (0.45 * 40 + 0.21 * 12 + 0.81) / 40 + 0.6 / 4
    speed = json.loads(waits.out)["speed"]
    assert "; control: with jitter, and not released before: the processor is busy for less than the load" in waits.err
    assert waits.err.endswith(f", {100 * load / speed:.3g} %\n")


@pytest.mark.parametrize(("priority", "blocks"), [(30, True), (10, False), (5, False)])
def test_a_task_that_nothing_interrupts_would_block_from_just_before(
    sched_sim: Run, tmp_path: Path, priority: int, blocks: bool
) -> None:
    """At one instant the HR job goes first, and a task that is as urgent, or more, delays it as it is."""
    task = f'[[task]]\nname = "flash"\nperiod = 40\ncost = 0.6\npriority = {priority}\npreemptive = false\n'
    (tmp_path / "tasks.toml").write_text(task)
    line = "-N 40 -M 13 --method larsen --speed 2.07 --tasks tasks.toml"
    said = "; flash: not preemptive, and would block more if released just before\n"
    assert sched_sim(f"simulate {line}").err.endswith(said) == blocks
    drawn = sched_sim("gantt -N 40 -M 13 --speed 2.07 --tasks tasks.toml").err
    assert drawn.count(said) == (2 if blocks else 0)
    assert drawn.count("the worst for the job with the least slack, not for the landing") == 2


@pytest.mark.parametrize(
    ("entry", "line", "said"),
    [
        ("cost_us = 1\ncpu = 2", "minimum -N 40 -M 13 --processor leon3 --hr-hz 400", "task 't': cpu 2 is not there"),
        ("cost_us = 1\ncpu = 2", "simulate -N 40 -M 13 --processor leon3 --hr-hz 400", "task 't': cpu 2 is not there"),
        ("cost_ms = 40", "processors -N 40 -M 13 --hr-hz 400", "task 't' alone needs 400 % of the processor"),
        (
            "cost_us = 1\noffset_ms = 1e10",
            "minimum -N 40 -M 13 --processor leon3 --hr-hz 400",
            "task 't': offset 4e+09 is more than the 200000 HR periods that are simulated: give one below its period, "
            "4 (an HR period is 2.5 ms)",
        ),
        ("cost_ms = 40\noffset_ms = -1", "processors -N 40 -M 13 --hr-hz 400", "task 't': offset_ms = -1 must be 0"),
    ],
)
def test_what_is_wrong_with_a_task_is_said_with_its_file_once(
    sched_sim: Run, tmp_path: Path, entry: str, line: str, said: str
) -> None:
    (tmp_path / "board.toml").write_text(f'[[task]]\nname = "t"\nhz = 100\npriority = 5\n{entry}\n')
    result = sched_sim(f"{line} --tasks board.toml")
    is_refused(result, [f"Error: --tasks 'board.toml': {said}"])
    assert result.err.count("board.toml") == 1


def test_tasks_whose_periods_hardly_ever_meet_the_measurements_can_be_simulated(sched_sim: Run, tmp_path: Path) -> None:
    """Only the search for the least speed needs the schedule to repeat, and only where their phase is given."""
    odd = '[[task]]\nname = "odd"\nperiod = 3.141592653\ncost = 0.1\npriority = 30\n'
    (tmp_path / "odd.toml").write_text(odd)
    assert sched_sim("minimum -N 10 -M 4 --tasks odd.toml").code == 0
    assert "not all is seen" not in sched_sim("simulate -N 10 -M 4 --speed 0.9 --tasks odd.toml").err
    (tmp_path / "odd.toml").write_text(f"{odd}offset = 0\n")
    simulated = sched_sim("simulate -N 10 -M 4 --speed 0.9 --tasks odd.toml")
    assert simulated.code == 0
    assert "not all is seen" in simulated.err
    refused = sched_sim("minimum -N 10 -M 4 --tasks odd.toml")
    assert refused.code == 2
    assert "odd 3.14159" in refused.err


def test_a_job_that_is_not_due_yet_is_not_said_to_be_missed(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "t.toml").write_text('[[task]]\nname = "slow"\nperiod = 1000\ncost = 300\npriority = 30\n')
    result = sched_sim("simulate -N 4 -M 0 --method larsen --speed 1.5 --tasks t.toml")
    slow = next(line for line in result.out.splitlines() if "task:slow" in line)
    assert slow.split()[:5] == ["task:slow", "1", "-", "-", "0"]
    assert "past their deadline they are missed" in result.out


NARROW = """name = "narrow"
unit = "operation"
source = "an example"
[costs.dual-rate]
hr_propagate = 50
hr_restart = 50
hr_update = 20
lr_propagate = 10
lr_update = 54
"""
BESIDE = """[[task]]
name = "control"
period = 4
offset = 2
cost = 25
priority = 5
"""


@pytest.fixture
def narrow(tmp_path: Path) -> str:
    """A correction that takes less lands beside the task."""
    (tmp_path / "narrow.toml").write_text(NARROW)
    (tmp_path / "beside.toml").write_text(BESIDE)
    return "-N 4 -M 0 --costs narrow.toml --tasks beside.toml"


def test_minimum_says_where_less_work_needs_more(sched_sim: Run, narrow: str) -> None:
    said = "dual-rate: at its least speed work that takes less may land in another step and miss a deadline; "
    assert f"{said}at 95 none does" in sched_sim(f"minimum {narrow}").out
    assert f"{said}`sched-sim simulate --less-work`" in sched_sim(f"minimum {narrow} --feedback same-step").out
    (row,) = json.loads(sched_sim(f"minimum {narrow} --format json").out)
    assert (row["min_speed"], row["less_work_speed"]) == (77.25, 95)
    assert "less" not in sched_sim(f"minimum {narrow.partition(' --tasks')[0]}").out


def test_a_sweep_says_that_its_verdicts_are_of_executions_that_take_all_of_their_costs(
    sched_sim: Run, narrow: str
) -> None:
    said = "a verdict is that of executions that take all of their costs; less work may land in another step"
    assert said in sched_sim(f"sweep {narrow}").out
    assert said not in sched_sim(f"sweep {narrow.partition(' --tasks')[0]}").out


def test_simulate_looks_for_less_work(sched_sim: Run, narrow: str) -> None:
    asked = f"simulate {narrow} --less-work --speed"
    assert "Less work misses a deadline: lr_update 48.9375 instead of 54 in every cycle" in sched_sim(f"{asked} 80").out
    assert "No work up to these costs misses a deadline" in sched_sim(f"{asked} 95").out
    assert "A deadline may be missed at these costs already" in sched_sim(f"{asked} 90").out
    unknown = sched_sim(f"{asked} 200 --feedback same-step").out
    assert "Whether less work misses a deadline is not known: none of 64 tried does" in unknown
    found = json.loads(sched_sim(f"{asked} 80 --format json").out)
    assert (found["less_work"], found["less_work_costs"]["lr_update"]) == ("fails", 48.9375)
    assert "less_work" not in json.loads(sched_sim(f"simulate {narrow} --speed 80 --format json").out)


@pytest.mark.parametrize("command", ["processors -N 10 -M 4 --hr-hz 400", "design --within 10 --model ins-gps"])
def test_other_verdicts_beside_an_offset_say_what_they_are_of(sched_sim: Run, tmp_path: Path, command: str) -> None:
    (tmp_path / "tasks.toml").write_text('[[task]]\nname = "gyro"\nperiod = 2\noffset = 0\ncost_us = 1\npriority = 5\n')
    line = f"{command} --processor cortex-m7 --tasks tasks.toml"
    said = "dual-rate: beside the offset of gyro a verdict is that of executions that take all of their costs"
    assert said in sched_sim(f"{line} --method dual-rate").out
    assert "less work" not in sched_sim(f"{line} --method larsen").out
