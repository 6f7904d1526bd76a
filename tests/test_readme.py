"""The README's files and commands work as printed."""

from __future__ import annotations

import re
import shlex
import sys
from pathlib import Path

import pytest

from sched_sim.cli import main

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
    (tmp_path / "pendulum.py").write_text(block("python", "def system"))
    return tmp_path


@pytest.mark.usefixtures("folder")
def test_the_output_shown_is_the_output(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    command, _, shown = block("", "$ sched-sim minimum").removeprefix("$ ").partition("\n")
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
