"""What the command line says to wrong input."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.command_line import Run, is_refused


def test_a_value_that_is_close_to_a_choice_is_said_with_it(sched_sim: Run) -> None:
    said = " ".join(sched_sim("simulate -N 10 -M 4 --method larson").err.replace("│", " ").split())
    assert "'robust-closed'. Did you mean larsen?" in said
    assert "Did you mean" not in sched_sim("simulate -N 10 -M 4 --method kalman").err


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("minimum -N 10 -M 4 -L 4 --method dual-rate", ["L=4", "M=4", "give L from 5 on"]),
        ("minimum -N 10 -M 4 -L 3", ["L=3", "M=4", "give L from 5"]),
        ("minimum -N 10 -M 11 --method larsen", ["[costs.larsen] gain, correct, compensate", "counted-9-3-3"]),
        ("minimum -N 0 -M 0", ["N=0", "at least 1"]),
        ("minimum -N 10 -M -1", ["M=-1", "at least 0"]),
        ("minimum -N ten -M 4", ["-N", "ten"]),
        ("minimum -N 10 -M 4 --method larson", ["--method", "larson", "larsen"]),
        ("minimum -N 10 -M 4 --costs nowhere.toml", ["nowhere.toml", "steffes2014"]),
        ("minimum -N 10 -M 4 --costs bad.toml", ["bad.toml", "costs.larsen.update", "-1"]),
        ("minimum -N 10 -M 4 --costs short.toml", ["short.toml", "[costs.larsen] propagate_accumulate", "measure"]),
        ("minimum -N 10 -M 4 --gain precomputed --method dual-rate", ["steffes2014", "lr_gain", "measure"]),
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
