"""`sched-sim measure --backend emulated`, and its table in `minimum`."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import pytest

from tests.boards import needs_board
from tests.command_line import Run, is_refused

pytestmark = needs_board

MODEL = """
import numpy as np
from filters.system import System

def f(j, x, u, p, out):
    out[0] = x[0]

def F(j, x, u, p):
    return p[0]

def h(k, x, p, out):
    out[0] = {h}

def matrix(k, p):
    return p[1]

def H(k, x, p):
    return p[1]

def model():
    one = np.eye(1)
    return System(1, 0, 1, f, F, matrix, h, H, matrix, (one, one, np.array([-1e9, 1e9])))
"""


def test_a_table_says_what_was_counted_and_minimum_takes_it(sched_sim: Run, tmp_path: Path) -> None:
    done = sched_sim(
        "measure --backend emulated --target cortex-m4f --states 2 --inputs 1 --measurements 1 --method dual-rate "
        "-o m.toml"
    )
    assert done.code == 0
    assert "instructions, not cycles, on an emulated cortex-m4f, single precision, arm-none-eabi-gcc" in done.out
    assert "dual-rate: HR code " in done.out
    table = tomllib.loads((tmp_path / "m.toml").read_text())
    assert table["unit"] == "instruction"
    assert table["name"] == "cortex-m4f-2-1-1"
    assert table["target"] == "cortex-m4f"
    assert table["precision"] == "single"
    assert "-mfpu=fpv4-sp-d16" in table["flags"]
    assert table["compiler"].startswith("arm-none-eabi-gcc")
    assert table["source"].startswith("instructions, not cycles")
    assert set(table["memory"]["dual-rate"]) == {"HR", "LR", "model"}
    (row,) = json.loads(
        sched_sim(
            "minimum -N 10 -M 4 --costs m.toml --method dual-rate --hr-hz 400 --processor cortex-m4f --ram-kb 4 "
            "--format json"
        ).out
    )
    assert row["fits"]
    assert row["fits_ram"]
    assert row["needed_share_most"] == row["needed_share"] == pytest.approx(2.65 * row["needed_share_least"])


@pytest.mark.parametrize(
    ("target", "h", "said"),
    [
        ("cortex-m7", "np.interp(x[0], p[2], p[2])", ["own.py:12", "np.interp(x[0], p[2], p[2])", "not translated"]),
        ("cortex-m4f", "x[0] if abs(x[0]) > 1e-14 else 0.0", ["own.py:12", "1e-14", "single precision"]),
        ("cortex-m4f", "x[0] + 1e-290", ["own.py:12", "single precision has no 1e-290"]),
    ],
)
def test_what_cannot_be_translated_is_refused_with_its_line(
    sched_sim: Run, tmp_path: Path, target: str, h: str, said: list[str]
) -> None:
    (tmp_path / "own.py").write_text(MODEL.replace("{h}", h))
    is_refused(sched_sim(f"measure --backend emulated --target {target} --system own:model --method larsen"), said)


@pytest.mark.exhaust
def test_the_robust_filter_is_emulated_too(sched_sim: Run) -> None:
    rows = json.loads(sched_sim("measure --backend emulated --target cortex-m7 --robust attitude --format json").out)
    steps = {row["method"]: row["median"] for row in rows if row["job"] == "robust_step"}
    assert min(steps, key=lambda method: steps[method]) == "robust-closed"
