"""What the folder of `sched-sim code` compiles to: all that a board gets, with what is around the jobs."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.systems.example import example_system
from filters.translation.library import Precision
from studies.board.compiled import CORES, compiled
from studies.board.serial.methods import SERIAL
from studies.board.serial.multirate import MULTIRATE
from studies.board.steps import Steps
from studies.board.wanted import Filter
from studies.board.write import board_files
from studies.embedded.sources import FIRST, SIZES
from studies.measurement.emulation.toolchain import COMPILER

FOLDERS = (*(name for name in SERIAL if name not in MULTIRATE), "dual-rate")
"""Methods with a late measurement, and the filter without delay."""


class Folder(NamedTuple):
    """code: with constants, the model's too; ram: bytes of all arrays."""

    method: str
    precision: Precision
    core: str
    code: int
    ram: int


def folder(method: str, precision: Precision) -> Folder:
    """Of the design `FIRST`, textbook update, for the core that has such numbers.

    Raises:
        ValueError: the compiler is missing, or refuses the files.
    """
    delay = 0 if method == "standard" else FIRST.M
    steps = Steps(FIRST.N, delay, FIRST.L if method in ("dual-rate", "delayed-horizon") else delay)
    wanted = Filter(method, example_system(*SIZES), np.zeros(SIZES[0]), "textbook", precision, steps, "")
    files = board_files(wanted)
    sources = [name for name in files if name in ("filter.c", "tasks.c", "steps.c")]
    found = compiled(files, sources, precision)
    if found is None:
        raise ValueError(f"{COMPILER} cannot compile the folder of {method}")
    return Folder(method, precision, CORES[precision][0], sum(found.code.values()), found.ram)
