"""A sweep from flags and from a file."""

from contextvars import copy_context
from fractions import Fraction
from pathlib import Path

import pytest

from sched_sim.cli.spelling import flag_of
from sched_sim.design.options import Options
from sched_sim.errors import SPELLING, InputError
from studies.sweep.settings import settings
from tests.command_line import Run, is_refused

FILE = """
N = "10:30:10"
M = [1, "2:4"]
speed = [0.7, "0.8:1.0:0.1"]
method = ["dual-rate", "larsen"]
feedback = ["next-step", "same-step"]
context_switch = 0.01
simulate = true
cycles = 5
"""


@pytest.fixture
def grid_file(tmp_path):
    path = tmp_path / "grid.toml"
    path.write_text(FILE)
    return path


def test_flags_and_file_make_the_same_sweep(grid_file):
    flags = {
        "N": ["10:30:10"],
        "M": ["1:4"],
        "speed": ["0.7:1:0.1"],
        "method": ["larsen", "dual-rate"],
        "feedback": ["same-step,next-step"],
        "context_switch": ["0.01"],
        "simulate": True,
        "cycles": 5,
    }
    assert settings(flags).sweep().digest == settings({}, grid_file).sweep().digest


def test_defaults():
    sweep = settings({"N": ["10"]}).sweep()
    assert sweep.cycles is None
    assert (sweep.grid.M, sweep.grid.L, sweep.grid.speeds) == (None, None, ())
    assert sweep.grid.options == (Options(),)
    assert [table.name for table in sweep.grid.tables] == ["steffes2014"]
    assert len(sweep.grid.methods) == 4


def test_flags_take_precedence_over_the_file(grid_file):
    sweep = settings({"N": "50", "M": "all", "simulate": False}, grid_file).sweep()
    assert sweep.grid.N == (50,)
    assert sweep.grid.M is None
    assert sweep.cycles is None
    assert sweep.grid.speeds[0] == Fraction(7, 10)


@pytest.mark.exhaust
def test_every_option_is_an_axis():
    grid = (
        settings(
            {
                "N": "5",
                "method": "larsen",
                "lr_propagate_by": "m,l",
                "feedback": "next-step,same-step",
                "gain": "at-update,precomputed",
                "low_rate_noise": "exact,sum,euler",
                "cpus": "1,2",
                "context_switch": "0,1/3",
                "policy": "fixed,edf",
            }
        )
        .sweep()
        .grid
    )
    assert len(set(grid.options)) == 2 * 2 * 2 * 3 * 2 * 2 * 2
    assert Options("l", "same-step", "precomputed", "euler", 2, Fraction(1, 3), "edf") in grid.options


def test_a_cost_table_of_the_file_lies_beside_it(tmp_path):
    (tmp_path / "mine.toml").write_text('name = "mine"\nunit = "step"\n[costs.standard]\npropagate = 1\nupdate = 2\n')
    (tmp_path / "grid.toml").write_text('N = 5\nmethod = "standard"\ncosts = ["steffes2014", "mine.toml"]\n')
    sweep = settings({}, tmp_path / "grid.toml").sweep()
    assert [block.table for block in sweep.grid.blocks] == ["steffes2014", "mine"]


def test_all_errors_of_a_file_are_told_with_path_and_value(tmp_path):
    path = tmp_path / "grid.toml"
    path.write_text('N = "9:3"\nspeed = 0\ncpus = [1, 3]\nsimulate = "yes"\ncycles = 0\nrate = 400\ncosts = 1\n')
    with pytest.raises(InputError) as error:
        settings({}, path)
    text = str(error.value)
    assert str(path) in text
    for part in (
        "N: the value '9:3' is an empty range",
        "speed: the value '0' must be greater than 0",
        "cpus: the value '3' is unknown: choose from 1, 2",
        "simulate: must be true or false (given: yes)",
        "cycles: must be at least 1 (given: 0)",
        "rate: this key is not permitted; the keys here are N, M, L, speed",
        "costs: the value 1: give the name of a shipped cost table",
    ):
        assert part in text


@pytest.mark.parametrize(
    ("flags", "why"),
    [
        ({}, "N is missing: give -N"),
        ({"N": "0"}, "-N '0' must be a whole number, at least 1"),
        ({"N": "5", "lr_propagate_by": "k"}, "--lr-propagate-by 'k' is unknown: choose from m, l"),
        ({"N": "5", "costs": "nothere"}, "cost table 'nothere' not found"),
        ({"N": "5", "speed": "fast"}, "--speed is 'fast'"),
        ({"N": "5", "cycles": 2**63 - 1}, "^--cycles: must be at most 10,000,000 .given: 9223372036854775807"),
        ({"N": "x", "cpus": "3"}, "-N is 'x'.*; --cpus '3' is unknown"),
    ],
)
def test_errors_of_flags_name_the_flag(flags, why):
    """As the command line spells arguments; `test_library` has them as the library does."""

    def sweep():
        SPELLING.set(flag_of)
        settings(flags).sweep()

    with pytest.raises(InputError, match=why):
        copy_context().run(sweep)


@pytest.mark.parametrize(("content", "why"), [(b"N = ", "is not valid TOML"), (b"\xff\xfe", "cannot be read")])
def test_a_file_that_is_no_toml(tmp_path, content, why):
    (tmp_path / "g.toml").write_bytes(content)
    with pytest.raises(InputError, match=why):
        settings({}, tmp_path / "g.toml")
    with pytest.raises(InputError, match="not found"):
        settings({}, tmp_path / "none.toml")


@pytest.mark.parametrize(
    ("flags", "line"),
    [
        ("--speed 0.78", "N = 4"),
        ("--context-switch 0.01", "N = 4"),
        ("-M 1", "N = 4"),
        ("", "N = 4\ncpus = 2\nM = 1\nL = 3\nspeed = 0.78\ncontext_switch = 0.01"),
        ("", 'N = 4\nmethod = "larsen"\ngain = "at-update"\nfeedback = "next-step"\nlr_propagate_by = "m"'),
        ("--cpus 1", "N = 4\ncpus = [1, 2]"),
    ],
)
def test_flags_beside_a_grid_file_and_bare_values_in_it(sched_sim: Run, tmp_path: Path, flags: str, line: str) -> None:
    (tmp_path / "grid.toml").write_text(line)
    assert sched_sim(f"sweep grid.toml --method larsen {flags}").code == 0


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("gain = 3", ["gain", "'3'", "at-update"]),
        ("cpus = true", ["cpus", "'True'", "1, 2"]),
        ('costs = ""', ["costs", "give the name of a shipped cost table, or the path"]),
        ('tasks = ""', ["tasks", "give the path of a TOML file"]),
        ("feedback = []", ["feedback", "empty", "next-step"]),
        ("method = { larsen = 1 }", ["method", "larsen"]),
        ("lr_propagate_by = [[]]", ["lr_propagate_by: the value must be text, or a list of it: choose from m, l"]),
    ],
)
def test_a_value_of_a_grid_file_that_is_none(sched_sim: Run, tmp_path: Path, line: str, said: list[str]) -> None:
    (tmp_path / "grid.toml").write_text(f"N = 4\n{line}")
    is_refused(sched_sim("sweep grid.toml"), ["grid.toml", *said])


def test_cost_tables_without_a_common_method(sched_sim: Run) -> None:
    is_refused(
        sched_sim("sweep -N 4 --costs steffes2014 --costs erkf-position"),
        ["--costs", "no method in common", "steffes2014", "robust-lu"],
    )
