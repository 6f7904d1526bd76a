"""The contract of the command line that scripts rely on, and what it says to wrong input."""

from __future__ import annotations

import csv
import io
import json
import re
from pathlib import Path

import pytest

from tests.command_line import Run, is_refused

DESIGN = "-N 10 -M 4 -L 8 --costs steffes2014"


def test_minimum_prints_a_json_array_of_methods(sched_sim: Run) -> None:
    rows = json.loads(sched_sim(f"minimum {DESIGN} --format json").out)
    assert [row["method"] for row in rows] == ["standard", "recalculate", "larsen", "dual-rate"]
    assert rows[-1] == {
        "method": "dual-rate",
        "N": 10,
        "M": 4,
        "L": 8,
        "min_speed": 0.77,
        "min_speed_exact": "77/100",
        "binding": "lr_update",
        "cost_unit": "standard step",
        "achieved_l_at_min_speed": 8,
        "min_speed_least": None,
        "min_speed_most": None,
        "measured_on_busy_machine": None,
    }


def test_minimum_lands_at_the_same_step_in_every_format(sched_sim: Run) -> None:
    line = "minimum -N 100 -M 10 -L 80 --method larsen --method dual-rate"
    assert [row["achieved_l_at_min_speed"] for row in json.loads(sched_sim(f"{line} --format json").out)] == [10, 29]
    table = [row.split() for row in sched_sim(line).out.splitlines()]
    assert [row[-1] for row in table if row and row[0] in ("larsen", "dual-rate")] == ["10", "29"]


def test_minimum_csv_has_the_same_rows(sched_sim: Run) -> None:
    expected = json.loads(sched_sim(f"minimum {DESIGN} --format json").out)
    rows = list(csv.DictReader(io.StringIO(sched_sim(f"minimum {DESIGN} --format csv").out)))
    assert [{key: "" if value is None else str(value) for key, value in row.items()} for row in expected] == rows


@pytest.mark.parametrize(
    ("options", "speed"),
    [
        ("--lr-propagate-by m", "26/25"),
        ("--lr-propagate-by l", "271/400"),
        ("--feedback same-step --lr-propagate-by l", "152/225"),  # (8 x 0.63 + 0.04 + 0.41 + 0.56 + 0.03) / 9
        ("--cpus 2", "26/25"),
        ("--cpus 2 --lr-propagate-by l", "33/50"),
        ("--context-switch 0.01", "53/50"),
    ],
)
def test_options_of_minimum(sched_sim: Run, options: str, speed: str) -> None:
    result = sched_sim(f"minimum -N 10 -M 1 -L 8 --method dual-rate --format json {options}")
    assert json.loads(result.out)[0]["min_speed_exact"] == speed


def test_a_precomputed_gain_needs_its_own_entries_and_less_power(sched_sim: Run) -> None:
    line = "minimum -N 10 -M 4 -L 5 --method dual-rate --costs counted-9-3-3 --format json"
    late, early = (json.loads(sched_sim(line + gain).out)[0] for gain in ("", " --gain precomputed"))
    assert early["min_speed"] < late["min_speed"]


def test_hr_hz_adds_absolute_times_and_rates(sched_sim: Run) -> None:
    row = json.loads(sched_sim(f"minimum {DESIGN} --method dual-rate --hr-hz 400 --format json").out)[0]
    assert row["correction_ms_at_min_speed"] == 20.0
    assert not {"achieved_l", "correction_ms"} & row.keys()
    assert row["work_per_second"] == pytest.approx(0.77 * 400)
    assert "lands after, ms" in sched_sim(f"minimum {DESIGN} --hr-hz 400").out


def test_simulate_prints_one_json_object(sched_sim: Run) -> None:
    line = "simulate --method dual-rate -N 10 -M 4 --speed 0.78 --cycles 3 --costs steffes2014 --format json"
    document = json.loads(sched_sim(line).out)
    assert document["achieved_l"] == [8, 8, 8]
    assert document["misses"] == 0
    assert document["utilization"] == pytest.approx((9 * 0.63 + 0.04 + 0.03 + 0.41 + 0.56) / 7.8)
    assert document["preemptions"] == 12
    assert set(document["response"]) == {"hr", "lr_propagate", "lr_update"}
    assert document["response"]["lr_propagate"]["max_periods"] == pytest.approx(0.45 / 0.78)
    assert document["response"]["lr_update"]["mean_periods"] == pytest.approx(
        (3 * 0.78 + 0.63 + 0.56 - 3 * 0.15) / 0.78
    )


def test_what_simulate_prints_for_scripts_says_of_what_it_is_and_in_which_unit(sched_sim: Run) -> None:
    line = "simulate -N 10 -M 4 -L 8 --speed 0.78 --hr-hz 400"
    document = json.loads(sched_sim(f"{line} --format json").out)
    about = {"method": "dual-rate", "N": 10, "M": 4, "L": 8, "speed": 0.78, "speed_exact": "39/50"}
    about |= {"cost_unit": "standard step", "hr_hz": 400.0}
    assert {key: document[key] for key in about} == about
    assert document["correction_ms"] == [20.0, 20.0, 20.0]
    update = document["response"]["lr_update"]
    for name in ("max", "mean", "worst_lateness"):
        assert update[f"{name}_ms"] == pytest.approx(2.5 * update[f"{name}_periods"])
    row = list(csv.DictReader(io.StringIO(sched_sim(f"{line} --format csv").out)))[-1]
    about |= {"measured_on_busy_machine": ""}
    assert row == {key: str(value) for key, value in {**about, "kind": "lr_update", **update}.items()}


def test_on_a_processor_the_speed_is_in_seconds_and_the_processor_is_named(sched_sim: Run) -> None:
    document = json.loads(sched_sim("simulate -N 10 -M 4 --processor leon3 --hr-hz 400 --format json").out)
    about = {"speed": 0.0025, "speed_exact": "1/400", "cost_unit": "second", "processor": "leon3", "hr_hz": 400.0}
    assert {key: document[key] for key in about} == about


def test_without_a_rate_nothing_is_in_ms(sched_sim: Run) -> None:
    assert "_ms" not in sched_sim("simulate -N 10 -M 4 --format json").out
    assert "ms" not in sched_sim("simulate -N 10 -M 4").out


def test_with_a_rate_the_table_of_simulate_is_in_ms(sched_sim: Run) -> None:
    out = sched_sim("simulate -N 10 -M 4 -L 8 --speed 0.77 --hr-hz 400").out
    assert "response times in ms" in out
    assert "Corrections land at l = k + 8, 20 ms after k;" in out
    (update,) = [row.split() for row in out.splitlines() if row.startswith(" lr_update")]
    assert update == ["lr_update", "3", "10", "10", "0", "0", "9"]


def test_json_and_csv_carry_no_colour_even_where_it_is_forced(sched_sim: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FORCE_COLOR", "1")
    for command in (f"minimum {DESIGN}", "simulate -N 10 -M 4"):
        for form in ("json", "csv"):
            assert "\x1b" not in sched_sim(f"{command} --format {form}").out


def test_l_defaults_to_the_latest_that_is_legal(sched_sim: Run) -> None:
    rows = json.loads(sched_sim("minimum -N 10 -M 4 --feedback same-step --format json").out)
    assert {row["method"]: row["L"] for row in rows}["dual-rate"] == 9


def test_pictures_and_traces_are_written(sched_sim: Run, tmp_path: Path) -> None:
    result = sched_sim("simulate -N 10 -M 4 --speed 0.7 --gantt a.svg --trace a.json --trace a.csv")
    assert result.code == 0
    assert "land at l = k + 12, 1 of 3 not within" in result.out
    assert sched_sim("gantt -N 10 -M 4 -L 8 -o fig.pdf").code == 0
    assert {path.name for path in tmp_path.iterdir()} == {"a.svg", "a.json", "a.csv", "fig.pdf"}


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


def test_nothing_is_late_to_the_standard_filter(sched_sim: Run) -> None:
    for line in ("minimum -N 10 -M 4 {}", "simulate -N 10 -M 4 --method standard {}"):
        for more in ("", "-L 8"):
            found = json.loads(sched_sim(f"{line.format(more)} --format json").out)
            row = found[0] if isinstance(found, list) else found
            assert (row["method"], row["N"], row["M"], row["L"]) == ("standard", 10, 0, 0)
    line = "processors --hr-hz 400 --measurement-hz 5 --delay-ms 110 --method standard --format csv"
    rows = list(csv.DictReader(io.StringIO(sched_sim(line).out)))
    assert {(row["N"], row["M"], row["L"]) for row in rows} == {("80", "0", "0")}


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


def test_where_there_are_no_tasks_none_are_spoken_of(sched_sim: Run) -> None:
    line = "simulate -N 5 -M 3 -L 5 --speed 1.34 --context-switch 0.16 --policy edf --cycles 1"
    assert sched_sim(line).err == "Note: 1 cycle is shown; all is seen after 2: --cycles 2\n"


@pytest.mark.parametrize("option", ["--policy edf", "--context-switch 0.01"])
def test_what_has_no_closed_form_is_named_where_n_is_too_long(sched_sim: Run, option: str) -> None:
    is_refused(
        sched_sim(f"minimum -N 300000 -M 10 --method larsen {option}"),
        ["where context switches take time, or the earliest deadline", "leave out --context-switch and --policy"],
    )


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


def test_costs_in_milliseconds_give_a_share_of_the_processor(sched_sim: Run, tmp_path: Path) -> None:
    entries = "[costs.larsen]\npropagate = 0.21\npropagate_accumulate = 0.3\nupdate = 0.42\n"
    (tmp_path / "ms.toml").write_text('name = "m"\nunit = "ms"\n' + entries)
    line = "minimum -N 80 -M 40 --method larsen --costs ms.toml --hr-hz 400 --format json"
    row = json.loads(sched_sim(line).out)[0]
    assert row["needed_share"] == pytest.approx(0.72e-3 * 400)
    assert row["fits"] is True
    assert (row["min_speed"], row["cost_unit"]) == (0.72e-3, "second")
    assert row["highest_hr_hz"] == 1388  # of 1000 / 0.72 = 1388.9: a limit is rounded down


def test_costs_beyond_64_bits_stay_exact(sched_sim: Run, tmp_path: Path) -> None:
    entries = "[costs.larsen]\npropagate = 1e17\npropagate_accumulate = 1e-17\nupdate = 1\n"
    (tmp_path / "wide.toml").write_text('name = "w"\nunit = "u"\n' + entries)
    row = json.loads(sched_sim("minimum -N 8 -M 4 --method larsen --costs wide.toml --format json").out)[0]
    assert row["min_speed_exact"] == str(10**17)


def test_a_value_that_is_close_to_a_choice_is_said_with_it(sched_sim: Run) -> None:
    said = " ".join(sched_sim("simulate -N 10 -M 4 --method larson").err.replace("│", " ").split())
    assert "'robust-closed'. Did you mean larsen?" in said
    assert "Did you mean" not in sched_sim("simulate -N 10 -M 4 --method kalman").err


def test_help_and_version(sched_sim: Run) -> None:
    assert all(
        name in sched_sim("--help").out for name in ("minimum", "simulate", "gantt", "sweep", "measure", "report")
    )
    assert sched_sim("--version").out.startswith("sched-sim ")


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("minimum -N 10 -M 4 -L 4", ["L=4", "M=4", "give L from 5 on"]),
        ("minimum -N 10 -M 4 -L 3", ["L=3", "M=4", "give L from 5"]),
        ("minimum -N 10 -M 11 --method larsen", ["[costs.larsen] gain, correct, compensate", "counted-9-3-3"]),
        ("minimum -N 0 -M 0", ["N=0", "at least 1"]),
        ("minimum -N 10 -M -1", ["M=-1", "at least 0"]),
        ("minimum -N ten -M 4", ["-N", "ten"]),
        ("minimum -N 10 -M 4 --method larson", ["--method", "larson", "larsen"]),
        ("minimum -N 10 -M 4 --costs nowhere.toml", ["nowhere.toml", "steffes2014"]),
        ("minimum -N 10 -M 4 --costs bad.toml", ["bad.toml", "costs.larsen.update", "-1"]),
        ("minimum -N 10 -M 4 --costs short.toml", ["short.toml", "[costs.larsen] propagate_accumulate", "measure"]),
        ("minimum -N 10 -M 4 --gain precomputed", ["steffes2014", "lr_gain", "measure"]),
        ("minimum -N 10 -M 4 --context-switch -1", ["--context-switch is -1: it must be 0 or more cost units"]),
        ("minimum -N 10 -M 4 --context-switch 5us", ["--context-switch is '5us': give it in units of the cost table"]),
        ("minimum -N 10 -M 4 --hr-hz 400Hz", ["--hr-hz is '400Hz': give it in Hz, without the unit: 400\n"]),
        ("minimum -N 10 --hr-hz 400 --delay-ms '5 ms'", ["--delay-ms is '5 ms': give it in ms, without the unit: 5\n"]),
        ("minimum -N 10 --hr-hz 400 --delay-ms 0.1s", ["--delay-ms is '0.1s': give it in ms, without the unit\n"]),
        (
            "minimum --hr-hz 1e9 --measurement-hz 5 --delay-ms 110",
            ["--hr-hz 1e+09 and --measurement-hz 5 make 200000000 HR steps: give values that make at most 10,000,000"],
        ),
        ("minimum --hr-hz 1e9 -N 10 --delay-ms 110", ["--hr-hz 1e+09 and --delay-ms 110 make 110000000 HR steps"]),
        ("sweep --measurement-hz 5", ["--measurement-hz is no option of `sched-sim sweep`", "HR steps: give -N"]),
        ("sweep -N 10 --delay-ms=5", ["--delay-ms is no option of `sched-sim sweep`", "HR steps: give -M"]),
        ("minimum --scenario s.toml", ["no option of", "it is one of `sched-sim simulate`, `sched-sim processors`"]),
        ("minimum -N 10 -M 4 --method larson", ["'larson'", "did you mean larsen?"]),
        ("sweep -N 10 -M 4 --method larson", ["'larson'", "did you mean larsen?"]),
        ("minimum -N 10 -M 4 --processor cortexm4f", ["'cortexm4f' not found: did you mean cortex-m4f? give one of"]),
        ("minimum -N 10 -M 4 --costs stefes", ["'stefes' not found: did you mean steffes2014? give one of"]),
        (
            "minimum -N 10 -M 4 --processor table.toml",
            ["'table.toml': this is a cost table, and a processor's file is needed; give it to --costs\n"],
        ),
        (
            "minimum -N 10 -M 4 --costs part.toml",
            ["'part.toml': this is a processor's file, and a cost table is needed; give it to --processor\n"],
        ),
        ("minimum -N 10 -M 4 --tasks table.toml", ["this is a cost table, and a file of tasks is needed"]),
        ("minimum -N 10 -M 4 --costs timed-tasks.toml", ["this is a file of tasks", "give it to --tasks\n"]),
        ("simulate --scenario table.toml", ["this is a cost table, and a scenario is needed; give it to --costs\n"]),
        (
            "minimum -N 10 -M 4 --tasks timed-tasks.toml",
            [
                "task 's': cost_ms = 1 is a time; task 't': cost_ms = 1 is a time: the unit of the cost table, "
                "standard step, is no time: give cost = ... in that unit, or a table in seconds (--processor, or"
            ],
        ),
        ("processors --scenario nothing.toml", ["'nothing.toml': name: is missing", "sensor: there is none"]),
        ("minimum -N 10 -M 4 --context-switch nan", ["--context-switch", "nan"]),
        ("minimum -N 10 -M 4 --hr-hz 0", ["--hr-hz", "0", "greater than 0"]),
        ("minimum -N 10 -M 4 --hr-hz 1e400", ["--hr-hz", "1e400", "1e18"]),
        ("simulate -N 10 -M 4 --speed 1e5000", ["--speed", "1e5000", "1e18"]),
        ("minimum -N 10 -M 4 --cpus 3", ["--cpus", "3"]),
        ("minimum -N 10 -M 4 --format xml", ["--format", "xml"]),
        ("minimum -N 10 -M 4 --tasks none.toml", ["--tasks", "none.toml"]),
        ("minimum -N 10 -M 4 --tasks bad-tasks.toml", ["bad-tasks.toml", "task 't'.period", "(given: -2)"]),
        ("simulate -N 10 -M 4 --speed 0", ["--speed", "0", "greater than 0"]),
        ("simulate -N 10 -M 4 --speed fast", ["--speed", "fast", "0.78"]),
        ("simulate -N 10 -M 4 --cycles 0", ["--cycles", "0"]),
        ("simulate -N 10 -M 4 --method kalman", ["--method", "kalman", "larsen"]),
        ("simulate -N 10 -M 4 --trace t.txt", ["--trace", "t.txt", ".json"]),
        ("simulate -N 10 -M 4 --trace nowhere/t.csv", ["--trace", "nowhere/t.csv"]),
        ("simulate -N 10 -M 4 --gantt g.gif", ["--gantt 'g.gif': suffix '.gif'", ".svg"]),
        ("gantt -N 10 -M 4 -o nowhere/g.svg", ["--output 'nowhere/g.svg'"]),
        ("measure --states 0", ["--states", "0"]),
        ("minimum -N 10 -M 4 --costs=", ["--costs is empty: give a value, or leave it out"]),
        ("sweep ''", ["argument GRID is empty: give a value, or leave it out"]),
        ("minimum -N 10 -M 4 --processor=", ["--processor is empty"]),
        ("minimum -N 10 -M 4 --tasks=", ["--tasks is empty"]),
        ("simulate -N 10 -M 4 --gantt=", ["--gantt is empty"]),
        ("simulate -N 10 -M 4 --trace t.csv --trace=", ["--trace is empty"]),
        ("simulate --scenario=", ["--scenario is empty"]),
        ("processors -N 10 -M 4 --hr-hz 400 --costs=", ["--costs is empty"]),
        ("sweep -N 10 -M 4 --results=", ["--results is empty"]),
        ("gantt -N 10 -M 4 --output=", ["--output is empty"]),
        ("measure --output=", ["--output is empty"]),
        ("report --output=", ["--output is empty"]),
        ("measure --system nowhere:system", ["--system", "nowhere"]),
        ("measure --system json:dumps2", ["--system", "dumps2"]),
        ("measure -o nowhere/costs.toml", ["nowhere/costs.toml"]),
        ("report bayes", ["bayes", "steffes2014"]),
        ("report -o file", ["file"]),
        ("maximum", ["maximum"]),
    ],
)
def test_wrong_input_ends_with_code_2_and_one_message(
    sched_sim: Run, tmp_path: Path, line: str, said: list[str]
) -> None:
    (tmp_path / "bad.toml").write_text('name = "b"\nunit = "s"\n[costs.larsen]\npropagate = 1\nupdate = -1\n')
    (tmp_path / "short.toml").write_text('name = "short"\nunit = "s"\n[costs.larsen]\npropagate = 1\n')
    (tmp_path / "bad-tasks.toml").write_text('[[task]]\nname = "t"\nperiod = -2\ncost = 1\npriority = 5\n')
    timed = '[[task]]\nname = "{}"\nperiod = 2\ncost_ms = 1\npriority = 5\n'
    (tmp_path / "timed-tasks.toml").write_text(timed.format("s") + timed.format("t"))
    (tmp_path / "table.toml").write_text('name = "t"\nunit = "operation"\n[operations.larsen]\nupdate = { add = 5 }\n')
    (tmp_path / "part.toml").write_text('name = "p"\nclock_mhz = 100\n[cycles]\nadd = 1\n')
    (tmp_path / "nothing.toml").write_text("")
    (tmp_path / "file").write_text("in the way of a folder")
    before = {path: path.read_bytes() for path in tmp_path.iterdir()}
    is_refused(sched_sim(line), said)
    assert {path: path.read_bytes() for path in tmp_path.iterdir()} == before


@pytest.mark.parametrize(
    ("other", "excluded"),
    [
        ("--system nowhere:system", "--states --inputs --measurements"),
        ("--filter nowhere:filter", "--states --inputs --measurements --system --method --update"),
        ("--robust position", "--states --inputs --measurements --system --method --update"),
    ],
)
def test_the_help_of_measure_says_which_options_exclude_each_other(sched_sim: Run, other: str, excluded: str) -> None:
    values = {"--system": "nowhere:system", "--method": "larsen", "--update": "short"}
    said = " ".join(sched_sim("measure --help").out.replace("│", " ").split())
    for option in excluded.split():
        is_refused(sched_sim(f"measure {other} {option} {values.get(option, 2)}"), [f"leave out {option}"])
        (not_with,) = re.findall(rf" {option} (?:COUNT|<[^>]*>) .*?Not with ([^.]*)\.", said)
        assert other.split()[0] in not_with


def test_the_help_of_sweep_gives_values_that_it_takes(sched_sim: Run) -> None:
    said = " ".join(sched_sim("sweep --help").out.replace("│", " ").split())
    for option in ("--lr-propagate-by", "--feedback", "--gain", "--low-rate-noise", "--cpus"):
        (values,) = re.findall(rf"{option} VALUES ([^.]*)\.", said)
        for value in re.findall(r"[\w,-]*[\w-]", values.replace("(default)", "").replace("several: ", "")):
            if value not in ("Deadline", "of", "LR", "propagate", "or", "processors"):
                result = sched_sim(
                    f"sweep -N 10 -M 2 --costs counted-9-3-3 {option} {value} --speed 10000 --format json"
                )
                assert result.code == 0, result.err


@pytest.mark.parametrize(
    "line",
    [
        "measure --update u-d",
        "measure --robust u-d",
        "simulate -N 10 -M 4 --gain u-d",
        "report u-d",
    ],
)
def test_a_value_that_is_none_of_the_choices_is_refused_in_words(sched_sim: Run, line: str) -> None:
    result = sched_sim(line)
    is_refused(result, ["Invalid value for '", "': 'u-d' is not one of"])
    assert "Value error" not in result.err


def test_a_job_that_is_not_due_yet_is_not_said_to_be_missed(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "t.toml").write_text('[[task]]\nname = "slow"\nperiod = 1000\ncost = 300\npriority = 30\n')
    result = sched_sim("simulate -N 4 -M 0 --method larsen --speed 1.5 --tasks t.toml")
    slow = next(line for line in result.out.splitlines() if "task:slow" in line)
    assert slow.split()[:5] == ["task:slow", "1", "-", "-", "0"]
    assert "past their deadline they are missed" in result.out
