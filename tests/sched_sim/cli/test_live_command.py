"""`sched-sim live`: what it says of recorded runs, one real one, and what it refuses."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from studies.live.alone import alone_on
from studies.live.design import Design
from studies.live.jobs import Ran
from studies.live.probe import Resolution
from tests.command_line import Run, is_refused
from tests.studies.live.machine import needs_real_time
from tests.studies.live.recorded import perfect, recorded

RECORDED = "live --speed 0.85 --cycles 8 --cpu 0"


class Recorder:
    """In place of a program: what one printed once."""

    def run(self, _design: Design, _cpu: int, *, swapped: bool = False, once: bool = False) -> Ran:
        assert not once
        return recorded("swapped" if swapped else "ordinary")


@pytest.fixture
def replayed(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Any machine can run it."""

    @contextmanager
    def compiled(_wanted: object) -> Iterator[Recorder]:
        yield Recorder()

    monkeypatch.setattr("studies.live.rights.check_rights", lambda: None)
    monkeypatch.setattr("studies.live.rights.chosen_core", lambda cpu: cpu)
    monkeypatch.setattr("studies.live.alone.CORES", tmp_path)
    monkeypatch.setattr("studies.live.program.compiled", compiled)
    monkeypatch.setattr("studies.live.probe.resolution", lambda *_: Resolution(12_000.0, {"hr_update": 1_000.0}))


@pytest.mark.usefixtures("replayed")
def test_a_run_that_agrees(sched_sim: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Recorder, "run", lambda _self, design, _cpu, **_: Ran(tuple(perfect(design)), 0))
    result = sched_sim("live --speed 0.85 --cycles 299 --cpu 0")
    assert result.code == 0
    assert "agrees: 299 of 299 undisturbed cycles (100.0%) landed as predicted, at l = k + 7; of all 299" in result.out


@pytest.mark.usefixtures("replayed")
def test_a_run_of_too_few_cycles(sched_sim: Run) -> None:
    """All of them landed as predicted, which is no verdict."""
    result = sched_sim(RECORDED)
    assert result.code == 3
    assert "two SCHED_FIFO threads on CPU 0, HR above LR, HR period 10 ms, 8 cycles, speed 0.85" in result.out
    assert (
        "inconclusive: 8 of 8 undisturbed cycles (100.0%) landed as predicted, at l = k + 7; of all 8 cycles 8 (100.0%)"
        in result.out
    )
    assert "too few to say with 95 % confidence whether at least 99 % do" in result.out
    assert "with 0 elsewhere 299 undisturbed cycles would do" in result.out
    assert "wake-up latency of HR, us: median" in result.out
    assert "took more than 2 % of the speed make up from m to l, 588 us, while a job was ready" in result.out
    assert "states: to the bit those of one thread" in result.out


@pytest.mark.usefixtures("replayed")
def test_swapped_priorities_disagree(sched_sim: Run) -> None:
    result = sched_sim(f"{RECORDED} --swap-priorities --gantt swapped.svg")
    assert result.code == 1
    assert "LR above HR" in result.out
    assert (
        "disagrees: 0 of 8 undisturbed cycles (0.0%) landed as predicted, at l = k + 7; of all 8 cycles 0" in result.out
    )
    assert "jobs miss their deadline" in Path("swapped.svg").read_text(encoding="utf-8")


@pytest.mark.usefixtures("replayed")
def test_too_little_undisturbed_is_inconclusive(sched_sim: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("studies.live.measure.disturbed", lambda taken, *_: [cycle < 2 for cycle in range(len(taken))])
    result = sched_sim(RECORDED)
    assert result.code == 3
    assert "inconclusive: 6 of 6 undisturbed" in result.out
    assert "only 6 of 8 cycles were undisturbed, and 80 % must be" in result.out
    assert "of all 8 cycles 8 (100.0%)" in result.out
    assert json.loads(sched_sim(f"{RECORDED} --format json").out)["verdict"] == "inconclusive"


@pytest.mark.usefixtures("replayed")
def test_json_and_csv_have_every_cycle(sched_sim: Run) -> None:
    document = json.loads(sched_sim(f"{RECORDED} --format json").out)
    assert document["achieved_l"] == [7] * 8
    assert document["share_undisturbed"] == document["share"] == 1
    assert document["wake_us"]["median"] < document["wake_us"]["worst"]
    rows = list(csv.DictReader(io.StringIO(sched_sim(f"{RECORDED} --format csv").out)))
    assert [(row["cycle"], row["achieved_l"], row["agrees"]) for row in rows][-1] == ("8", "7", "True")
    assert [float(row["taken_us"]) for row in rows] == document["taken_us"]


@pytest.mark.usefixtures("replayed")
def test_the_trace_has_what_ran_beside_what_was_simulated(sched_sim: Run) -> None:
    assert sched_sim(f"{RECORDED} --trace both.json --histogram h.svg").code == 3
    events = json.loads(Path("both.json").read_text())["traceEvents"]
    names = {event["pid"]: event["args"]["name"] for event in events if event["name"] == "process_name"}
    assert names == {1: "simulated", 2: "measured"}
    work = {
        pid: sum(event["dur"] for event in events if event["pid"] == pid and event["name"] == "LRU") for pid in names
    }
    assert work[2] == pytest.approx(work[1], rel=0.01)
    assert "more disturbs a cycle" in Path("h.svg").read_text(encoding="utf-8")


@pytest.mark.usefixtures("replayed")
def test_the_staircase_is_of_twelve_speeds(sched_sim: Run) -> None:
    """The recorded run lands at l = k + 7 whatever the speed is said to be."""
    result = sched_sim(f"{RECORDED} --staircase s.svg --format json")
    document = json.loads(result.out)
    assert [row["predicted_l"] for row in document["speeds"]] == [8] * 3 + [7] * 6 + [6] * 3
    assert [row["share"] for row in document["speeds"]] == [0] * 3 + [1] * 6 + [0] * 3
    assert (result.code, document["verdict"]) == (1, "disagrees")
    assert "as predicted, of all cycles" in Path("s.svg").read_text(encoding="utf-8")
    table = sched_sim(f"{RECORDED} --staircase s.svg").out
    assert "disagrees, by the speeds 2 % or more from a step: " in table
    assert "landed as predicted at these 7 together; by its own cycles 1 disagrees" in table
    assert len(list(csv.DictReader(io.StringIO(sched_sim(f"{RECORDED} --staircase s.svg --format csv").out)))) == 12


@pytest.mark.usefixtures("replayed")
@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("live --speed 0.7", ["--speed 0.7", "95.86 % of the core", "95 %", "give at least 0.7234"]),
        ("live --speed 0.72", ["--speed 0.72", "after the next measurement", "0.7234"]),
        ("live --speed 0.85 --period-ms 0.0001", ["--period-ms 0.0001 is too short", "the clock ticks every"]),
        ("live --speed 0.85 --period-ms 1", ["--period-ms 1 is too short", "wake-up here takes 12 us", "at least 2.1"]),
        ("live --speed 0.85 --period-ms 0", ["--period-ms"]),
        ("live --speed 0.85 --cycles 0", ["--cycles", "at least 1"]),
        ("live --speed 0.85 --cycles 100000", ["--cycles 100000", "at most 3600 s"]),
        ("live --speed 0.85 -M 10", ["-M 10 must be from 0 to 9: live runs", "code writes others"]),
        ("live --speed 0.85 -N 1", ["-N 1 must be at least 2"]),
        ("live --speed 0.85 --states 300", ["--states", "300"]),
        ("live --speed 0.85 --staircase a.svg --gantt b.svg", ["--staircase a.svg: leave out --gantt"]),
        ("live --speed 0.85 --gantt a.svg --histogram a.svg", ["--gantt a.svg and --histogram a.svg are one file"]),
        ("live --speed 0.85 --gantt a.txt", ["--gantt 'a.txt'", ".svg"]),
        ("live --speed 0.85 --trace a.txt", ["--trace 'a.txt'", ".json"]),
        ("live --speed 0.85 --costs rad750", ["rad750"]),
        ("live", ["--speed"]),
    ],
)
def test_refusals_name_the_option_and_the_remedy(line: str, said: list[str], sched_sim: Run) -> None:
    is_refused(sched_sim(line), said)
    assert list(Path().iterdir()) == []


@pytest.mark.usefixtures("replayed")
@pytest.mark.skipif(not hasattr(os, "SCHED_FIFO"), reason="live needs Linux")
def test_two_runs_on_one_core_are_refused(
    sched_sim: Run, monkeypatch: pytest.MonkeyPatch, tmp_path_factory: pytest.TempPathFactory
) -> None:
    cores = tmp_path_factory.mktemp("cores")
    (cores / "cpu0").mkdir()
    monkeypatch.setattr("studies.live.alone.CORES", cores)
    with alone_on(0):
        is_refused(sched_sim(RECORDED), ["--cpu 0: another live run has this core", "give another, or wait"])
    assert sched_sim(RECORDED).code == 3


@pytest.mark.skipif(not hasattr(os, "SCHED_FIFO"), reason="live needs Linux")
def test_without_the_right_to_real_time_priorities(sched_sim: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(*_: object) -> None:
        raise PermissionError(1, "Operation not permitted")

    monkeypatch.setattr(os, "sched_setscheduler", refused)
    said = ["real-time priorities", "Operation not permitted", "root", "CAP_SYS_NICE", "ulimit -r 20"]
    is_refused(sched_sim("live --speed 0.85"), said)


def test_elsewhere_than_on_linux(sched_sim: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(os, "sched_setscheduler", raising=False)
    is_refused(sched_sim("live --speed 0.85"), ["live needs Linux"])


@needs_real_time
def test_a_core_that_is_not_there(sched_sim: Run) -> None:
    is_refused(sched_sim("live --speed 0.85 --cpu 4000"), ["--cpu 4000 is no core that this process may use"])


@needs_real_time
def test_it_runs(sched_sim: Run) -> None:
    """The word may be any, or the period refused, for the machine may be busy; the exit code is the word's."""
    result = sched_sim("live --speed 0.85 --cycles 6 --states 3 --inputs 1 --measurements 1 --format json")
    if result.code == 2:
        assert "--period-ms 10 is too short" in result.err or "another live run has this core" in result.err
        return
    document = json.loads(result.out)
    assert result.code == {"agrees": 0, "disagrees": 1, "inconclusive": 3}[document["verdict"]]
    assert len(document["achieved_l"]) == 6
    assert document["differing_states"] == 0
    assert document["verdict"] != "agrees"  # of six
