"""`sched-sim accuracy` and `design` where the rate of measurements does not divide that of the loop, against a scenario
with the same sensor; and what they refuse to give figures of."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from tests.command_line import Run, is_refused


@pytest.fixture(autouse=True)
def own_models(tmp_path: Path) -> None:
    shutil.copy(Path(__file__).parent / "mine.py", tmp_path)


def scenario(path: Path, hr_hz: int, every: str, delay: int) -> None:
    path.write_text(
        f'name = "one sensor"\nhr_hz = {hr_hz}\nsteps = 2000\n[predictor]\ncost_us = 1\n[[sensor]]\nname = "one"\n'
        f'every = "{every}"\ndelay = {delay}\ncost_us = 1\n'
    )


@pytest.mark.parametrize(
    ("model", "hr_hz", "hz", "every", "M", "worst"),
    [
        ("camera", 100, 30, "10/3", 3, 0.019867),
        ("camera", 200, 30, "20/3", 6, 0.020160),
        ("ins-gps", 8, 5, "8/5", 1, 0.364828),
        ("ins-gps", 12, 5, "12/5", 2, 0.374716),
        ("ins-gps", 400, 7, "400/7", 44, 0.323723),
    ],
)
def test_the_figures_are_those_of_the_scenario(
    sched_sim: Run, tmp_path: Path, model: str, hr_hz: int, hz: int, every: str, M: int, worst: float
) -> None:
    scenario(tmp_path / "s.toml", hr_hz, every, M)
    simulated = json.loads(sched_sim(f"simulate --scenario s.toml --model {model} --format json").out)["accuracy"]
    asked = f"--model {model} --hr-hz {hr_hz} --measurement-hz {hz} -M {M}"
    (row,) = json.loads(sched_sim(f"accuracy {asked} --method recalculate --format json").out)
    assert row["verdict"] == "exact"
    assert row["worst_std"] == pytest.approx(simulated["worst_std"], rel=3e-5)
    assert row["worst_std"] == pytest.approx(worst, rel=3e-5)
    assert row["oldest_age_ms"] == pytest.approx(simulated["ages"]["one"]["age_worst_ms"])
    is_refused(sched_sim(f"design {asked} --method recalculate --within {0.999 * worst:.6g}"), ["no method reaches it"])


def test_ages_in_time_are_from_when_a_measurement_is_taken(sched_sim: Run) -> None:
    """Of measurements 10 / 3 steps apart one is taken 2 / 3 of a step before its own, and the next lands 3 later."""
    asked = "--model camera --hr-hz 100 --measurement-hz 30 --delay-ms 30"
    (row,) = json.loads(sched_sim(f"accuracy {asked} --method clone --format json").out)
    assert (row["oldest_age_ms"], row["reaction_ms"]) == (60.0, pytest.approx(36.6667, abs=1e-4))
    assert row["mean_age_ms"] == pytest.approx(45.0)


def test_rates_whose_pattern_is_long_are_bounded_and_said_to_be(sched_sim: Run) -> None:
    said = sched_sim("accuracy --model ins-gps --measurement-hz 29.9701 --method clone")
    assert "bound: the figures are no less than the true ones" in " ".join(said.out.split())
    refused = sched_sim("accuracy --model ins-gps --measurement-hz 8.9701 --method px4-predictor")
    is_refused(refused, ["--hr-hz 400", "repeat after 89,701", "give --hr-hz 403.6545"])
    given = sched_sim("accuracy --model ins-gps --hr-hz 403.6545 --measurement-hz 8.9701 --method px4-predictor")
    assert given.code == 0


@pytest.mark.parametrize("N", [10, 20])
def test_a_mode_that_goes_unseen_has_no_figure_anywhere(sched_sim: Run, N: int) -> None:
    of = f"--model mine:turning -M 4 --output 0 -N {N}"
    unseen = ["-N", "a mode of state 1 that does not decay goes unseen", "take another N"]
    is_refused(sched_sim(f"accuracy {of}"), unseen)
    is_refused(sched_sim(f"design {of} --within 1"), unseen)
    is_refused(
        sched_sim(f"sweep -N 9,{N} -M 4 --model mine:turning --output 0 --speed 50000 --method larsen"), unseen[1:]
    )


def test_with_every_third_measurement_it_is_that_row_that_has_none(sched_sim: Run) -> None:
    said = sched_sim("accuracy --model mine:turning -N 5 -M 4 --output 0 --every 1:3 --method clone --format json")
    assert [row["verdict"] for row in json.loads(said.out)] == ["exact", None, "exact"]


def test_a_landing_after_the_next_measurement_is_refused_as_minimum_does(sched_sim: Run) -> None:
    said = ["-L 100 is after the next measurement is taken, -N 80", "give -L 45 to 80"]
    is_refused(sched_sim("accuracy --model ins-gps -L 100 --method delayed-horizon"), said)
    assert sched_sim("accuracy --model ins-gps -L 80 --method delayed-horizon").code == 0
    assert sched_sim("accuracy --model ins-gps -L 100 --method dual-rate").code == 0


@pytest.mark.parametrize("tau", ["1e-6", "1e-4", "1e-3"])
def test_a_pull_that_is_too_strong_is_unstable(sched_sim: Run, tau: str) -> None:
    said = sched_sim(f"accuracy --model ins-gps --tau {tau} --method px4-predictor --format json")
    (row,) = json.loads(said.out)
    assert (row["verdict"], row["worst_std"]) == ("unstable", None)


@pytest.mark.parametrize(("states", "units"), [("0:9", "m, m/s, rad"), ("0,3", "m, m/s")])
def test_states_of_different_units_have_no_sum(sched_sim: Run, states: str, units: str) -> None:
    said = [f"--output {states} holds states in {units}, which have no standard deviation together"]
    is_refused(sched_sim(f"accuracy --model ins-gps --output {states}"), said)
