"""When a correction lands, from when its measurement is taken: the same of a design and of a scenario."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from sched_sim.scenario.run import run_scenario
from sched_sim.scenario.scenario_file import read_scenario
from tests.command_line import Run

COUNTS = """\
name = "counts"
unit = "operation"
[operations]
predict = { multiply = 900, add = 800 }
[operations.correct]
camera = { multiply = 900, add = 800 }
"""
DESIGN = "--hr-hz 400 --measurement-hz {} --delay-ms 20 --method larsen"
HERE = "--processor cortex-m7 --format json"


@pytest.mark.parametrize("hz", ["5", "30", "29.97", "7"])
def test_a_design_and_a_scenario_land_after_the_same_time(sched_sim: Run, tmp_path: Path, hz: str) -> None:
    """In the eighth step; at 30 Hz one of three measurements is taken two thirds of a step before its own."""
    (tmp_path / "counts.toml").write_text(COUNTS)
    (tmp_path / "s.toml").write_text(
        'name = "s"\nhr_hz = 400\nduration_s = 40\ncosts = "counts.toml"\n'
        f'[[sensor]]\nname = "camera"\nhz = {hz}\ndelay_ms = 20\n'
    )
    design = DESIGN.format(hz)
    (row,) = json.loads(sched_sim(f"minimum {design} {HERE}").out)
    (same,) = json.loads(sched_sim(f"processors {design} {HERE}").out)
    schedule = json.loads(sched_sim(f"simulate {design} {HERE}").out)
    (found,) = json.loads(sched_sim(f"processors --scenario s.toml {HERE}").out)
    longest = run_scenario(read_scenario("s.toml", processor="cortex-m7")).sensors["camera"].longest
    assert longest is not None
    assert row["achieved_l"] == found["latest_l"]["camera"] == 8
    ms = float(longest * 1000 / 400)
    assert row["correction_ms"] == same["correction_ms"] == found["correction_ms"]["camera"] == ms
    assert schedule["correction_ms"] == [ms] * 3
    assert ms == pytest.approx({"5": 20, "30": 20 + 5 / 3}.get(hz, ms))


def test_nothing_lands_later_than_it_was_asked_for(sched_sim: Run) -> None:
    """22.5 ms are nine steps from step k, and 24.17 ms from when the measurement of one that waits is taken."""
    design = DESIGN.format(30).replace("larsen", "dual-rate")
    for within, L in (("24.2", 9), ("26.6", 9), ("26.7", 10)):
        (row,) = json.loads(sched_sim(f"minimum {design} --land-within-ms {within} {HERE}").out)
        assert row["L"] == L
        assert row["correction_ms"] <= float(within)
    assert "L = 9 steps, the last one by then: 24.1667 ms" in sched_sim(f"minimum {design} --land-within-ms 26.6").out


def test_a_design_in_steps_lands_in_steps(sched_sim: Run) -> None:
    (row,) = json.loads(sched_sim(f"minimum -N 13 -M 8 --hr-hz 400 --method larsen {HERE}").out)
    assert row["correction_ms"] == 20
    assert "after the measurement" not in sched_sim("simulate -N 13 -M 8 --hr-hz 400").out


def test_a_step_and_a_rate_that_are_mixed_keep_what_was_asked(sched_sim: Run) -> None:
    """-L 9 is of step k: at the rate that was given it stays 9, and the rate fits."""
    line = f"minimum --hr-hz 400 --measurement-hz 30 --delay-ms 20 -L 9 --method dual-rate {HERE}"
    (row,) = json.loads(sched_sim(line).out)
    assert row["fits"] is True
    assert row["highest_hr_hz"] >= 400


def test_the_output_says_from_when(sched_sim: Run) -> None:
    out = sched_sim(f"simulate {DESIGN.format(30)} --processor cortex-m7").out
    assert "l = k + 8, 20 ms after k, at most 21.6667 ms after the measurement was taken;" in out
    assert "each is taken up to 1.66667 ms before its step k, and landings in ms are from then" in out
