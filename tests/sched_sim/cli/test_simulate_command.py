"""What `sched-sim simulate` prints for people and for scripts."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import pytest

from tests.command_line import Run


def test_simulate_prints_one_json_object(sched_sim: Run) -> None:
    line = "simulate --method dual-rate -N 10 -M 4 --speed 0.78 --cycles 3 --costs steffes2014 --format json"
    document = json.loads(sched_sim(line).out)
    assert document["achieved_l"] == [8, 8, 8]
    assert document["misses"] == 0
    assert document["utilization"] == pytest.approx((9 * 0.63 + 0.04 + 0.03 + 0.41 + 0.56) / 7.8)
    assert document["preemptions"] == 12
    assert set(document["response"]) == {"hr", "lr_propagate", "lr_update"}
    assert document["response"]["lr_propagate"]["max_periods"] == pytest.approx(0.45 / 0.78)
    assert document["response"]["lr_update"]["mean_periods"] == pytest.approx(
        (3 * 0.78 + 0.63 + 0.56 - 3 * 0.15) / 0.78
    )


def test_what_simulate_prints_for_scripts_says_of_what_it_is_and_in_which_unit(sched_sim: Run) -> None:
    line = "simulate -N 10 -M 4 -L 8 --speed 0.78 --hr-hz 400"
    document = json.loads(sched_sim(f"{line} --format json").out)
    about = {"method": "dual-rate", "N": 10, "M": 4, "L": 8, "speed": 0.78, "speed_exact": "39/50"}
    about |= {"cost_unit": "standard step", "hr_hz": 400.0}
    assert {key: document[key] for key in about} == about
    assert document["correction_ms"] == [20.0, 20.0, 20.0]
    update = document["response"]["lr_update"]
    for name in ("max", "mean", "worst_lateness"):
        assert update[f"{name}_ms"] == pytest.approx(2.5 * update[f"{name}_periods"])
    row = list(csv.DictReader(io.StringIO(sched_sim(f"{line} --format csv").out)))[-1]
    about |= {"measured_on_busy_machine": ""}
    assert row == {key: str(value) for key, value in {**about, "kind": "lr_update", **update}.items()}


def test_on_a_processor_the_speed_is_in_seconds_and_the_processor_is_named(sched_sim: Run) -> None:
    document = json.loads(sched_sim("simulate -N 10 -M 4 --processor leon3 --hr-hz 400 --format json").out)
    about = {"speed": 0.0025, "speed_exact": "1/400", "cost_unit": "second", "processor": "leon3", "hr_hz": 400.0}
    assert {key: document[key] for key in about} == about


def test_without_a_rate_nothing_is_in_ms(sched_sim: Run) -> None:
    assert "_ms" not in sched_sim("simulate -N 10 -M 4 --format json").out
    assert "ms" not in sched_sim("simulate -N 10 -M 4").out


def test_with_a_rate_the_table_of_simulate_is_in_ms(sched_sim: Run) -> None:
    out = sched_sim("simulate -N 10 -M 4 -L 8 --speed 0.77 --hr-hz 400").out
    assert "response times in ms" in out
    assert "Corrections land at l = k + 8, 20 ms after k;" in out
    (update,) = [row.split() for row in out.splitlines() if row.startswith(" lr_update")]
    assert update == ["lr_update", "3", "10", "10", "0", "0", "9"]


def test_pictures_and_traces_are_written(sched_sim: Run, tmp_path: Path) -> None:
    result = sched_sim("simulate -N 10 -M 4 --speed 0.7 --gantt a.svg --trace a.json --trace a.csv")
    assert result.code == 0
    assert "land at l = k + 12, 1 of 3 not within" in result.out
    assert sched_sim("gantt -N 10 -M 4 -L 8 -o fig.pdf").code == 0
    assert {path.name for path in tmp_path.iterdir()} == {"a.svg", "a.json", "a.csv", "fig.pdf"}


def test_nothing_is_late_to_the_standard_filter(sched_sim: Run) -> None:
    for line in ("minimum -N 10 -M 4 {}", "simulate -N 10 -M 4 --method standard {}"):
        for more in ("", "-L 8"):
            found = json.loads(sched_sim(f"{line.format(more)} --format json").out)
            row = found[0] if isinstance(found, list) else found
            assert (row["method"], row["N"], row["M"], row["L"]) == ("standard", 10, 0, 0)
    line = "processors --hr-hz 400 --measurement-hz 5 --delay-ms 110 --method standard --format csv"
    rows = list(csv.DictReader(io.StringIO(sched_sim(line).out)))
    assert {(row["N"], row["M"], row["L"]) for row in rows} == {("80", "0", "0")}


def test_where_there_are_no_tasks_none_are_spoken_of(sched_sim: Run) -> None:
    line = "simulate -N 5 -M 3 -L 5 --speed 1.34 --context-switch 0.16 --policy edf --cycles 1"
    assert sched_sim(line).err == "Note: 1 cycle is shown; all is seen after 2: --cycles 2\n"
