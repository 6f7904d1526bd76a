"""`sched-sim design`: the latest landing that keeps an accuracy, the part for it, and what it refuses."""

from __future__ import annotations

import csv
import io
import json
import shutil
from fractions import Fraction
from pathlib import Path
from time import process_time
from typing import Any

import pytest

from filters.accuracy.exact import lossless
from filters.accuracy.shipped import shipped_model
from sched_sim.costs.table_file import load_costs
from sched_sim.design.methods import select
from sched_sim.design.options import Options
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from sched_sim.processors.part import on_part
from sched_sim.processors.part_file import load_part
from tests.command_line import Run, is_refused

INS = "--model ins-gps --output position=0:3"


@pytest.fixture(autouse=True)
def own_models(tmp_path: Path) -> None:
    shutil.copy(Path(__file__).parent / "mine.py", tmp_path)


def answer(sched_sim: Run, line: str) -> dict[str, Any]:
    result = sched_sim(f"design {line} --format json")
    assert result.code == 0, result.err
    document: dict[str, Any] = json.loads(result.out)
    return document


@pytest.mark.parametrize(("within", "L"), [("0.374", 46), ("0.38", 62)])
def test_the_latest_landing_that_keeps_it(sched_sim: Run, within: str, L: int) -> None:
    """Golden values, computed apart from this project."""
    found = answer(sched_sim, f"--within {within} {INS} --method dual-rate --processor cortex-m4f")
    (row,) = found["designs"]
    assert (row["L"], row["allowed_L"], row["every"]) == (L, L, 1)
    assert row["std"] <= float(within) < lossless(shipped_model("ins-gps").model(400.0), [0, 1, 2], 80, L + 1).worst


def test_the_readmes_question_is_answered_at_once(sched_sim: Run) -> None:
    line = "design --within 0.38 --model ins-gps --hr-hz 400 --measurement-hz 5 --delay-ms 110"
    sched_sim(line)
    start = process_time()
    result = sched_sim(line)
    assert process_time() - start < 1.0
    assert "lands at 44 of the 62 you allow" in result.out
    assert "using every second measurement would cost 36 %" in result.out
    assert "landing in step L=N=80 instead of M=44 costs 3.7 %" in result.out


def test_what_is_said_of_a_part_is_true(sched_sim: Run) -> None:
    """Of every way that keeps it: at the part's speed the simulation misses nothing and lands where it says; its
    accuracy is that of this landing."""
    found = answer(sched_sim, f"--within 0.38 {INS} --all-methods --processor leon3 --processor cortex-m0plus")
    model = shipped_model("ins-gps").model(400.0)
    assert len(found["designs"]) >= 12
    for row in found["designs"]:
        chosen = {name: row[name] for name in ("low_rate_noise", "gain", "lr_propagate_by", "feedback") if row[name]}
        options = Options(**chosen)
        timing = Timing(row["N"], row["M"], row["L"])
        for on in row["parts"]:
            costs = select(on_part(load_costs(row["costs"]), load_part(on["processor"])), row["method"], options)
            schedule = simulate(costs, timing, Fraction(1, 400), 3, options)
            assert (schedule.misses == 0) == on["fits"] == (on["needed_share"] <= 1)
            assert on["slack"] == pytest.approx(1 - on["needed_share"])
            if on["fits"]:
                assert set(schedule.achieved) == {on["achieved_l"]}
                exact = lossless(model, [0, 1, 2], row["N"], on["achieved_l"]).worst
                assert on["std"] == pytest.approx(exact, rel=1e-6)
                assert on["correction_ms"] == pytest.approx(2.5 * on["achieved_l"])
            else:
                assert on["std"] is None


def test_ways_are_sorted_and_best_is_the_first_of_each_method(sched_sim: Run) -> None:
    line = f"--within 0.38 {INS} --processor cortex-a53"
    every, best = answer(sched_sim, f"{line} --all-methods")["designs"], answer(sched_sim, line)["designs"]
    assert [row["min_speed"] for row in every] == sorted(row["min_speed"] for row in every)
    for row in best:
        same = [other for other in every if other["method"] == row["method"]]
        assert row["min_speed"] == same[0]["min_speed"]
    assert {row["update_form"] for row in every} == {"textbook", "short"}
    assert {(row["low_rate_noise"], row["gain"]) for row in every if row["method"] == "dual-rate"} == {
        (noise, gain) for noise in ("exact", "sum", "euler") for gain in ("at-update", "precomputed")
    }


def test_the_cheapest_part_is_the_first(sched_sim: Run, tmp_path: Path) -> None:
    """By price where it is known, whatever is left of it; else the one with the least to spare."""
    text = (
        'name = "{}"\ntitle = "{}"\nprecision = "double"\nclock_mhz = {}\nlogic_per_arithmetic = 0\n{}'
        "[cycles]\nmultiply = 1\nadd = 1\ndivide = 10\nsqrt = 10\n"
    )
    for name, clock, price in (("dear", 10, "price = 9.5\n"), ("cheap", 100, "price = 2\n"), ("unpriced", 5, "")):
        (tmp_path / f"{name}.toml").write_text(text.format(name, name, clock, price), encoding="utf-8")
    parts = "--processor dear.toml --processor cheap.toml --processor unpriced.toml --processor leon3"
    (row,) = answer(sched_sim, f"--within 0.03 --model camera --method larsen {parts}")["designs"]
    assert [on["processor"] for on in row["parts"]] == ["cheap", "dear", "unpriced", "leon3"][: len(row["parts"])]
    assert [on["price"] for on in row["parts"]] == [2.0, 9.5, None, None]


def test_why_the_others_do_not(sched_sim: Run) -> None:
    found = answer(sched_sim, f"--within 0.3731 {INS} --processor cortex-m0plus --feedback next-step")
    assert {"dual-rate", "px4-predictor"} <= {row["method"] for row in found["others"]}
    assert "0.3733 m at best, landing at L=45" in found["others"][0]["reason"]
    assert all(row["reason"].startswith("no part is fast enough") for row in found["designs"])
    table = sched_sim(f"design --within 0.3731 {INS} --processor cortex-m0plus --feedback next-step").out
    assert "not dual-rate, delayed-horizon: 0.3733 m at best" in table
    assert "too slow: cortex-m0plus" in table


def test_that_no_part_will_do_is_an_answer_with_what_would_help(sched_sim: Run) -> None:
    """Exit code 0 as `minimum` and `processors` have; percentages in full."""
    line = f"design --within 0.38 {INS} --processor cortex-m0plus --feedback next-step --lr-propagate-by m"
    result = sched_sim(line)
    assert result.code == sched_sim("minimum -N 80 -M 44 --hr-hz 400 --processor cortex-m0plus").code == 0
    assert "no part will do: cortex-m0plus would need 209 % of its speed, with dual-rate; name a faster" in result.out
    assert "e+0" not in result.out
    assert "68,099 %" in result.out
    assert max(map(len, result.out.splitlines()[1:6])) <= 190
    assert "no part will do" not in sched_sim(f"{line} --processor rp2040").out
    help = " ".join(sched_sim("design --help").out.split())
    assert "exit code 0, and what would help" in help


def test_one_that_never_corrects_keeps_nothing(sched_sim: Run) -> None:
    is_refused(
        sched_sim(f"design --within 0.38 {INS} --method discard"), ["--method discard", "never corrects", "larsen"]
    )
    beside = sched_sim(f"design --within 0.38 {INS} --method discard --method larsen").out
    assert "no discard: every measurement that is late is left out, so that it never corrects" in beside
    unknown = sched_sim(f"design --within 0.38 {INS} --costs steffes2014 --method clone --method larsen").out
    assert "no clone: the cost table steffes2014 (steffes2014) has no costs of it" in unknown


def test_tasks_beside_it_need_their_share(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "tasks.toml").write_text(
        '[[task]]\nname = "control"\nhz = 400\noffset = 0\ncost_us = 500\npriority = 5\n', encoding="utf-8"
    )
    line = "--within 0.03 --model camera --method larsen --processor leon3"
    alone, beside = (answer(sched_sim, line + more)["designs"][0]["parts"][0] for more in ("", " --tasks tasks.toml"))
    assert beside["needed_share"] == pytest.approx(alone["needed_share"] + 0.2)
    assert beside["load"] == pytest.approx(alone["load"] + 0.2)


MINE = (
    'name = "mine"\nunit = "ms"\n[costs.larsen]\npropagate = 0.21\npropagate_accumulate = 0.3\nupdate = 0.42\n'
    "[costs.dual-rate]\nhr_propagate = {}\nhr_restart = 0.02\nhr_update = 0.02\nlr_propagate = 0.2\nlr_update = 0.26\n"
)
"""Costs in time."""


@pytest.mark.parametrize(
    ("costs", "task"),
    [("mine.toml", "hz = 100\ncost_ms = 9"), ("steffes2014", "period = 4\ncost = 3.6")],
)
@pytest.mark.parametrize("method", ["larsen", "dual-rate"])
def test_tasks_beside_costs_that_are_no_counts_are_those_of_minimum(
    sched_sim: Run, tmp_path: Path, costs: str, task: str, method: str
) -> None:
    (tmp_path / "mine.toml").write_text(MINE.format(0.29), encoding="utf-8")
    (tmp_path / "tasks.toml").write_text(
        f'[[task]]\nname = "control"\npriority = 5\noffset = 0\n{task}\n', encoding="utf-8"
    )
    line = f"--costs {costs} --tasks tasks.toml --method {method}"
    (row,) = answer(sched_sim, f"--within 0.38 {INS} --every 1 {line}")["designs"]
    (least,) = json.loads(sched_sim(f"minimum -N 80 -M 44 -L {row['L']} {line} --hr-hz 400 --format json").out)
    second = 1000 if costs == "mine.toml" else 1
    assert Fraction(row["min_speed_exact"]) == Fraction(least["min_speed_exact"]) * second
    alone = f"--within 0.38 {INS} --every 1 --costs {costs} --method {method}"
    assert row["min_speed"] > 3 * answer(sched_sim, alone)["designs"][0]["min_speed"]


@pytest.mark.parametrize(("propagate", "task"), [(0.29, ""), (3.9, ""), (0.29, "hz = 100\ncost_ms = 9")])
@pytest.mark.parametrize("method", ["larsen", "dual-rate"])
def test_costs_in_time_fit_the_loop_or_not_as_minimum_says(
    sched_sim: Run, tmp_path: Path, propagate: float, task: str, method: str
) -> None:
    (tmp_path / "mine.toml").write_text(MINE.format(propagate), encoding="utf-8")
    line = f"--costs mine.toml --method {method} --lr-propagate-by m --feedback next-step"
    if task:
        (tmp_path / "tasks.toml").write_text(
            f'[[task]]\nname = "control"\npriority = 5\noffset = 0\n{task}\n', encoding="utf-8"
        )
        line += " --tasks tasks.toml"
    asked = f"--within 0.38 {INS} --every 1 {line}"
    (row,) = answer(sched_sim, asked)["designs"]
    (on,) = row["parts"]
    (said,) = json.loads(sched_sim(f"minimum -N 80 -M 44 -L {row['L']} {line} --hr-hz 400 --format json").out)
    for key in ("processor", "fits", "needed_share", "slack", "load", "achieved_l", "correction_ms"):
        assert on[key] == pytest.approx(said[key]), key
    shown = sched_sim(f"design {asked}").out
    assert "fits: the machine of mine" in shown
    assert (" yes " if on["fits"] else "none fits: the machine of the costs would need") in shown


def test_a_task_that_takes_longer_than_its_period_is_refused_as_by_minimum(sched_sim: Run, tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(MINE.format(0.29), encoding="utf-8")
    (tmp_path / "tasks.toml").write_text(
        '[[task]]\nname = "control"\nhz = 100\ncost_ms = 900\npriority = 5\n', encoding="utf-8"
    )
    line = "--costs mine.toml --tasks tasks.toml"
    refusal = sched_sim(f"minimum -N 80 -M 44 -L 62 --hr-hz 400 {line}")
    assert sched_sim(f"design --within 0.38 {INS} {line}") == refusal
    is_refused(refusal, ["--tasks 'tasks.toml': task 'control' alone needs 9000 %", "900 ms"])


@pytest.mark.parametrize(("policy", "L"), [("fixed", 124), ("edf", 80)])
def test_beside_tasks_of_any_phase_it_may_land_beyond_the_next_measurement(
    sched_sim: Run, tmp_path: Path, policy: str, L: int
) -> None:
    """By deadlines only before it, for there the worst phase is not known."""
    (tmp_path / "tasks.toml").write_text(
        '[[task]]\nname = "control"\nhz = 100\ncost_us = 300\npriority = 5\n', encoding="utf-8"
    )
    line = f"--within 0.5 {INS} --method dual-rate --every 1 --processor rp2040 --tasks tasks.toml --policy {policy} "
    line += "--lr-propagate-by m --feedback next-step"
    (row,) = answer(sched_sim, line)["designs"]
    assert row["L"] == L
    assert row["parts"][0]["fits"]


def test_choices_that_are_given_are_kept(sched_sim: Run) -> None:
    rows = answer(sched_sim, f"--within 0.38 {INS} --method dual-rate --gain at-update --low-rate-noise exact "
                  "--all-methods --processor leon3")["designs"]  # fmt: skip
    assert {(row["gain"], row["low_rate_noise"]) for row in rows} == {("at-update", "exact")}


@pytest.mark.parametrize("line", ["-N 80 -M 1", "-N 80 -M 44"])
def test_the_way_that_needs_least_is_the_least_of_all_ways(sched_sim: Run, line: str) -> None:
    """Also of the deadline of LR propagate and of the feedback, and the column says so."""
    asked = f"--within 0.38 --model ins-gps {line} --method dual-rate --every 1 --processor leon3"
    (best,) = answer(sched_sim, asked)["designs"]
    given = [
        answer(sched_sim, f"{asked} --lr-propagate-by {by} --feedback {feedback}")["designs"][0]["min_speed"]
        for by in ("m", "l")
        for feedback in ("next-step", "same-step")
    ]
    assert best["min_speed"] == min(given) < given[0]
    assert "propagate by l" in sched_sim(f"design {asked} --feedback next-step -M 1 -N 80".replace("-M 44", "")).out


def test_ways_that_have_to_be_simulated_are_said_not_to_be_tried(sched_sim: Run) -> None:
    asked = f"design --within 0.38 {INS} --method dual-rate --every 1 --processor leon3 --policy edf"
    note = "dual-rate: another schedule, by --lr-propagate-by l or --feedback same-step, may need less: unless you give"
    assert note in sched_sim(asked).out
    assert note not in sched_sim(asked.replace("--policy edf", "")).out


def test_it_is_not_said_beside_a_row_that_is_one_of_them(sched_sim: Run) -> None:
    asked = f"design --within 10 {INS} --method dual-rate --processor leon3"
    shown = sched_sim(asked).out
    assert "same step" in shown
    assert "--feedback" not in shown
    assert "--feedback" in sched_sim(f"{asked} --feedback same-step --policy edf").out


def test_without_a_rate_there_is_no_part(sched_sim: Run) -> None:
    found = answer(sched_sim, "--within 5 --model mine:cv -N 10 -M 4 --output 0")
    assert all(row["parts"] == [] for row in found["designs"])
    assert all(row["achieved_l_at_min_speed"] <= row["L"] for row in found["designs"])
    assert {row["costs"] for row in found["designs"]} >= {"counted-2-0-1-short"}


def test_costs_in_other_units(sched_sim: Run) -> None:
    found = answer(sched_sim, f"--within 0.38 {INS} --costs steffes2014 --method dual-rate")
    assert found["cost_unit"] == "standard step"
    assert found["designs"][0]["min_speed"] == pytest.approx(0.75, abs=0.2)


def test_why_there_are_no_parts(sched_sim: Run) -> None:
    costs = sched_sim(f"design --within 0.38 {INS} --costs steffes2014").out
    assert "no parts: steffes2014 has no counted operations; leave --costs out" in costs
    assert "give --hr-hz" in sched_sim("design --within 5 --model mine:cv -N 10 -M 4 --output 0 --method larsen").out


def test_csv_has_a_row_for_each(sched_sim: Run) -> None:
    line = f"design --within 0.38 {INS} --format csv"
    rows = list(csv.DictReader(io.StringIO(sched_sim(line).out)))
    assert {row["method"] for row in rows} >= {"larsen", "dual-rate"}
    assert all(row["processor"] and row["parts_that_do"] for row in rows)


@pytest.mark.parametrize("kind", ["svg", pytest.param("pdf", marks=pytest.mark.exhaust)])
def test_the_figure_is_the_same_every_time(sched_sim: Run, tmp_path: Path, kind: str) -> None:
    pictures = []
    for _ in range(2):
        result = sched_sim(
            f"design --within 0.03 --model camera --method larsen --processor leon3 --figure front.{kind}"
        )
        assert "Wrote front" in result.err
        pictures.append((tmp_path / f"front.{kind}").read_bytes())
    assert pictures[0] == pictures[1]


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (f"{INS}", ["--within is missing", "--within 0.38"]),
        ("--within 0.38", ["--model is missing"]),
        ("--within 0.38 --model ins-gps -N 0", ["-N is 0: give at least 1 step"]),
        ("--within 0.38 --model ins-gps -N -5", ["-N is -5: give at least 1 step"]),
        ("--within 0.38 --model ins-gps -M -1", ["-M is -1: give 0 or more steps"]),
        (f"--within 0 {INS}", ["--within is 0", "greater than 0"]),
        (
            "--within 0.5 --model ins-gps -N 80 -M 200 --method clone-split",
            ["none of these can be had: clone-split: ", "--delay-ms 500 (-M 200)", "or --every 3"],
        ),
        (
            "--within 0.3 --model ins-gps -N 80 -M 200",
            ["0.436685 m, by recalculate, larsen, clone, carried-gain, dual-rate, landing"],
        ),
        (f"--within 0.36 {INS}", ["0.372935 m", "carried-gain, augmentation, dual-rate, landing at L=44"]),
        (f"--within 0.36 {INS} --method px4-predictor", ["0.382359 m, by px4-predictor", "allow --within 0.382359"]),
        ("--within 0.38 --model ins-gps --unit km", ["--unit km: position is in m"]),
        (f"--within -1 {INS}", ["--within is -1", "greater than 0"]),
        (f"--within nan {INS}", ["--within is 'nan'", "finite number"]),
        (
            f"--within 0.3 {INS}",
            ["--within 0.3: no method reaches it", "worst 0.372935 m", "recalculate, larsen", "L=44, 110 ms",
             "without delay it would be 0.356583 m", "allow --within 0.372935", "better sensor"],
        ),
        (f"--within 0.3 {INS} --metric rms", ["rms 0.35842"]),
        ("--within 1 --model mine:hover -N 10 -M 4 --output 0:2", ["--output 0:2", "yaw"]),
        ("--within 1 --model mine:singular -N 10 -M 4 --output 0", ["--model 'mine:singular'", "R"]),
        ("--within 1 --model mine:nan -N 10 -M 4 --output 0", ["--model 'mine:nan'", "Phi"]),
        ("--within 1 --model nix", ["--model 'nix' is unknown"]),
        (f"--within 1 {INS} --method kalman", ["--method 'kalman' is unknown"]),
        (
            f"--within 1 {INS} --method clone-split --costs steffes2014",
            ["--method clone-split", "steffes2014", "no costs of it", "choose from standard"],
        ),
        (f"--within 1 {INS} --motion 1,2", ["--motion 1,2", "measures 3"]),
        (f"--within 1 {INS} --processor nix", ["--processor 'nix' not found: give one of"]),
        (f"--within 1 {INS} --costs steffes2014 --processor leon3", ["--processor needs counted", "steffes2014"]),
        (f"--within 1 {INS} --costs steffes2014 --costs counted-9-3-3", ["--costs", "tables of one unit"]),
        ("--within 5 --model mine:cv -N 10 -M 4 --output 0 --processor leon3", ["--processor without --hr-hz"]),
        ("--within 5 --model mine:cv -N 10 -M 4 --output 0 --tasks tasks.toml", ["--tasks", "without --hr-hz"]),
        (f"--within 1 {INS} --figure front.txt", ["--figure 'front.txt'", "no picture format"]),
        (f"--within 1 {INS} --figure nowhere/front.svg", ["--figure", "nowhere"]),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused(sched_sim: Run, line: str, said: list[str]) -> None:
    is_refused(sched_sim(f"design {line}"), said)
