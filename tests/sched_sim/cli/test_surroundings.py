"""What surrounds a command: its streams, its folder, its user. Each needs a process of its own."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

DESIGN = "minimum -N 10 -M 4"
TASK = '[[task]]\nname = "日本 \\u001b[2J"\nperiod = 2\ncost = 0.1\npriority = 5\n'

NOBODY = """
import os, pwd
os.environ.pop("HOME", None)
def unknown(*_): raise KeyError("uid not found")
pwd.getpwuid = unknown
from sched_sim.cli import main
main()
"""


def shell(line: str, folder: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    """`$S` in the line stands for sched-sim."""
    script = 'S() { "$PYTHON" -c "from sched_sim.cli import main; main()" "$@"; }\n' + line.replace("$S", "S")
    found = {**os.environ, "PYTHON": sys.executable, **environment}
    return subprocess.run(
        ["bash", "-c", script], cwd=folder, env=found, capture_output=True, text=True, check=False, encoding="utf-8"
    )


@pytest.mark.parametrize(("command", "buffered"), [(DESIGN, ""), (f"{DESIGN} --format json", "1"), ("--help", "")])
def test_a_full_disk(tmp_path: Path, command: str, buffered: str) -> None:
    if not Path("/dev/full").exists():
        pytest.skip("no /dev/full")
    result = shell(f"$S {command} > /dev/full", tmp_path, PYTHONUNBUFFERED=buffered)
    assert (result.returncode, result.stderr) == (
        2,
        "Error: standard output cannot be written: No space left on device; make room, or send it elsewhere\n",
    )


def test_standard_output_is_closed(tmp_path: Path) -> None:
    result = shell(f"$S {DESIGN} >&-", tmp_path)
    assert (result.returncode, result.stderr) == (
        2,
        "Error: standard output is closed: open it, or send it to a file or to /dev/null\n",
    )


def test_a_file_is_whole_although_the_streams_are_closed(tmp_path: Path) -> None:
    assert shell("$S gantt -N 4 -M 1 -o g.svg >&- 2>&- <&-", tmp_path).returncode == 0
    assert (tmp_path / "g.svg").read_text().startswith("<?xml")


def test_standard_error_is_closed(tmp_path: Path) -> None:
    result = shell(f"$S {DESIGN} 2>&-", tmp_path)
    assert result.returncode == 0
    assert "larsen" in result.stdout
    assert shell(f"$S {DESIGN} -L 3 2>&-", tmp_path).returncode == 2


@pytest.mark.parametrize("command", [DESIGN, "simulate -N 4 -M 1 --speed 2 --cycles 9999 --format json"])
def test_a_reader_that_has_seen_enough(tmp_path: Path, command: str) -> None:
    result = shell(f"$S {command} | true; echo ${{PIPESTATUS[0]}}", tmp_path)
    assert result.stderr == ""
    assert result.stdout.strip() in ("0", "1")


@pytest.mark.parametrize(
    "encoding",
    [
        pytest.param({"PYTHONIOENCODING": "ascii"}, marks=pytest.mark.exhaust),
        {"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"},
    ],
)
def test_ascii_only(tmp_path: Path, encoding: dict[str, str]) -> None:
    (tmp_path / "tasks.toml").write_text(TASK, encoding="utf-8")
    result = shell(
        "$S simulate -N 10 -M 4 --speed 2 --tasks tasks.toml; $S gantt -N 4 -M 1 -o é.svg", tmp_path, **encoding
    )
    assert result.returncode == 0
    assert r"task:\u65e5\u672c \x1b[2J" in result.stdout
    assert "Traceback" not in result.stderr
    assert result.stdout.isascii()
    assert result.stderr.isascii()


def test_the_folder_has_been_deleted(tmp_path: Path) -> None:
    gone = tmp_path / "gone"
    gone.mkdir()
    result = shell('rmdir "$PWD"; $S gantt -N 4 -M 1', gone)
    assert result.returncode == 2
    assert "gantt.svg" in result.stderr
    assert "Traceback" not in result.stderr


def test_a_user_without_home_and_entry(tmp_path: Path) -> None:
    command = [sys.executable, "-c", NOBODY, "gantt", "-N", "4", "-M", "1", "-o", "g.svg"]
    result = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert result.returncode == 0
    assert "Traceback" not in result.stderr
    assert (tmp_path / "g.svg").exists()


@pytest.mark.parametrize("module", ["numpy", "typer"])
def test_ctrl_c_while_a_module_is_imported(tmp_path: Path, module: str) -> None:
    (tmp_path / "interrupted.py").write_text(
        "import builtins, os, signal\n"
        "imported = builtins.__import__\n"
        "def stop(name, *rest, **more):\n"
        f"    if name == {module!r}: os.kill(os.getpid(), {signal.SIGINT.value})\n"
        "    return imported(name, *rest, **more)\n"
        "builtins.__import__ = stop\n"
        "from sched_sim.cli import main\n"
        "main()\n"
    )
    command = [sys.executable, "interrupted.py", "gantt", "-N", "4", "-M", "1"]
    result = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (result.returncode, result.stderr) == (130, "")
