"""Folders of C, compiled and run here."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest

from filters.arrays import FloatArray
from filters.covariance_forms import CovarianceFormName
from filters.delayed.dual_rate import GainTime
from filters.delayed.low_rate_noise import LowRateNoise
from filters.system import System
from filters.translation.library import Precision
from studies.board.steps import Steps
from studies.board.wanted import Filter
from studies.board.write import board_files

HERE = Path(__file__).parent
WARNINGS = (
    *("all", "extra", "pedantic", "conversion", "double-promotion", "shadow"),
    *("missing-prototypes", "cast-align", "undef", "error"),
)
STRICT = ["-std=c99", *(f"-W{name}" for name in WARNINGS), "-ffp-contract=off"]
ARM = ["arm-none-eabi-gcc", "-mcpu=cortex-m4", "-mthumb", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard"]

needs_gcc = pytest.mark.skipif(shutil.which("gcc") is None, reason="gcc is not installed here")
needs_arm_gcc = pytest.mark.skipif(shutil.which(ARM[0]) is None, reason="arm-none-eabi-gcc is not installed here")


def written(
    system: System,
    *,
    method: str = "dual-rate",
    x0: FloatArray | None = None,
    update: CovarianceFormName = "textbook",
    precision: Precision = "double",
    steps: Steps | None = None,
    for_a_core: bool = False,
    gain: GainTime = "at-update",
    low_rate_noise: LowRateNoise = "exact",
) -> dict[str, str]:
    """The files of a filter. for_a_core: whether the cross compiler is asked for sizes, which takes a while."""
    start = np.zeros(system.states) if x0 is None else x0
    wanted = Filter(method, system, start, update, precision, steps, "sched-sim code", gain, low_rate_noise)
    if for_a_core:
        return board_files(wanted)
    with without_sizes():
        return board_files(wanted)


@contextmanager
def without_sizes() -> Iterator[None]:
    """The cross compiler is not asked, which takes a while."""
    with patch("studies.board.assembled.compiled", lambda *_: None):
        yield


def put(folder: Path, files: Mapping[str, str]) -> None:
    for name, text in files.items():
        (folder / name).write_text(text)


def build(folder: Path, *arguments: str, compiler: Sequence[str] = ("gcc",)) -> None:
    done = subprocess.run([*compiler, *STRICT, *arguments], cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def ran(folder: Path, program: str) -> tuple[int, str]:
    """Its status, and what it prints."""
    done = subprocess.run([folder / program], capture_output=True, text=True, check=False, timeout=60)
    return done.returncode, done.stdout


def ran_as_one(folder: Path, *sources: str, options: Sequence[str] = ()) -> tuple[int, str]:
    """As `ran`, of a program whose sources but for the last are compiled together, which takes the compiler least."""
    *together, apart = sources
    put(folder, {"one.c": "".join(f'#include "{name}"\n' for name in together)})
    build(folder, "-O0", *options, "one.c", apart, "-lm", "-o", "one")
    return ran(folder, "one")
