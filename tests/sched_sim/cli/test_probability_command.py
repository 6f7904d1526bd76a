"""`sched-sim probability`: golden numbers as a user types them, what samples leave open, and what is refused."""

from __future__ import annotations

import csv
import io
import json
import re
from pathlib import Path

import pytest
from scipy.stats import poisson

from studies.probability import blocks
from tests.command_line import Run, is_refused

LATE_UPDATE = (
    "probability -N 10 -M 4 -L 8 --speed 78 --cost hr_propagate=63 --cost hr_restart=4 --cost hr_update=3 "
    "--cost lr_propagate=41 --cost lr_update=56:0.999999,61:1e-6"
)
FOR_EVER = (
    "probability -N 2 -M 0 -L 1 --speed 30 --cost hr_propagate=10 --cost hr_restart=10 --cost hr_update=1 "
    "--cost lr_propagate=4 --cost lr_update=16,17:1e-9"
)
HELD_UP = (
    "probability -N 4 -M 0 -L 1 --speed 30 --cost hr_propagate=10,31:1e-3 --cost hr_restart=10,31:1e-3 "
    "--cost hr_update=1 --cost lr_propagate=1 --cost lr_update=1"
)


def rows(out: str) -> dict[str, list[str]]:
    """Cells of the table, by what the probability is of."""
    found = [re.split(r"\s{2,}", line.strip()) for line in out.splitlines() if line.startswith(" ")]
    return {cells[0]: cells[1:] for cells in found}


# ------------------------------------------------------------------------------------------------ golden values
def test_an_update_that_takes_61_once_in_a_million_lands_a_step_later_once_in_a_million(sched_sim: Run) -> None:
    out = sched_sim(LATE_UPDATE).out
    assert out.startswith(
        "No HR deadline can be missed; a correction lands after L = 8 with probability 1e-6 per measurement."
    )
    table = rows(out)
    assert table["probability of"] == ["per", "first 1,000 cycles, mean", "cycle 1,000", "long run"]
    assert table["lands at L = 8"] == ["measurement", "0.999999", "0.999999", "0.999999"]
    assert table["lands at L = 9"] == ["measurement", "1e-6", "1e-6", "1e-6"]
    assert "hr_update 3 standard steps, lr_propagate 41 standard steps, lr_update 56 to 61 standard steps" in out
    document = json.loads(sched_sim(f"{LATE_UPDATE} --cycles 5 --format json").out)
    assert document["exact"]
    assert document["probabilities"]["lands at L = 9"]["long_run"]["most"] == pytest.approx(1e-6, rel=1e-12)


def test_what_mends_a_long_run_that_is_not_followed_is_had_on_the_command_line(sched_sim: Run) -> None:
    out = sched_sim("probability -N 2 -M 0 --speed 10 --cost hr_propagate=2 --cost hr_restart=2 --cost hr_update=1 "
        "--cost lr_propagate=1 --cost lr_update=1,300:0.01 --cycles 2").out  # fmt: skip
    assert "and that is not followed: give a faster processor, more --bins" in out
    assert set(re.findall("--[a-z]+", out)) <= set(re.findall("--[a-z]+", sched_sim("probability --help").out))


def test_one_late_execution_makes_every_later_cycle_late_and_both_answers_are_given(sched_sim: Run) -> None:
    out = sched_sim(FOR_EVER).out
    assert "lands after L = 1 with probability 5e-7 per measurement in the first 1,000 cycles, with 1 in the" in out
    assert rows(out)["lands at L = 2"] == ["measurement", "5e-7", "1e-6", "1"]
    document = json.loads(sched_sim(f"{FOR_EVER} --cycles 100 --format json").out)
    assert "Response times in the long run, in HR periods, exceeded with a probability of at most" in out
    late = document["probabilities"]["lands at L = 2"]
    assert late["last"]["most"] == pytest.approx(1 - (1 - 1e-9) ** 100, rel=1e-9)
    assert late["first"]["most"] == pytest.approx(1e-9 * 101 / 2, rel=1e-6)


def test_hr_jobs_that_miss_once_in_a_thousand(sched_sim: Run) -> None:
    out = sched_sim(HELD_UP).out
    assert out.startswith("An HR deadline is missed with probability 0.001 per step;")
    table = rows(out)
    assert table["hr missed"] == ["job", "0.001", "0.001", "0.001"]
    assert [table[f"lands at L = {L}"][-1] for L in (1, 2, 3)] == ["0.999", "9.99e-4", "9.99e-7"]
    assert "One HR deadline or more missed in the first 1,000 cycles: at most 1" in out
    listed = list(csv.DictReader(io.StringIO(sched_sim(f"{HELD_UP} --format csv").out)))
    (missed,) = [row for row in listed if row["probability_of"] == "hr missed"]
    assert float(missed["long_run_most"]) == pytest.approx(1e-3)
    assert (missed["N"], missed["per"], missed["first_impossible"]) == ("4", "job", "False")


def test_a_run_of_worst_cases_is_no_proof_and_a_range_of_costs_is_the_check(sched_sim: Run, tmp_path: Path) -> None:
    tasks = tmp_path / "tasks.toml"
    tasks.write_text('[[task]]\nname = "control"\nperiod = 4\ncost = 25\npriority = 5\noffset = 2\n')
    design = f"probability -N 4 -M 0 -L 4 --speed 80 --cycles 5 --tasks {tasks} --cost hr_propagate=50 "
    design += "--cost hr_restart=50 --cost hr_update=20 --cost lr_propagate=10"
    assert sched_sim(f"{design} --cost lr_update=54").out.startswith("No HR deadline can be missed;")
    out = sched_sim(f"{design} --cost lr_update=1..54").out
    assert out.startswith("An HR deadline is missed with probability 0.139 per step;")
    assert sched_sim(f"{design} --cost lr_update=1..20").out.startswith("No HR deadline can be missed;")


# ----------------------------------------------------------------------------------------------------- samples
def measured(folder: Path, samples: list[float], more: str = "") -> Path:
    path = folder / "samples.toml"
    path.write_text(f'unit = "us"\n[distribution.update]\nsamples = {samples}\n{more}')
    return path


def costs(folder: Path) -> Path:
    path = folder / "mine.toml"
    path.write_text('name = "mine"\nunit = "us"\n[costs.recalculate]\npropagate = 1\nupdate = 1\nreplay = 1\n')
    return path


@pytest.fixture
def sampled(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """HR jobs of m take 3 us and the update, of a period of 10 us: no sample is late."""
    monkeypatch.setattr(blocks, "MOST_STEPS", 4000)
    path = measured(tmp_path, [2.0, 5.0, 3.0, 4.0] * 25)
    design = "probability -N 10 -M 2 --method recalculate --cycles 5 --hr-hz 100000"
    return f"{design} --costs {costs(tmp_path)} --distributions {path}"


def test_a_sample_resolves_no_less_than_3_in_n_and_never_says_0(sched_sim: Run, sampled: str) -> None:
    out = " ".join(sched_sim(sampled).out.split())
    assert "How often an HR deadline is missed is not resolved below 0.03 per step" in out
    assert "largest of n = 100 is 5 us; slower ones may occur with probability up to 0.03 (95 %, if independent)" in out
    assert "No upper bound: it needs --worst COST" in out
    assert "Always the same, by mine: propagate 1 us, replay 1 us" in out
    document = json.loads(sched_sim(f"{sampled} --format json").out)
    assert document["probabilities"]["hr missed"]["long_run"] == {
        "least": None,
        "most": pytest.approx(0.02996, abs=1e-5),
        "impossible": False,
    }
    assert document["responses_periods"]["hr"]["1e-09"] is None


def test_a_worst_case_gives_an_upper_bound(sched_sim: Run, sampled: str) -> None:
    out = " ".join(sched_sim(f"{sampled} --worst 60us").out.split())
    assert "An HR deadline is missed with probability at most 0.0" in out
    assert "with all that samples have not seen at your worst case" in out
    assert "update 60 us" in out
    missed = json.loads(sched_sim(f"{sampled} --worst 60us --format json").out)["probabilities"]["hr missed"]
    assert 0.003 < missed["with_unseen_most"] < 0.03
    assert missed["with_unseen_impossible"] is False
    beyond_doubt = json.loads(sched_sim(f"{sampled} --worst update=7us --format json").out)["probabilities"]
    assert beyond_doubt["hr missed"]["with_unseen_impossible"] is True  # 3 + 7 us are no more than the period


def test_a_bound_of_what_was_seen_does_not_cover_how_often_it_was(sched_sim: Run, tmp_path: Path, sampled: str) -> None:
    measured(tmp_path, [2.0, 5.0, 3.0, 8.0] * 25)
    out = " ".join(sched_sim(f"{sampled} --worst 60us").out.split())
    assert "not seen (95 %) at your worst case, and what they have seen as often as in them" in out
    for times, often in ((1, 5.6), (10, 1.9), (100, 1.3)):
        assert poisson.cdf(times, times * often) < 0.025 < poisson.cdf(times, times * (often - 0.1))
    assert "once may come 5.6 times as often, what was ten times 1.9 times, a hundred times 1.3 times (95 %)" in out


def test_samples_in_a_row_make_independence_doubtful(sched_sim: Run, tmp_path: Path, sampled: str) -> None:
    measured(tmp_path, [2.0] * 40 + [5.0] * 40)
    out = " ".join(sched_sim(sampled).out.split())
    assert "independent, which is doubtful: rank autocorrelation 0.97" in out
    assert "Rank autocorrelation 0.97 (update, n = 80): independence doubtful" in out
    assert "in blocks of 8 of update: HR deadlines missed none of 4,010 (95 %: at most 9.6e-4)" in out
    assert "the interval covers the noise of this simulation only" in out


# --------------------------------------------------------------------------------------------- delays and bounds
def test_a_random_delay_and_losses(sched_sim: Run) -> None:
    common = "probability -N 8 --method recalculate --speed 10 --cost propagate=1 --cost update=2 --cost replay=2"
    document = json.loads(sched_sim(f"{common} --delays 2:0.75,4 --dropout 0.1 --cycles 3 --format json").out)
    assert document["lost"] == pytest.approx(0.1)
    shares = {what: found["last"]["most"] for what, found in document["probabilities"].items()}
    assert shares["lands at L = 2"] == pytest.approx(0.9 * 0.75)
    assert shares["hr missed"] == pytest.approx(0.9 * 0.25 / 8)
    in_ms = f"{common} --delays 15ms:0.75,40ms --dropout 1/10 --hr-hz 100 --cycles 3 --format json"
    assert json.loads(sched_sim(in_ms).out)["probabilities"] == document["probabilities"]


def test_bins_give_bounds(sched_sim: Run) -> None:
    document = json.loads(sched_sim(f"{LATE_UPDATE} --bins 100 --cycles 3 --format json").out)
    assert not document["exact"]
    late = document["probabilities"]["lands after L = 8"]["long_run"]
    assert (late["least"] or 0) <= 1e-6 <= late["most"] < 1
    out = sched_sim(f"{LATE_UPDATE} --bins 100 --cycles 3").out
    assert "costs are rounded to 100 parts of an HR period, down and up" in out


def test_the_last_landings_are_one_of_no_more_than_what_is_left(sched_sim: Run) -> None:
    delays = ",".join(f"{steps}:0.05" for steps in range(11)) + ",13:0.09,17"
    design = f"probability -N 20 --method recalculate --delays {delays} --speed 0.8 --cycles 4 --bins 16"
    out = sched_sim(f"{design} --cost propagate=0.01 --cost update=0.45 --cost replay=0.02").out
    table = rows(out)
    assert all("impossible" not in cells for what, cells in table.items() if what.startswith("lands at"))
    last = next(cells for what, cells in reversed(table.items()) if what.startswith("lands after"))
    assert last[-1] == "at most 0.65"  # at least 0.35 land before, and bounds of single landings sum to more


def test_what_is_not_followed_may_land_where_no_row_is(sched_sim: Run) -> None:
    coarse = " ".join(sched_sim(f"{LATE_UPDATE} --bins 1 --cycles 20").out.split())
    assert "Further behind than is followed with a probability of at most 1: that is in every upper bound" in coarse
    assert "Further behind" not in sched_sim(f"{LATE_UPDATE} --cycles 20").out


def test_the_tails_are_drawn(sched_sim: Run, tmp_path: Path) -> None:
    picture = tmp_path / "tails.svg"
    assert sched_sim(f"{HELD_UP} --cycles 3 --histogram {picture}").code == 0
    assert picture.read_text().startswith("<?xml")


# ----------------------------------------------------------------------------------------------------- bad input
BAD: dict[str, tuple[str, list[str]]] = {
    "sum": ("--cost lr_update=56:0.99,61:1e-6", ["--cost lr_update=56:0.99,61:1e-6", "sum to 0.990001"]),
    "negative": ("--cost lr_update=56:1.1,61:-0.1", ["the probability -0.1 is negative"]),
    "kind": ("--cost lr_updates=5", ["dual-rate has no such kind of job", "did you mean lr_update?", "hr_restart"]),
    "no kind": ("--cost 5", ["give KIND=VALUE:PROBABILITY"]),
    "twice": ("--cost lr_update=5 --cost lr_update=6", ["lr_update is given twice"]),
    "number": ("--cost lr_update=fast", ["--cost lr_update=fast", "is no cost"]),
    "unit": ("--cost lr_update=5us", ["5us is a time, and costs are in units of standard step"]),
    "other option": ("--cost lr_gain=5", ["lr_gain does not run with these options", "lr_update", "--gain"]),
    "worst": ("--worst 60", ["no kind of job has samples"]),
    "worst of one": ("--cost lr_update=5 --worst lr_update=60", ["lr_update has no samples"]),
    "delays": ("--delays 4:0.5,6:0.6", ["exclude each other"]),
    "dropout": ("--dropout 1.5", ["--dropout 1.5 must be from 0 to less than 1"]),
    "policy": ("--policy edf", ["--policy edf: the exact probability is had for fixed priorities only"]),
    "method": ("--method augmentation --costs counted-9-3-3", ["differences of costs"]),
    "range": ("--cost lr_update=9..5", ["give a range such as 1..54"]),
    "no table": ("--method carried-gain", ["no entry", "carried-gain"]),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_input_is_one_message(sched_sim: Run, case: str) -> None:
    flags, said = BAD[case]
    is_refused(sched_sim(f"probability -N 10 -M 4 --speed 0.78 {flags}"), said)


def test_a_worst_case_below_a_sample_is_refused(sched_sim: Run, sampled: str) -> None:
    said = ["--worst 4us", "in us: the worst case 4 is below 5, which was measured"]
    is_refused(sched_sim(f"{sampled} --worst 4us"), said)


def test_delays_that_are_none_are_refused(sched_sim: Run) -> None:
    for flags, said in (
        ("--delays 4:0.5,6:0.6", "sum to 1.1, 0.1 too much"),
        ("--delays 4.5", "no whole number of HR steps"),
        ("--delays 40ms", "40ms without --hr-hz"),
        ("--delays -1", "-1 is negative"),
        ("--delays 2,3:0.1 --method standard", "had for recalculate, larsen, carried-gain, clone and dual-rate"),
    ):
        is_refused(sched_sim(f"probability -N 10 --speed 0.78 {flags}"), [said])


def test_the_speed_is_asked_for(sched_sim: Run) -> None:
    is_refused(sched_sim("probability -N 10 -M 4"), ["--speed is missing"])
