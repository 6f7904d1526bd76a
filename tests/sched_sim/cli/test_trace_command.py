"""A trace says what its times are in."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import pytest

from tests.command_line import Run

LINE = "simulate -N 10 -M 4 -L 8 --speed 0.77"


def rows(path: Path) -> list[dict[str, str]]:
    with path.open() as file:
        return list(csv.DictReader(file))


def events(path: Path, phase: str) -> list[dict[str, Any]]:
    return [event for event in json.loads(path.read_text())["traceEvents"] if event["ph"] == phase]


def test_without_a_rate_columns_are_in_periods_and_a_viewer_is_told_what_a_ms_is(
    sched_sim: Run, tmp_path: Path
) -> None:
    assert sched_sim(f"{LINE} --trace t.csv --trace t.json").code == 0
    (last,) = [row for row in rows(tmp_path / "t.csv") if (row["piece"], row["finished"]) == ("LRU", "1")][-1:]
    assert {key: last[f"{key}_periods"] for key in ("end", "release", "deadline")} == {
        "end": "28.0",
        "release": "24.0",
        "deadline": "28.0",
    }
    document = json.loads((tmp_path / "t.json").read_text())
    assert document["displayTimeUnit"] == "ms"
    assert document["otherData"] == {"time_unit": "1 ms = 1 HR period", "hr_hz": None}
    names = {event["args"]["name"] for event in events(tmp_path / "t.json", "M") if event["name"] == "process_name"}
    assert names == {"CPU 1, 1 ms = 1 HR period"}
    assert "ms" not in " ".join(last)


def test_with_a_rate_times_are_true(sched_sim: Run, tmp_path: Path) -> None:
    """At 400 Hz a period is 2.5 ms; the last LR update ends as step 28 starts."""
    assert sched_sim(f"{LINE} --hr-hz 400 --trace t.csv --trace t.json").code == 0
    (last,) = [row for row in rows(tmp_path / "t.csv") if (row["piece"], row["finished"]) == ("LRU", "1")][-1:]
    assert [float(last[f"{key}_ms"]) for key in ("end", "release", "deadline")] == [70.0, 60.0, 70.0]
    assert not [key for key in last if "periods" in key]
    assert json.loads((tmp_path / "t.json").read_text())["otherData"] == {"time_unit": "ms", "hr_hz": 400.0}
    (update,) = [event for event in events(tmp_path / "t.json", "X") if event["name"] == "LRU"][-1:]
    assert update["ts"] + update["dur"] == pytest.approx(70_000)
    assert update["args"] == {"step": 20, "release_ms": 60.0, "deadline_ms": 70.0}


def test_a_scenario_with_hr_hz_is_traced_in_ms(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(
        'name = "s"\nhr_hz = 100\nsteps = 4\n[predictor]\ncost_ms = 1\n'
        '[[sensor]]\nname = "gps"\nevery = 2\ncost_ms = 2\n'
    )
    assert sched_sim("simulate --scenario s.toml --trace t.csv").code == 0
    found = [
        (float(row["start_ms"]), float(row["end_ms"])) for row in rows(tmp_path / "t.csv") if row["kind"] == "predict"
    ]
    assert found == [(0, 1), (10, 11), (20, 21), (30, 31)]


@pytest.mark.parametrize("suffix", ["csv", "json"])
def test_jobs_that_miss_or_never_run_are_in_it(suffix: str, sched_sim: Run, tmp_path: Path) -> None:
    """At half the load all three LR updates wait to the end and are missed."""
    assert sched_sim(f"simulate -N 10 -M 4 -L 8 --speed 0.5 --trace t.{suffix}").code == 0
    path = tmp_path / f"t.{suffix}"
    if suffix == "csv":
        found = [row for row in rows(path) if row["kind"] == "lr_update"]
        assert [(row["piece"], row["start_periods"], row["missed"]) for row in found] == [
            ("unfinished", "30.0", "1")
        ] * 3
    else:
        missed = [event for event in events(path, "i") if event["name"] == "missed"]
        assert [event["ts"] for event in missed].count(30_000) >= 3
