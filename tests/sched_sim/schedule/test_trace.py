"""Traces hold every slice, in the formats of other tools."""

from __future__ import annotations

import csv
import json
from collections import Counter
from fractions import Fraction
from pathlib import Path

import pytest

from sched_sim.costs.table_file import load_costs
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.scenario.run import run_scenario
from sched_sim.schedule.outcome import Schedule
from sched_sim.schedule.trace import open_trace
from tests.scenarios import BY_HAND, scenario, sensor


def traced(path: Path, speed: str = "0.77", hr_hz: int | None = None) -> Schedule:
    costs = select(load_costs("steffes2014"), "dual-rate", Options())
    with open_trace(path, hr_hz) as write:
        return simulate(costs, Timing(10, 4, 8), Fraction(speed), 3, on_slice=write)


def test_csv_rows_add_up_to_the_busy_time_by_piece(tmp_path: Path) -> None:
    schedule = traced(tmp_path / "slices.csv")
    with (tmp_path / "slices.csv").open() as file:
        rows = list(csv.DictReader(file))
    work: Counter[str] = Counter()
    for row in rows:
        work[row["piece"]] += round((float(row["end_periods"]) - float(row["start_periods"])) * schedule.period)
    assert work == {"HRP": 3 * (9 * 63 + 4), "HRU": 3 * 3, "LRP": 3 * 41, "LRU": 3 * 56}
    assert {row["missed"] for row in rows} == {"0"}


def test_chrome_trace_has_complete_events_in_microseconds_and_named_threads(tmp_path: Path) -> None:
    schedule = traced(tmp_path / "trace.json", hr_hz=400)
    events = json.loads((tmp_path / "trace.json").read_text())["traceEvents"]
    complete = [event for event in events if event["ph"] == "X"]
    assert sum(event["dur"] for event in complete) == pytest.approx(schedule.busy / schedule.period * 2500)
    assert {"name", "ts", "dur", "pid", "tid"} <= set(complete[0])
    names = {event["args"]["name"] for event in events if event["name"] == "thread_name"}
    assert names == {"hr", "lr_propagate", "lr_update"}
    assert not [event for event in events if event["ph"] == "i"]


def test_misses_are_marked_those_of_unfinished_jobs_too(tmp_path: Path) -> None:
    schedule = traced(tmp_path / "late.json", speed="0.7")
    events = json.loads((tmp_path / "late.json").read_text())["traceEvents"]
    late = [event for event in events if event["ph"] == "i" and event["name"] == "missed"]
    assert len(late) == schedule.misses == 3
    assert [event["ts"] for event in late if event["args"]["step"] == 20] == [30 * 1000]  # unfinished there


def test_a_job_that_never_ran_is_in_both_traces(tmp_path: Path) -> None:
    """At half the load all three LR updates, due at 8, 18 and 28, wait for LR propagate, which waits for HR jobs."""
    traced(tmp_path / "slices.csv", speed="0.5")
    with (tmp_path / "slices.csv").open() as file:
        rows = [row for row in csv.DictReader(file) if row["kind"] == "lr_update"]
    shown = [
        [
            row[name]
            for name in ("piece", "step", "start_periods", "end_periods", "deadline_periods", "finished", "missed")
        ]
        for row in rows
    ]
    assert shown == [["unfinished", str(k), "30.0", "30.0", f"{k + 8}.0", "0", "1"] for k in (0, 10, 20)]
    traced(tmp_path / "slices.json", speed="0.5")
    events = json.loads((tmp_path / "slices.json").read_text())["traceEvents"]
    (thread,) = [event["tid"] for event in events if event["args"].get("name") == "lr_update"]
    missed = [event for event in events if event["name"] == "missed" and event["tid"] == thread]
    assert [(event["ts"], event["args"]["step"]) for event in missed] == [(30_000, k) for k in (0, 10, 20)]


def test_corrections_that_go_together_are_all_in_both_traces(tmp_path: Path) -> None:
    """Both arrive at 60 and are done from 64 to 75, of 30 a step; the imu's, of step 1, is the second."""
    late = sensor("gps", 100, 2), sensor("imu", 100, 1, offset=1)
    for name in ("slices.csv", "slices.json"):
        with open_trace(tmp_path / name) as write:
            run_scenario(scenario(30, BY_HAND, *late, steps=4), on_slice=write)
    with (tmp_path / "slices.csv").open() as file:
        (row,) = [row for row in csv.DictReader(file) if row["kind"] == "correct imu"]
    columns = ("piece", "step", "start_periods", "end_periods", "release_periods", "finished", "missed")
    assert [row[name] for name in columns] == [
        "together", "1", "2.5", "2.5", "2.0", "1", "0",
    ]  # fmt: skip
    events = json.loads((tmp_path / "slices.json").read_text())["traceEvents"]
    assert [event["ts"] for event in events if event["name"] == "together"] == [2500]


@pytest.mark.parametrize(("name", "said"), [("trace.txt", r"must end in \.csv or \.json"), ("no/t.csv", "cannot be")])
def test_a_path_that_cannot_be_is_refused(tmp_path: Path, name: str, said: str) -> None:
    with pytest.raises(InputError, match=said), open_trace(tmp_path / name):
        pass


def test_processors_of_a_chrome_trace_may_have_names(tmp_path: Path) -> None:
    costs = select(load_costs("steffes2014"), "dual-rate", Options(cpus=2))
    with open_trace(tmp_path / "trace.json", names=["sensor core", "filter core"]) as write:
        simulate(costs, Timing(10, 4, 8), Fraction("0.77"), 1, Options(cpus=2), on_slice=write)
    events = json.loads((tmp_path / "trace.json").read_text())["traceEvents"]
    names = {event["args"]["name"] for event in events if event["name"] == "process_name"}
    assert names == {"sensor core, 1 ms = 1 HR period", "filter core, 1 ms = 1 HR period"}
