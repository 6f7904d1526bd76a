"""`sched-sim sweep` as a script sees it."""

import csv
import io
import json
import os

import pytest

from sched_sim.cli import main


@pytest.fixture
def sweep(tmp_path, monkeypatch, capsys):
    """Runs the command in an empty folder: (exit code, stdout, stderr)."""
    monkeypatch.chdir(tmp_path)

    def run(*arguments):
        monkeypatch.setattr("sys.argv", ["sched-sim", "sweep", *arguments])
        with pytest.raises(SystemExit) as end:
            main()
        return end.value.code or 0, *capsys.readouterr()

    return run


GRID = ("-N", "10:30:10", "-M", "1:4", "--speed", "0.6:1.6:0.05")


def test_json_tells_what_was_found_and_where_it_is(sweep, tmp_path):
    code, out, errors = sweep(*GRID, "--format", "json", "--export", "d.csv", "--export", "d.parquet")
    assert (code, errors) == (0, "")
    told = json.loads(out)
    assert (tmp_path / told["results"]).exists()
    assert told["exports"] == ["d.csv", "d.parquet"]
    lines = (tmp_path / "d.csv").read_text().splitlines()
    assert told["points"] == told["computed"] == len(lines) - 1
    assert told["left_out"] == 0
    assert [row["method"] for row in told["methods"]] == ["standard", "recalculate", "larsen", "dual-rate"]
    assert sum(row["points"] for row in told["methods"]) == told["points"]
    by_design = {(row["N"], row["M"]): row for row in told["best"]}
    assert sorted(by_design) == [(N, M) for N in (10, 20, 30) for M in (1, 2, 3, 4)]
    assert by_design[10, 1]["min_speed_exact"] == "26/25"
    assert by_design[10, 2] | {"costs": "steffes2014", "L": 10, "min_speed_exact": "7/10"} == by_design[10, 2]

    code, out, errors = sweep(*GRID, "--format", "json")
    assert (code, errors, json.loads(out)["computed"]) == (0, "", 0)


def test_csv_is_the_best_designs(sweep):
    code, out, errors = sweep("-N", "10", "-M", "2,4", "--lr-propagate-by", "m,l", "--format", "csv")
    assert (code, errors) == (0, "")
    rows = list(csv.DictReader(io.StringIO(out)))
    assert [(row["N"], row["M"], row["method"]) for row in rows] == [("10", "2", "dual-rate"), ("10", "4", "dual-rate")]
    assert "lr_propagate_by" in rows[0]


def test_a_table_for_people(sweep):
    code, out, errors = sweep("-N", "6,10", "-M", "8")
    assert (code, errors) == (0, "")
    assert "\x1b" not in out
    assert "1 combinations left out as not legal" in out  # of larsen, M > N, which the paper's table has no costs of
    assert "least speed" in out


def test_points_that_are_left_out_are_counted_by_combination(sweep):
    _, out, _ = sweep("-N", "5,10", "-M", "4", "-L", "4,8", "--method", "dual-rate", "--format", "json")
    told = json.loads(out)
    assert (told["points"], told["left_out"]) == (2, 2)  # (5, 4, 8), (10, 4, 8); not L = M


def test_a_grid_file_gives_its_name_to_the_results(sweep, tmp_path):
    (tmp_path / "mine.toml").write_text('N = 5\nM = 2\nsimulate = true\nmethod = "larsen"\n')
    code, out, _ = sweep("mine.toml", "--format", "json")
    assert code == 0
    assert json.loads(out)["results"].startswith("mine-")


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        ((), "N is missing: give -N"),
        (("-N", "5", "-M", "6", "-L", "3"), "the grid is empty: none of the 4 combinations of N=5, M=6, L=3 is legal"),
        (("-N", "5", "--speed", "0"), "--speed '0' must be greater than 0"),
        (("-N", "5", "--method", "kalman"), "--method 'kalman' is unknown: choose from standard"),
        (("-N", "5", "--costs", "none.toml"), "cost table 'none.toml' not found"),
        (("-N", "5", "--gain", "precomputed", "--costs", "steffes2014"), "has no entry [costs.dual-rate] lr_gain"),
        (("-N", "5", "--context-switch", "-1"), "--context-switch '-1' must be 0 or more"),
        (("-N", "5", "--export", "d.xlsx"), "--export d.xlsx: the name must end in .csv or .parquet"),
        (
            ("-N", "5", "--export", "no/d.csv"),
            "--export 'no/d.csv' cannot be written: give a file in a folder that exists",
        ),
        (("-N", "5", "--results", "no/r.sqlite"), "no/r.sqlite cannot be written"),
        (("-N", "5", "--results", "r.csv", "--export", "r.csv"), "--results r.csv and --export r.csv are one file"),
        (("-N", "5", "--results", "held.txt"), "held.txt is not a results file of a sweep"),
        (("none.toml",), "grid file 'none.toml' not found"),
    ],
)
def test_bad_input_is_one_message_and_exit_code_2(sweep, tmp_path, arguments, why):
    (tmp_path / "held.txt").write_text("mine")
    code, out, errors = sweep(*arguments)
    assert (code, out) == (2, "")
    assert errors.startswith("Error: ")
    assert why in errors
    assert errors.count("\n") == 1
    assert os.listdir(tmp_path) == ["held.txt"]
    assert (tmp_path / "held.txt").read_text() == "mine"


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_progress_goes_to_a_terminal_and_nowhere_else(sweep, monkeypatch):
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr("sys.stderr", terminal := Terminal())
    code, out, _ = sweep("-N", "5", "--format", "json")
    assert code == 0
    json.loads(out)
    assert "33/33" in terminal.getvalue()
