"""What `sched-sim minimum` prints for people and for scripts."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import pytest

from tests.command_line import Run, is_refused

DESIGN = "-N 10 -M 4 -L 8 --costs steffes2014"


def test_minimum_prints_a_json_array_of_methods(sched_sim: Run) -> None:
    rows = json.loads(sched_sim(f"minimum {DESIGN} --format json").out)
    assert [row["method"] for row in rows] == ["standard", "recalculate", "larsen", "dual-rate"]
    assert rows[-1] == {
        "method": "dual-rate",
        "N": 10,
        "M": 4,
        "L": 8,
        "min_speed": 0.77,
        "min_speed_exact": "77/100",
        "binding": "lr_update",
        "cost_unit": "standard step",
        "achieved_l_at_min_speed": 8,
        "min_speed_least": None,
        "min_speed_most": None,
        "measured_on_busy_machine": None,
    }


def test_minimum_lands_at_the_same_step_in_every_format(sched_sim: Run) -> None:
    line = "minimum -N 100 -M 10 -L 80 --method larsen --method dual-rate"
    assert [row["achieved_l_at_min_speed"] for row in json.loads(sched_sim(f"{line} --format json").out)] == [10, 29]
    table = [row.split() for row in sched_sim(line).out.splitlines()]
    assert [row[-1] for row in table if row and row[0] in ("larsen", "dual-rate")] == ["10", "29"]


def test_minimum_csv_has_the_same_rows(sched_sim: Run) -> None:
    expected = json.loads(sched_sim(f"minimum {DESIGN} --format json").out)
    rows = list(csv.DictReader(io.StringIO(sched_sim(f"minimum {DESIGN} --format csv").out)))
    assert [{key: "" if value is None else str(value) for key, value in row.items()} for row in expected] == rows


@pytest.mark.parametrize(
    ("options", "speed"),
    [
        ("--lr-propagate-by m", "26/25"),
        ("--lr-propagate-by l", "271/400"),
        ("--feedback same-step --lr-propagate-by l", "152/225"),  # (8 x 0.63 + 0.04 + 0.41 + 0.56 + 0.03) / 9
        ("--cpus 2", "26/25"),
        ("--cpus 2 --lr-propagate-by l", "33/50"),
        ("--context-switch 0.01", "53/50"),
    ],
)
def test_options_of_minimum(sched_sim: Run, options: str, speed: str) -> None:
    result = sched_sim(f"minimum -N 10 -M 1 -L 8 --method dual-rate --format json {options}")
    assert json.loads(result.out)[0]["min_speed_exact"] == speed


def test_a_precomputed_gain_needs_its_own_entries_and_less_power(sched_sim: Run) -> None:
    line = "minimum -N 10 -M 4 -L 5 --method dual-rate --costs counted-9-3-3 --format json"
    late, early = (json.loads(sched_sim(line + gain).out)[0] for gain in ("", " --gain precomputed"))
    assert early["min_speed"] < late["min_speed"]


def test_hr_hz_adds_absolute_times_and_rates(sched_sim: Run) -> None:
    row = json.loads(sched_sim(f"minimum {DESIGN} --method dual-rate --hr-hz 400 --format json").out)[0]
    assert row["correction_ms_at_min_speed"] == 20.0
    assert not {"achieved_l", "correction_ms"} & row.keys()
    assert row["work_per_second"] == pytest.approx(0.77 * 400)
    assert "lands after, ms" in sched_sim(f"minimum {DESIGN} --hr-hz 400").out


def test_l_defaults_to_the_latest_that_is_legal(sched_sim: Run) -> None:
    rows = json.loads(sched_sim("minimum -N 10 -M 4 --feedback same-step --format json").out)
    assert {row["method"]: row["L"] for row in rows}["dual-rate"] == 9


@pytest.mark.parametrize("option", ["--policy edf", "--context-switch 0.01"])
def test_what_has_no_closed_form_is_named_where_n_is_too_long(sched_sim: Run, option: str) -> None:
    is_refused(
        sched_sim(f"minimum -N 300000 -M 10 --method larsen {option}"),
        ["where context switches take time, or the earliest deadline", "leave out --context-switch and --policy"],
    )


def test_costs_in_milliseconds_give_a_share_of_the_processor(sched_sim: Run, tmp_path: Path) -> None:
    entries = "[costs.larsen]\npropagate = 0.21\npropagate_accumulate = 0.3\nupdate = 0.42\n"
    (tmp_path / "ms.toml").write_text('name = "m"\nunit = "ms"\n' + entries)
    line = "minimum -N 80 -M 40 --method larsen --costs ms.toml --hr-hz 400 --format json"
    row = json.loads(sched_sim(line).out)[0]
    assert row["needed_share"] == pytest.approx(0.72e-3 * 400)
    assert row["fits"] is True
    assert (row["min_speed"], row["cost_unit"]) == (0.72e-3, "second")
    assert row["highest_hr_hz"] == 1388  # of 1000 / 0.72 = 1388.9: a limit is rounded down


def test_costs_beyond_64_bits_stay_exact(sched_sim: Run, tmp_path: Path) -> None:
    entries = "[costs.larsen]\npropagate = 1e17\npropagate_accumulate = 1e-17\nupdate = 1\n"
    (tmp_path / "wide.toml").write_text('name = "w"\nunit = "u"\n' + entries)
    row = json.loads(sched_sim("minimum -N 8 -M 4 --method larsen --costs wide.toml --format json").out)[0]
    assert row["min_speed_exact"] == str(10**17)
