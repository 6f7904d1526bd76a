"""Files that commands write: none is lost to a command that is refused, nor to another that it reads or writes."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from tests.command_line import Run, is_refused
from tests.full_disk import room_for

COSTS = 'name = "mine"\nunit = "step"\n[costs.larsen]\npropagate = 0.4\npropagate_accumulate = 0.5\nupdate = 0.6\n'
TASKS = '[[task]]\nname = "control"\nperiod = 2\ncost = 0.1\npriority = 5\n'
SCENARIO = """
name = "s"
steps = 40
hr_hz = 400
costs = "samples.toml"
processor = "part.toml"
[[sensor]]
name = "gps"
every = 8
"""
SAMPLES = """
name = "mine"
unit = "operation"
[operations]
predict = { multiply = 10, add = 10 }
[operations.correct]
gps = { multiply = 20, add = 10 }
"""
PART = """
name = "part"
title = "a part"
precision = "double"
clock_mhz = 100
logic_per_arithmetic = 1
[cycles]
multiply = 1
add = 1
divide = 10
sqrt = 10
logic = 1
"""
MODEL = """
from filters.systems.example import example_system
import constants
def system():
    return example_system(2, 1, 1)
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """With files to be read, each also under the name of something that is written, by a link of either kind."""
    texts = {"mine.toml": COSTS, "tasks.toml": TASKS, "s.toml": SCENARIO, "samples.toml": SAMPLES, "part.toml": PART}
    texts |= {"model_of_mine.py": MODEL, "constants.py": "", "grid.toml": "N = 5\nM = 2\ncosts = 'mine.toml'\n"}
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
        for suffix in (".svg", ".csv"):
            (tmp_path / name).with_suffix(suffix).symlink_to(name)
        for suffix in (".png", ".json", ".parquet"):
            os.link(tmp_path / name, (tmp_path / name).with_suffix(suffix))
    (tmp_path / "a.json").write_text("earlier")
    (tmp_path / "b.json").symlink_to("./a.json")
    (tmp_path / "folder").mkdir()
    monkeypatch.setattr(sys, "path", list(sys.path))
    for module in ("model_of_mine", "constants"):
        monkeypatch.delitem(sys.modules, module, raising=False)
    return tmp_path


def contents(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


DESIGN = "-N 10 -M 4 --method larsen"


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (f"simulate {DESIGN} --trace a.json --trace b.txt", ["--trace 'b.txt'", ".csv or .json"]),
        (f"simulate {DESIGN} --trace a.json --trace none/b.csv", ["--trace 'none/b.csv'", "folder that exists"]),
        (f"simulate {DESIGN} --trace a.json --trace folder", ["--trace 'folder'"]),
        (f"simulate {DESIGN} --trace a.json --gantt none/p.svg", ["none/p.svg"]),
        (f"simulate {DESIGN} --trace a.json --costs none.toml", ["none.toml"]),
        ("simulate -N 10 -M 40 -L 39 --trace a.json", ["M=40"]),
        (f"simulate {DESIGN} --trace a.json --trace b.json", ["--trace a.json and --trace b.json", "one file"]),
        (f"simulate {DESIGN} --trace a.json --trace folder/../a.json", ["one file"]),
        (f"simulate {DESIGN} --costs mine.toml --trace mine.csv", ["--trace mine.csv", "what --costs mine.toml reads"]),
        (f"simulate {DESIGN} --costs mine.toml --trace mine.json", ["what --costs mine.toml reads"]),
        (f"simulate {DESIGN} --tasks tasks.toml --gantt tasks.svg", ["what --tasks tasks.toml reads"]),
        (f"simulate {DESIGN} --processor part.toml --gantt part.png", ["what --processor part.toml reads"]),
        (f"gantt {DESIGN} --costs mine.toml -o mine.svg", ["--output mine.svg", "what --costs mine.toml reads"]),
        (f"gantt {DESIGN} --tasks tasks.toml -o tasks.png", ["what --tasks tasks.toml reads"]),
        (f"gantt {DESIGN} --processor part.toml -o part.svg", ["what --processor part.toml reads"]),
        ("simulate --scenario s.toml --histogram s.svg", ["--histogram s.svg", "what --scenario s.toml reads"]),
        ("simulate --scenario s.toml --gantt samples.svg", ["what --scenario samples.toml reads"]),
        ("simulate --scenario s.toml --trace part.json", ["--trace part.json", "what --scenario part.toml reads"]),
        ("simulate --scenario s.toml --trace a.json --trace b.txt", ["--trace 'b.txt'"]),
        ("measure --system model_of_mine:system --backend counted -o model_of_mine.py", ["--output model_of_mine.py"]),
        ("measure --system model_of_mine:system --backend counted -o constants.csv", ["--output constants.csv"]),
        ("sweep grid.toml --export grid.csv", ["--export grid.csv", "what GRID grid.toml reads"]),
        ("sweep grid.toml --export mine.parquet", ["--export mine.parquet", "what --costs mine.toml reads"]),
        ("sweep grid.toml --results grid.toml", ["--results grid.toml", "what GRID grid.toml reads"]),
        ("sweep -N 5 --costs mine.toml --results mine.json", ["--results mine.json", "what --costs mine.toml reads"]),
        ("sweep -N 5 --export d.csv --export ./d.csv", ["--export d.csv and --export d.csv", "one file"]),
        ("sweep -N 5 --results folder/../d.csv --export d.csv", ["one file"]),
    ],
)  # fmt: skip
def test_a_refused_command_changes_no_file(sched_sim: Run, folder: Path, line: str, said: list[str]) -> None:
    before = contents(folder)
    is_refused(sched_sim(line), said)
    assert contents(folder) == before


@pytest.mark.parametrize(
    "line",
    [
        f"gantt {DESIGN} -o out.svg",
        f"simulate {DESIGN} --gantt out.svg",
        f"simulate {DESIGN} --cycles 500 --trace out.csv",
        f"simulate {DESIGN} --cycles 500 --trace out.json",
        "simulate --scenario s.toml --histogram out.svg",
        "measure --states 2 --inputs 1 --measurements 1 --backend counted -o out.toml",
        "report patent-multirate -o .",
    ],
)
def test_a_full_disk_is_one_message_and_leaves_every_file_whole(
    sched_sim: Run, folder: Path, line: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    files = {"out.svg": bytes(9000), "index.html": b"</main>"}
    monkeypatch.setattr("sched_sim.cli.report.REPORTS", {"patent-multirate": lambda _thorough, _progress: files})
    reports = folder / "patent-multirate"
    reports.mkdir()
    outputs = [path / f"out.{kind}" for path in (folder, reports) for kind in ("svg", "csv", "json", "toml")]
    for path in outputs:
        path.write_text("earlier")
    before = contents(folder), contents(reports)
    with room_for(700):
        result = sched_sim(line)
    assert result.code == 2
    assert result.err.startswith("Error: ")
    assert result.err.count("\n") == 1
    assert "out." in result.err
    assert "make room there" in result.err
    assert (contents(folder), contents(reports)) == before
