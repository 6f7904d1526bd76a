"""A method that cannot have a design is named in a note, and the others stay."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.command_line import Run, is_refused
from tests.svg import texts_of

COUNTED = "--costs counted-9-3-3"
IN_HZ = "--hr-hz 100 --measurement-hz 4 --delay-ms 2000"
AT_MOST_N = ("clone-split", "delayed-horizon", "px4-predictor", "augmentation", "fuse-as-fresh")
SEVERAL = ["standard", "recalculate", "larsen", "dual-rate", "clone", "carried-gain"]
ANY_PHASE = '[[task]]\nname = "io"\nperiod = 7\ncost = 300\npriority = 1\n'


def methods(out: str) -> list[str]:
    return [row["method"] for row in json.loads(out)]


@pytest.mark.parametrize("part", ["", pytest.param(" --processor cortex-m4f", marks=pytest.mark.exhaust)])
def test_minimum_with_times_has_the_rows_that_it_has_in_steps(sched_sim: Run, part: str) -> None:
    in_hz = sched_sim(f"minimum {IN_HZ} {COUNTED}{part} --format json")
    in_steps = sched_sim(f"minimum --hr-hz 100 -N 25 -M 200 {COUNTED}{part} --format json")
    assert json.loads(in_hz.out) == json.loads(in_steps.out)
    assert methods(in_hz.out) == SEVERAL
    for name in AT_MOST_N:
        assert f"no {name}: it waits for one measurement at a time, and with --delay-ms 2000 and" in in_hz.err
        assert f"no {name}: it waits for one measurement at a time, and with M=200 and N=25 others" in in_steps.err


def test_the_note_has_the_unit_of_each_number(sched_sim: Run) -> None:
    assert (
        "with --delay-ms 2000 and N=25 others" in sched_sim(f"minimum --hr-hz 100 -N 25 --delay-ms 2000 {COUNTED}").err
    )


@pytest.mark.parametrize("M", [4, 31])
def test_a_landing_at_arrival_leaves_those_that_correct_then(sched_sim: Run, M: int) -> None:
    result = sched_sim(f"minimum -N 10 -M {M} -L {M} {COUNTED} --format json")
    assert [name for name in methods(result.out) if name in SEVERAL] == [
        name for name in SEVERAL if name != "dual-rate"
    ]
    assert f"Note: no dual-rate: L={M} must be > M={M}" in result.err


@pytest.mark.parametrize("command", ["minimum", "processors --hr-hz 100 --processor cortex-m7"])
def test_what_cannot_be_simulated_leaves_the_others(sched_sim: Run, command: str) -> None:
    line = f"{command} -N 10 -M 100000 --method clone --method dual-rate {COUNTED} --format json"
    result = sched_sim(line)
    assert methods(result.out) == ["clone"]
    assert "Note: no dual-rate: L=100010 with N=10 is more than is simulated" in result.err


@pytest.mark.parametrize("command", ["minimum", "processors --hr-hz 100 --processor cortex-m7"])
def test_tasks_of_any_phase_that_one_method_cannot_have_leave_the_others(
    sched_sim: Run, tmp_path: Path, command: str
) -> None:
    unit = "cost_us = 3" if "processors" in command else "cost = 300"
    (tmp_path / "tasks.toml").write_text(ANY_PHASE.replace("cost = 300", unit))
    line = f"{command} -N 5 -M 12 --method clone --method dual-rate --tasks tasks.toml --policy edf {COUNTED}"
    result = sched_sim(f"{line} --format json")
    assert methods(result.out) == ["clone"]
    assert "Note: no dual-rate: --policy edf with L=15 and N=5" in result.err


@pytest.mark.exhaust
def test_processors_names_a_method_that_waits_for_one_at_a_time(sched_sim: Run) -> None:
    line = f"processors {IN_HZ} --processor cortex-m7 --method clone-split --method dual-rate"
    result = sched_sim(line)
    assert result.out.startswith("dual-rate, HR loop")
    assert "Note: no clone-split: it waits for one measurement at a time, and with --delay-ms 2000" in result.err


def test_gantt_draws_those_that_are_left(sched_sim: Run, tmp_path: Path) -> None:
    result = sched_sim(f"gantt -N 10 -M 31 -L 31 {COUNTED} -o g.svg")
    assert result.code == 0
    assert "Note: no dual-rate: L=31 must be > M=31" in result.err
    drawn = texts_of(tmp_path / "g.svg")
    assert "Larsen" in drawn
    assert not any(text.startswith("Dual") for text in drawn)


def test_where_no_method_is_left_the_error_names_each(sched_sim: Run) -> None:
    line = f"minimum -N 10 -M 31 -L 31 --method dual-rate --method clone-split {COUNTED}"
    is_refused(sched_sim(line), ["dual-rate: L=31 must be > M=31", "clone-split: M=31 must be <= N=10"])


def test_what_is_wrong_for_all_is_said_once(sched_sim: Run) -> None:
    result = sched_sim("minimum -N 10")
    is_refused(result, ["-M is missing"])
    assert result.err.count("-M is missing") == 1


def test_a_sweep_names_the_methods_of_which_no_point_is_legal_and_speaks_of_the_others_alone(sched_sim: Run) -> None:
    result = sched_sim(f"sweep -N 10 -M 5,10,11,31 -L 32 {COUNTED}")
    assert "Note: no fuse-as-fresh: L=32 must be <= N=10" in result.err
    assert "px4-predictor" not in result.out
    assert "fuse-as-fresh" not in result.out


@pytest.mark.parametrize(
    ("design", "reason"),
    [
        ("-N 10 -M 100000", "L=100010 with N=10 is more than is simulated"),
        ("-N 5 -M 12 --tasks tasks.toml --policy edf", "--policy edf with L=15 and N=5"),
    ],
)
def test_a_sweep_leaves_out_what_has_no_answer(sched_sim: Run, tmp_path: Path, design: str, reason: str) -> None:
    (tmp_path / "tasks.toml").write_text(ANY_PHASE)
    result = sched_sim(f"sweep {design} --method clone,dual-rate {COUNTED} --format json")
    assert [row["method"] for row in json.loads(result.out)["methods"]] == ["clone"]
    assert f"Note: no dual-rate: {reason}" in result.err
