"""The README's files and commands work as printed."""

from __future__ import annotations

import re
import shlex
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import filters.modular
from sched_sim.cli import main
from sched_sim.costs.table_file import load_costs
from sched_sim.design.timing import Timing
from studies.steffes import cells, least_speeds

README = (Path(__file__).parents[1] / "README.md").read_text()
BLOCKS = re.findall(r"```(\w*)\n(.*?)```", README, re.DOTALL)


def block(language: str, text: str) -> str:
    """The one code block of this language that holds this text."""
    (found,) = [body for kind, body in BLOCKS if kind == language and text in body]
    return found


def run(line: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "argv", shlex.split(line, comments=True))
    try:
        main()
    except SystemExit as stop:
        code = stop.code
    else:
        code = 0
    assert not code, line


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the files that the README shows."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.toml").write_text(block("toml", "[costs.larsen]"))
    (tmp_path / "tasks.toml").write_text(block("toml", "[[task]]"))
    (tmp_path / "mypart.toml").write_text(block("toml", 'name = "mypart"'))
    (tmp_path / "counts.toml").write_text(block("toml", "[operations.larsen]"))
    (tmp_path / "pendulum.py").write_text(block("python", "def system"))
    (tmp_path / "vehicle.py").write_text(block("python", "def vehicle"))
    (tmp_path / "vehicle.toml").write_text(block("toml", "[[sensor]]"))
    return tmp_path


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("options", ["--costs mine.toml", "--processor cortex-m4f"])
def test_the_output_shown_is_the_output(
    options: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    shown_blocks = [body for _, body in BLOCKS if body.startswith("$ sched-sim minimum")]
    (found,) = [body for body in shown_blocks if options in body.partition("\n")[0]]
    command, _, shown = found.removeprefix("$ ").partition("\n")
    run(command, monkeypatch)
    printed = [line.rstrip() for line in capsys.readouterr().out.splitlines()]
    assert [line for line in printed if line] == [line.rstrip() for line in shown.splitlines() if line]


@pytest.mark.slow
@pytest.mark.usefixtures("folder")
def test_every_command_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    lines = [line for kind, body in BLOCKS if not kind for line in body.splitlines() if line.startswith("sched-sim")]
    lines += re.findall(r"`(sched-sim (?:minimum|gantt|sweep) -[^`.]*(?:\.\w[^`]*)?)`", README)
    lines.append("sched-sim minimum -N 10 -M 4 --tasks tasks.toml")
    assert len(lines) >= 9
    for line in lines:
        run(line, monkeypatch)


def test_the_composed_filter_runs_on_data(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(folder)
    names: dict[str, Any] = {}
    exec(block("python", "from vehicle import vehicle"), names)
    composed, x0, P0, inputs = (names[name] for name in ("composed", "x0", "P0", "inputs"))
    x = names["history"].x
    without_gps = filters.modular.run(composed, x0, P0, inputs, names["measurements"][:1]).x
    assert np.array_equal(x[:120], without_gps[:120])
    assert not np.array_equal(x[120], without_gps[120])


def test_the_answer_from_python_is_the_one_shown(capsys: pytest.CaptureFixture[str]) -> None:
    shown = block("python", "from sched_sim import")
    exec(shown, {})
    assert capsys.readouterr().out.strip() == shown.rpartition("# ")[2].strip()


def test_the_table_of_least_speeds_is_what_the_analysis_gives() -> None:
    """Each row of "What it finds": printed, from the paper's costs, from counted operations."""
    timing = None
    rows = re.findall(r"^\| (.*) \|$", README.partition("## What it finds")[2].partition("Larsen's method")[0], re.M)
    paper, counted = load_costs("steffes2014"), load_costs("counted-9-3-3")
    cell_of = {(cell.timing, cell.method): cell for cell in cells(paper)}
    checked = 0
    for row in rows[2:]:
        *design, name, printed, analysed, by_counts = (part.strip(" *") for part in row.split("|"))
        timing = Timing(*map(int, design)) if design[0] else timing
        assert timing is not None
        method = {"Larsen": "larsen"}.get(name, name)
        cell = cell_of[timing, method]
        assert float(printed) == float(cell.printed)
        assert analysed in (f"{float(cell.computed.speed):.2f}", f"{float(cell.computed.speed):.3f}")
        assert by_counts == f"{float(least_speeds(counted, timing)[method].speed):.2f}"
        checked += 1
    assert checked == 9
