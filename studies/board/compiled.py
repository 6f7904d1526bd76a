"""What the C compiles to on a Cortex-M, where a cross compiler is installed."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Iterable, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from filters.translation.library import Precision
from filters.translation.translated import Translated

COMPILER, SIZE = "arm-none-eabi-gcc", "arm-none-eabi-size"
FLAGS = ("-std=c99", "-O2", "-mthumb", "-ffp-contract=off", "-fno-math-errno", "-fstack-usage", "-c")
CORES: Mapping[Precision, tuple[str, tuple[str, ...]]] = {
    "single": ("Cortex-M4F", ("-mcpu=cortex-m4", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard")),
    "double": ("Cortex-M7", ("-mcpu=cortex-m7", "-mfpu=fpv5-d16", "-mfloat-abi=hard")),
}
"""The core that has such numbers in hardware, and how it is compiled for."""
CLOCK_HZ: Mapping[Precision, str] = {"single": "168e6", "double": "216e6"}
"""An example of its clock: of an STM32F4, of an STM32F7."""


class Compiled(NamedTuple):
    """code: bytes of each file with its constants. ram: bytes of all. frames: of each function on the stack, bytes."""

    core: str
    flags: tuple[str, ...]
    compiler: str
    code: dict[str, int]
    ram: int
    frames: dict[str, int]


def compiled(files: Mapping[str, str], sources: Iterable[str], precision: Precision) -> Compiled | None:
    """None where there is no such compiler, or it has no C library."""
    if not (shutil.which(COMPILER) and shutil.which(SIZE)):
        return None
    core, flags = CORES[precision]
    with TemporaryDirectory() as scratch:
        folder = Path(scratch)
        for name, text in files.items():
            (folder / name).write_text(text, encoding="utf-8")
        done = _run(folder, COMPILER, *FLAGS, *flags, *sources)
        if done.returncode:
            return None
        code, ram = {}, 0
        for name in sources:
            text, data, bss = _run(folder, SIZE, f"{name[:-2]}.o").stdout.splitlines()[1].split()[:3]
            code[name] = int(text)
            ram += int(data) + int(bss)
        frames = [line.split("\t") for path in sorted(folder.glob("*.su")) for line in path.read_text().splitlines()]
    version = _run(Path(), COMPILER, "-dumpfullversion").stdout.strip()
    return Compiled(core, flags, version, code, ram, {name.split(":")[-1]: int(size) for name, size, _ in frames})


def stack_of(job: Translated, functions: Mapping[str, Translated], frames: Mapping[str, int]) -> int:
    """Bytes of the stack that a call of the job takes at most, without the C library. Functions that were put into
    their callers have no frame."""
    below = [stack_of(functions[name], functions, frames) for name in job.calls]
    return frames.get(job.name, 0) + max(below, default=0)


def _run(folder: Path, *command: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
