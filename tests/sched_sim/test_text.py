"""The door through which text of the user's goes, and that every way to show it leads through the door."""

from __future__ import annotations

import csv
import io
import json
import warnings
from pathlib import Path
from xml.etree import ElementTree

import pytest

from sched_sim.text import csv_cell, json_text, visible, visible_lines
from tests.command_line import Run
from tests.svg import texts_of

TASK = "[[task]]\nname = {}\noffset = 0\nperiod = 2\ncost = 0.1\npriority = 5\n"


def write_tasks(folder: Path, *names: str) -> None:
    (folder / "tasks.toml").write_text("".join(TASK.format(json.dumps(name)) for name in names), encoding="utf-8")


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("imu [a]", "imu [a]"),
        ("日本 é", "日本 é"),
        ("\x1b[2J", r"\x1b[2J"),
        ("a\nb\t\r", r"a\nb\t\r"),
        ("\x7f\x85\u202e\ufeff", r"\x7f\x85\u202e\ufeff"),
        ("\udcff", r"\udcff"),
        ("", ""),
    ],
)
def test_what_has_no_shape_is_shown_as_its_escape(text: str, shown: str) -> None:
    assert visible(text) == shown


def test_lines_stay_and_are_seen_to_go_on() -> None:
    assert visible_lines("a\nError: b\x1b") == "a\n  Error: b\\x1b"


@pytest.mark.parametrize("formula", ["=1+1", "+1", "-1", "@SUM(A1)"])
def test_a_cell_of_text_is_no_formula(formula: str) -> None:
    assert csv_cell(formula) == "'" + formula
    assert csv_cell(-1) == -1
    assert csv_cell("\t=1") == r"\t=1"


def test_json_is_ascii_that_strict_parsers_take() -> None:
    text = json_text({"a\udcff": ["\ud800", "日", 1, None]})
    assert text.encode("ascii")
    assert json.loads(text) == {r"a\udcff": [r"\ud800", "日", 1, None]}


def test_names_in_a_table_are_no_markup_and_reach_no_terminal_as_controls(sched_sim: Run, tmp_path: Path) -> None:
    write_tasks(tmp_path, "[/x]", "imu [a]", ":bug:", "\x1b[2J", "日本")
    result = sched_sim("simulate -N 10 -M 4 --speed 3 --tasks tasks.toml")
    assert result.code == 0
    for name in ("[/x]", "imu [a]", ":bug:", r"\x1b[2J", "日本"):
        assert f"task:{name} " in result.out
    assert "\x1b" not in result.out


@pytest.mark.parametrize("line", ["minimum -N \x1b[2J", "minimum -N 4 -M 1 \x1b[2J", "\x1b[2J", "minimum --\x1b[2J 1"])
def test_wrong_arguments_are_repeated_without_controls(sched_sim: Run, line: str) -> None:
    result = sched_sim(line)
    assert result.code == 2
    assert r"\x1b[2J" in result.err
    assert "\x1b" not in result.err


def test_csv_has_no_formula(sched_sim: Run, tmp_path: Path) -> None:
    write_tasks(tmp_path, "=1+1")
    assert sched_sim("simulate -N 10 -M 4 --speed 3 --tasks tasks.toml --trace t.csv").code == 0
    labels = [row["piece"] for row in csv.DictReader(io.StringIO((tmp_path / "t.csv").read_text()))]
    assert "'=1+1" in labels
    assert "=1+1" not in labels


def test_the_cost_tables_name_in_an_export_is_no_formula(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "c.toml").write_text('name = "=1+1"\nunit = "u"\n[costs.standard]\npropagate = 1\nupdate = 1\n')
    assert sched_sim("sweep -N 2 --costs c.toml --export e.csv").code == 0
    assert {row["costs"] for row in csv.DictReader(io.StringIO((tmp_path / "e.csv").read_text()))} == {"'=1+1"}


@pytest.mark.parametrize("name", [r"$\foo$", "$", "a$b$", r"\$", "\x01\x1b\ufffe", "日本", "-->", "&<"])
def test_any_name_can_be_drawn(sched_sim: Run, tmp_path: Path, name: str) -> None:
    write_tasks(tmp_path, name)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = sched_sim("gantt -N 4 -M 1 --method larsen --speed 3 --tasks tasks.toml -o g.svg")
    assert (result.code, result.err) == (0, "Wrote g.svg\n")
    ElementTree.parse(tmp_path / "g.svg")


def test_a_dollar_sign_is_drawn_as_one(sched_sim: Run, tmp_path: Path) -> None:
    write_tasks(tmp_path, r"$\alpha$", "日")
    sched_sim("gantt -N 4 -M 1 --method larsen --speed 3 --tasks tasks.toml -o g.svg")
    drawn = texts_of(tmp_path / "g.svg")
    assert r"$\alpha$" in drawn
    assert r"\u65e5" in drawn


def test_a_name_of_any_length_is_measured_a_few_times(monkeypatch: pytest.MonkeyPatch) -> None:
    from reports.charts import lanes

    measured = []
    width = lanes.text_width_mm
    monkeypatch.setattr(
        lanes, "text_width_mm", lambda *args, **settings: measured.append(1) or width(*args, **settings)
    )
    found = lanes.shortened("x" * 3000)
    assert found.endswith("…")
    assert width(found) <= lanes.LONGEST_NAME_MM < width("x" + found)
    assert len(measured) < 20
