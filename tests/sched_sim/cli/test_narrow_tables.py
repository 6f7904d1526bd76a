"""Tables in narrow terminals: nothing is wider than the terminal, and no number and no name is broken."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.command_line import Result, Run

ROCKET = Path(__file__).parents[2] / "rocket.toml"
TASKS = '[[task]]\nname = "control law"\nperiod = 2\noffset = 0.5\ncost = 0.1\npriority = 5\n'
PARTS = "--processor cortex-m4f --hr-hz 400"
TABLES = [
    "minimum -N 10 -M 4",
    "minimum -N 10 -M 4 --hr-hz 400",
    f"minimum -N 80 -M 40 --costs counted-9-3-3 {PARTS}",
    "simulate -N 10 -M 4 --speed 1.2 --tasks tasks.toml --hr-hz 400",
    f"simulate --scenario {ROCKET}",
    "processors",
    "processors -N 40 -M 20 --hr-hz 400",
    "sweep -N 10:30:10 -M 1:4",
    f"sweep -N 10 -M 4 --costs counted-9-3-3 {PARTS}",
    "accuracy --model ins-gps",
    "design --within 0.38 --model ins-gps",
]

SAID = "left out, as the terminal is narrow --format json has all (9 (246 of them were there before)"
"""By a narrow table, and by a sweep that has been done before."""


@pytest.fixture
def terminal(sched_sim: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Run:
    """Runs a command line in a terminal of the width that its first word says."""
    (tmp_path / "tasks.toml").write_text(TASKS)

    def run(line: str) -> Result:
        width, command = line.split(" ", 1)
        monkeypatch.setenv("FORCE_COLOR", "1")
        monkeypatch.setenv("COLUMNS", width)
        result = sched_sim(command)
        return result._replace(out=re.sub(r"\x1b\[[0-9;]*m", "", result.out))

    return run


@pytest.mark.parametrize(
    "width", [pytest.param(60, marks=pytest.mark.exhaust), 80, pytest.param(120, marks=pytest.mark.exhaust)]
)
@pytest.mark.parametrize("line", TABLES)
def test_a_narrow_table_breaks_no_number_and_no_name(line: str, width: int, terminal: Run) -> None:
    narrow, wide = terminal(f"{width} {line}"), terminal(f"400 {line}")
    assert narrow.code == 0
    assert max(map(len, narrow.out.splitlines())) <= width
    whole = pieces(f"{wide.out} {SAID}")
    assert pieces(narrow.out) <= whole


def pieces(text: str) -> set[str]:
    """Numbers, names and words as they stand between spaces and the signs that end them."""
    return set(re.findall(r"[^\s:;,─]+", text))


def test_what_is_left_out_is_said_the_least_important_first(terminal: Run) -> None:
    out = terminal("60 simulate -N 10 -M 4 --speed 1.2 --tasks tasks.toml").out
    assert "narrow: preempted, jobs; " in out
    assert "task:control law " in out
    assert "left out" not in terminal("80 simulate -N 10 -M 4 --speed 1.2 --tasks tasks.toml").out


def test_each_row_is_a_list_where_no_table_fits(terminal: Run) -> None:
    out = terminal(f"60 minimum -N 80 -M 40 --costs counted-9-3-3 {PARTS}").out
    assert "\nmethod: dual-rate\nstructure: dense\nfits: yes\nneeds, MHz: 12.83\nof its speed: 7.64 %\n" in out
    assert "left out" not in out


@pytest.mark.parametrize("columns", [None, "", "0", "-80", "wide", "9" * 30])
def test_a_table_into_a_pipe_is_as_wide_as_it_needs_to_be(
    sched_sim: Run, monkeypatch: pytest.MonkeyPatch, columns: str | None
) -> None:
    with monkeypatch.context() as environment:  # `pytest -v` reads it too
        environment.delenv("COLUMNS")
        if columns is not None:
            environment.setenv("COLUMNS", columns)
        out = sched_sim(f"simulate --scenario {ROCKET}").out
    assert "left out" not in out
    assert re.search(r"job +jobs +finished +min +mean +median +p95 +p99 +max +missed +P\(miss\) +95 % interval", out)


@pytest.mark.parametrize("columns", [60, 80, 120])
def test_a_table_into_a_pipe_is_no_wider_than_asked_for(
    sched_sim: Run, monkeypatch: pytest.MonkeyPatch, columns: int
) -> None:
    monkeypatch.setenv("COLUMNS", str(columns))
    out = sched_sim("simulate -N 10 -M 4 --speed 1.2 --hr-hz 400").out
    assert max(map(len, out.splitlines())) <= columns
    assert ("left out, as COLUMNS is 60: preempted" in out) == (columns == 60)
