"""What the C compiles to on a Cortex-M, where a cross compiler is installed."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections import Counter
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
    sizes = Counter[str]()
    for name, size, _ in frames:
        sizes[name.split(":")[-1].partition(".")[0]] += int(size)  # f.part.0 is a part of f
    return Compiled(core, flags, version, code, ram, dict(sizes))


def stack_of(job: Translated, functions: Mapping[str, Translated], frames: Mapping[str, int]) -> int:
    """Bytes of the stack that a call of the job takes at most, without the C library. Functions that were put into
    their callers have no frame."""
    below = [stack_of(functions[name], functions, frames) for name in job.calls]
    return frames.get(job.name, 0) + max(below, default=0)


def stacks_of(text: str, functions: Mapping[str, Translated], frames: Mapping[str, int]) -> dict[str, int]:
    """Bytes of the stack that a call of each function takes at most that this C file has for others. functions: those
    of filter.c, which it calls."""
    found = [match.groups() for match in _FUNCTION.finditer(text)]
    insides = {name: inside for _, name, inside in found}

    def deepest(name: str) -> int:
        if name in functions:
            return stack_of(functions[name], functions, frames)
        called = {each for each in re.findall(r"\b(\w+)\(", insides[name]) if each in insides or each in functions}
        return frames.get(name, 0) + max(map(deepest, called), default=0)

    return {name: deepest(name) for static, name, _ in found if not static}


_FUNCTION = re.compile(r"^(static )?[a-zA-Z][\w *]*?\b(\w+)\([^;{}]*\)\n\{\n(.*?)^\}", re.MULTILINE | re.DOTALL)


def _run(folder: Path, *command: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
