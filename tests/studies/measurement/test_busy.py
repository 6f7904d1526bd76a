"""A busy machine is noticed by clocks, load and the spread of what was timed, and said wherever that is used."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from filters.registry import ALL_METHODS
from filters.systems.example import example_system
from reports.pages.machine import timed_on
from studies.measurement import methods
from studies.measurement.busy import Clocks, Load, load, own_load, signs_of_others
from studies.measurement.job_times import Protocol, time_jobs
from tests.command_line import Run

IDLE, START, ALONE = Load(0.2, 2), Clocks(5, 7), Clocks(1_000_005, 990_007)
EVEN = [100] * 61

BUSY = "the timing had 63 % of its processor"
NOTE = f"measured on a busy machine: {BUSY}; measure again on an idle one"
COSTS = f"""
name = "mine"
unit = "standard step"
busy = "{BUSY}"
[costs.larsen]
propagate = {{ minimum = 0.4, median = 0.5, p95 = 0.6 }}
propagate_accumulate = 0.6
update = 0.9
"""


def test_an_idle_machine_shows_no_sign() -> None:
    assert signs_of_others(IDLE, START, ALONE, [EVEN, EVEN]) == ""
    assert signs_of_others(Load(None, 2), START, ALONE, [EVEN]) == ""
    assert signs_of_others(Load(3.9, 8), START, ALONE, [EVEN]) == ""
    assert signs_of_others(Load(0.9, 1), START, ALONE, [EVEN]) == ""
    assert signs_of_others(IDLE, START, ALONE, []) == ""


def test_each_sign_is_said_with_its_figure() -> None:
    assert signs_of_others(IDLE, START, Clocks(1_000_005, 630_007), [EVEN]) == BUSY
    assert signs_of_others(Load(2.25, 2), START, ALONE, [EVEN]) == "load average 2.2 on 2 processors before it"
    rough = [100] * 50 + [230] * 11
    said = "p95 is 2.3 times the median, in half of the jobs or more"
    assert signs_of_others(IDLE, START, ALONE, [rough, rough, EVEN]) == said
    assert signs_of_others(IDLE, START, ALONE, [rough, EVEN, EVEN]) == ""
    assert signs_of_others(Load(4, 4), START, Clocks(1_000_005, 500_007), [rough]).count(", ") == 3


def test_what_a_process_has_added_itself_is_no_sign_of_others() -> None:
    assert signs_of_others(Load(1.9, 2, 1.0), START, ALONE, [EVEN]) == ""
    said = "load average 2.1 on 2 processors before it, 1.0 of it its own"
    assert signs_of_others(Load(2.1, 2, 1.0), START, ALONE, [EVEN]) == said


@given(st.floats(0, 4), st.floats(0.01, 1e5), st.floats(0.01, 1e5))
def test_the_own_load_grows_to_the_share_of_processors_that_was_had(share: float, less: float, more: float) -> None:
    first, later = (own_load(share * seconds, int(1e9 * seconds)) for seconds in sorted((less, more)))
    assert 0 <= first <= later + 1e-9
    assert later <= share + 1e-9
    assert own_load(share * 1e4, int(1e13)) == pytest.approx(share)


def test_the_load_is_asked_of_the_system() -> None:
    found = load()
    assert found.average is None or found.average >= 0
    assert found.processors >= 1
    assert 0 <= found.own <= 2 * found.processors


def test_what_was_timed_on_a_busy_machine_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("studies.measurement.job_times.load", lambda: Load(9.0, 2))
    jobs = {("standard", kind): job for kind, job in ALL_METHODS["standard"].jobs(example_system(1, 1, 1)).items()}
    timed = time_jobs(jobs, "numpy", Protocol(2, 1), 0, lambda *_: None)
    assert "load average 9.0 on 2 processors before it" in timed.busy
    about = methods.where_timed(Protocol(2, 1), 0, timed.busy)
    assert about["busy"] == timed.busy
    assert f"**which was busy** ({timed.busy}): times may be too long" in timed_on(about)
    quiet = methods.where_timed(Protocol(2, 1), 0, "")
    assert "busy" not in quiet
    assert "busy" not in timed_on(quiet)


@pytest.mark.parametrize(
    "line",
    [
        "minimum -N 10 -M 4 --method larsen --costs mine.toml",
        "simulate -N 10 -M 4 --method larsen --costs mine.toml",
        "sweep -N 10 -M 4 --method larsen --costs mine.toml --results sweep.sqlite",
    ],
)
def test_each_command_that_uses_the_table_says_so(sched_sim: Run, tmp_path: Path, line: str) -> None:
    (tmp_path / "mine.toml").write_text(COSTS)
    assert NOTE in sched_sim(line).out
    (tmp_path / "mine.toml").write_text(COSTS.replace("busy", "idle"))
    (tmp_path / "sweep.sqlite").unlink(missing_ok=True)
    assert "busy machine" not in sched_sim(line).out


def test_where_there_is_no_table_standard_error_says_so(sched_sim: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("studies.measurement.job_times.load", lambda: Load(9.0, 2))
    line = "measure --states 1 --inputs 0 --measurements 1 --backend numpy --method standard"
    result = sched_sim(f"{line} --format json")
    assert "Note: numpy-1-0-1 was measured on a busy machine: " in result.err
    assert "load average 9.0 on 2 processors before it" in result.err
    assert {row["measured_on_busy_machine"] for row in json.loads(result.out)} == {True}
    assert "measured on a busy machine: " in sched_sim(line).out
    counted = line.replace("numpy", "counted")
    result = sched_sim(f"{counted} --format json")
    assert "busy" not in result.err
    assert {row["measured_on_busy_machine"] for row in json.loads(result.out)} == {None}
