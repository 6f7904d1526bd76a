"""`--sparse`: what a model states is left out, what it does not state is shown and asked; verdicts say which it was."""

from __future__ import annotations

import json
import tomllib
from importlib import resources
from pathlib import Path

import pytest

from tests.command_line import Run, is_refused

MODEL = """
import numpy as np
from filters import Structure, System

def f(j, x, u, p, out):
    out[0] = x[0] + 0.1 * x[1]
    out[1] = x[1] + 0.1 * (u[0] - np.sin(x[0]))

def F(j, x, u, p):
    return np.array([[1.0, 0.1], [-0.1 * np.cos(x[0]), 1.0]])

def h(k, x, p, out):
    out[0] = x[0]

def H(k, x, p):
    return np.array([[1.0, 0.0]])

def Q(j, p):
    return np.array([[0.01, 0.0], [0.0, 0.02]])

def R(k, p):
    return np.array([[0.3]])

def silent():
    return System(2, 1, 1, f, F, Q, h, H, R, ())

def stated():
    return silent()._replace(structure=Structure(F=("1*", "*1"), H=("10",), Q=("*0", "0*"), R=("*",)))

def wrong():
    return silent()._replace(structure=Structure(F=("1*", "01"), H=("10",), Q=("*0", "0*"), R=("*",)))

def misshapen():
    return silent()._replace(structure=Structure(F=("1*",), H=("10",), Q=("*0", "0*"), R=("*",)))
"""
COUNTED = "measure --backend counted --method dual-rate"


@pytest.fixture
def sched_sim(sched_sim: Run) -> Run:
    """In whose folder the model is."""
    Path("own.py").write_text(MODEL)
    return sched_sim


def test_counts_stand_beside_those_of_the_dense_filter(sched_sim: Run) -> None:
    rows = json.loads(sched_sim(f"{COUNTED} --system own:stated --sparse --format json").out)
    found = {(row["method"], row["job"]): row for row in rows}
    row = found["standard", "propagate"]
    assert (row["structure"], row["minimum"], row["dense_minimum"]) == ("sparse", 24, 36)
    assert row["of_dense"] == pytest.approx(24 / 36)
    assert found["dual-rate", "lr_correct"]["of_dense"] == 1
    shown = sched_sim(f"{COUNTED} --system own:stated --sparse").out
    assert "sparse: F has 0 zeros and 2 ones, H has 1 zeros and 1 ones, Q has 2 zeros, R has 0 zeros" in shown
    assert "of dense" in shown


def test_without_the_flag_all_is_multiplied(sched_sim: Run) -> None:
    stated, silent = (sched_sim(f"{COUNTED} --system own:{name} --format json").out for name in ("stated", "silent"))
    assert stated == silent
    assert {row["structure"] for row in json.loads(stated)} == {"dense"}


@pytest.mark.parametrize("command", ["measure --backend counted", "code -N 8 -M 2 -o board"])
def test_what_is_not_stated_is_shown_and_asked(sched_sim: Run, command: str) -> None:
    refused = sched_sim(f"{command} --system own:silent --sparse")
    is_refused(refused, ["does not state which", "F has 0 zeros and 2 ones", "--confirm-probed", "from filters import"])
    lines = "".join(line.strip() for line in refused.err.partition("structure=")[2].splitlines())
    assert lines == 'Structure(F=("1*","*1",),H=("10",),Q=("*0","0*",),R=("*",),),'


def test_what_probing_found_can_be_confirmed(sched_sim: Run) -> None:
    confirmed = sched_sim(f"{COUNTED} --system own:silent --sparse --confirm-probed --format json")
    assert confirmed.out == sched_sim(f"{COUNTED} --system own:stated --sparse --format json").out


@pytest.mark.parametrize("command", ["measure --backend counted", "code -N 8 -M 2 -o board"])
def test_what_is_wrongly_stated_is_refused(sched_sim: Run, command: str) -> None:
    said = ["own:wrong", "its structure is not that of the model: F[1, 0] is not always 0", "write * there"]
    is_refused(sched_sim(f"{command} --system own:wrong --sparse"), said)
    is_refused(sched_sim(f"{command} --system own:misshapen --sparse"), ["F of the structure of the system has not 2"])


def test_verdicts_say_dense_or_sparse(sched_sim: Run) -> None:
    for flags in ("--sparse -o sparse.toml", "-o dense.toml"):
        assert sched_sim(f"{COUNTED} --system own:stated --method dual-rate {flags}").code == 0
    assert tomllib.loads(Path("sparse.toml").read_text())["structure"] == "sparse"
    for word in ("dense", "sparse"):
        line = f"-N 10 -M 4 --hr-hz 400 --costs {word}.toml --method dual-rate --processor cortex-m4f"
        for command in ("minimum", "processors"):
            shown = sched_sim(f"{command} {line}").out
            assert f"{word}      yes" in shown or f"{word}       yes" in shown
            assert f"{word} counts, textbook form" in shown
            assert {row["structure"] for row in json.loads(sched_sim(f"{command} {line} --format json").out)} == {word}
            assert f",{word}," in sched_sim(f"{command} {line} --format csv").out
        design = f"design --within 10 --model ins-gps --costs {word}.toml --method dual-rate"
        assert word in sched_sim(design).out
        assert json.loads(sched_sim(f"{design} --format json").out)["designs"][0]["structure"] == word


SHOWN = [
    "minimum -N 10 -M 4",
    "simulate -N 10 -M 4",
    "simulate -N 10 -M 4 --hr-hz 400 --processor esp32",
    "sweep -N 10 -M 4",
    "gantt -N 10 -M 4 -o fig.svg",
]


@pytest.mark.parametrize("command", SHOWN)
def test_every_command_says_that_costs_are_sparse(sched_sim: Run, command: str) -> None:
    said = "sparse: costs of filters that leave out zeros and ones of the model"
    for flags, times in (("--sparse -o costs.toml", 1), ("-o costs.toml", 0)):
        assert sched_sim(f"{COUNTED} --system own:stated {flags}").code == 0
        found = sched_sim(f"{command} --costs costs.toml --method dual-rate")
        assert found.code == 0, found.err
        assert (found.out + found.err).count(said) == times


def test_scripts_are_told_too(sched_sim: Run) -> None:
    assert sched_sim(f"{COUNTED} --system own:stated --sparse -o sparse.toml").code == 0
    line = "-N 10 -M 4 --costs sparse.toml --method dual-rate --format json"
    assert json.loads(sched_sim(f"simulate {line}").out)["structure"] == "sparse"
    assert set(json.loads(sched_sim(f"sweep {line}").out)["structure"].values()) == {"sparse"}


ON_M4F = "measured over predicted 0.76 (one timing, predict of eskf-rs, STM32F405) on cortex-m4f"
NOT_TIMED = "no published timing of sparse code on"
GROUNDS = [
    ("minimum --processor cortex-m4f", ON_M4F),
    ("minimum --processor esp32", f"{NOT_TIMED} esp32: the range is not known"),
    ("processors", f"{ON_M4F}; {NOT_TIMED} the others: the range is not known"),
    ("processors --processor esp32 --processor leon3", f"{NOT_TIMED} esp32, leon3: the range is not known"),
    ("design --within 10 --model ins-gps --processor esp32", f"{NOT_TIMED} esp32: the range is not known"),
]


@pytest.mark.parametrize(("command", "ground"), GROUNDS)
def test_timings_of_dense_loops_are_no_ground_for_sparse_counts(sched_sim: Run, command: str, ground: str) -> None:
    assert sched_sim(f"{COUNTED} --system own:stated --sparse -o sparse.toml").code == 0
    design = "" if command.startswith("design") else "-N 10 -M 4 --hr-hz 400"
    line = f"{command} {design} --costs sparse.toml --method dual-rate"
    shown = sched_sim(line).out
    assert f"sparse counts, textbook form; {ground}" in shown
    assert "KFCore" not in shown
    assert "ESP-DSP" not in shown
    if design:
        for row in json.loads(sched_sim(f"{line} --format json").out):
            assert row["needed_share_least"] is row["needed_share_most"] is None


def test_a_range_of_your_own_sparse_code_is_the_ground(sched_sim: Run) -> None:
    assert sched_sim(f"{COUNTED} --system own:stated --sparse -o sparse.toml").code == 0
    part = Path("mine.toml")
    shipped = resources.files("sched_sim.processors").joinpath("cortex-m4f.toml").read_text()
    part.write_text(shipped.replace("least = 0.76\nmost = 0.76", "least = 0.5\nmost = 1.5"))
    line = "minimum -N 10 -M 4 --hr-hz 400 --costs sparse.toml --method dual-rate --processor mine.toml --format json"
    (row,) = json.loads(sched_sim(line).out)
    assert row["needed_share_most"] == pytest.approx(3 * row["needed_share_least"])


def test_a_table_that_does_not_say_is_not_spoken_for(sched_sim: Run) -> None:
    assert "structure" not in sched_sim("minimum -N 10 -M 4 --costs steffes2014").out


@pytest.mark.parametrize(
    ("command", "said"),
    [
        ("measure --backend counted --sparse --method augmentation", ["--method augmentation", "no sparse jobs"]),
        ("code --sparse --method multirate-ud -o board", ["--method multirate-ud has no sparse jobs", "larsen"]),
        ("measure --backend numpy --sparse", ["--sparse: not with --backend numpy"]),
        ("measure --backend counted --confirm-probed", ["--confirm-probed: only with --sparse"]),
        ("code --confirm-probed -o board", ["--confirm-probed: only with --sparse"]),
        ("measure --robust position --sparse", ["leave out --sparse"]),
    ],
)
def test_what_has_no_sparse_jobs(sched_sim: Run, command: str, said: list[str]) -> None:
    is_refused(sched_sim(command), said)


def test_the_folder_says_how_it_was_made(sched_sim: Run) -> None:
    assert sched_sim("code --system own:stated --sparse -N 8 -M 2 -o board").code == 0
    assert "--update textbook --sparse --precision double" in Path("board/README.md").read_text()
    assert "Products leave out what is always zero" in Path("board/filter.c").read_text()
    assert 'structure = \\"sparse\\"' in Path("board/test.c").read_text()
