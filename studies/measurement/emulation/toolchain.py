"""The cross compiler and the emulator of the machine."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from sched_sim.errors import InputError, option
from studies.measurement.emulation.targets import Target

BOARD = Path(__file__).parent / "board"
COMPILER, SIZE, EMULATOR = "arm-none-eabi-gcc", "arm-none-eabi-size", "qemu-system-arm"
PACKAGES = "gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm"
"""Of Debian and Ubuntu."""

FLAGS = ("-std=c99", "-mthumb", "-O2", "-ffp-contract=off", "-fno-math-errno", "-ffunction-sections", "-fdata-sections")
LINKED = ("-nostartfiles", "--specs=nosys.specs", "-Wl,--gc-sections,--no-warnings")
EMULATED = ("-display", "none", "-monitor", "none", "-serial", "none", "-icount", "shift=0")
SEMIHOSTING = ("-semihosting-config", "enable=on,target=native")
LONGEST_S = 120
"""That one program may run."""


def missing() -> list[str]:
    """What is not there of the compiler, its C library and the emulator."""
    programs = [name for name in (COMPILER, EMULATOR) if shutil.which(name) is None]
    if COMPILER not in programs and not Path(_said(COMPILER, "-print-file-name=libm.a")).is_absolute():
        return [*programs, "newlib"]
    return programs


def check_installed() -> None:
    """Raises InputError that names the packages if something is `missing`."""
    if lacking := missing():
        raise InputError(
            f"{option('backend')} emulated needs {', '.join(lacking)}, not found here: install the packages {PACKAGES} "
            f"(Debian's names), or choose another {option('backend')}"
        )


def versions() -> dict[str, str]:
    """Of the compiler and the emulator, as they call themselves."""
    return {"compiler": _said(COMPILER, "--version"), "emulator": _said(EMULATOR, "--version")}


def run(target: Target, sources: Mapping[str, str]) -> list[str]:
    """The lines that the board prints of the jobs in `sources`, C and headers by the names of their files.

    Raises:
        ValueError: it cannot be compiled, or fails on the board.
    """
    with TemporaryDirectory() as scratch:
        folder = Path(scratch)
        _write(folder, sources)
        program = folder / "program.elf"
        places = f"-Wl,--defsym=code_at={target.code:#x},--defsym=ram_at={target.ram:#x}"
        files = [str(path) for path in (*sorted(folder.glob("*.c")), BOARD / "board.c")]
        _compile(target, folder, [*files, *LINKED, places, "-T", str(BOARD / "board.ld"), "-o", str(program), "-lm"])
        command = [EMULATOR, "-M", target.board, *EMULATED, *SEMIHOSTING, "-kernel", str(program)]
        try:
            done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=LONGEST_S)
        except subprocess.TimeoutExpired as error:
            raise ValueError(f"{target.name}: not done within {LONGEST_S} s on the emulated board") from error
    lines = (done.stdout + done.stderr).splitlines()
    if "DONE" not in lines:
        raise ValueError(f"{target.name}: failed on the emulated board: {' '.join(lines[-2:])[:300]}")
    return lines


def code_bytes(target: Target, sources: Mapping[str, str]) -> int:
    """Bytes of code and constants that the C files compile to, without the C library."""
    with TemporaryDirectory() as scratch:
        folder = Path(scratch)
        _write(folder, sources)
        total = 0
        for path in sorted(folder.glob("*.c")):
            built = path.with_suffix(".o")
            _compile(target, folder, ["-c", str(path), "-o", str(built)])
            text = subprocess.run([SIZE, str(built)], capture_output=True, text=True, check=True).stdout
            total += int(text.splitlines()[1].split()[0])
    return total


def _write(folder: Path, sources: Mapping[str, str]) -> None:
    for name, text in sources.items():
        (folder / name).write_text(text)


def _compile(target: Target, folder: Path, rest: Sequence[str]) -> None:
    command = [COMPILER, *FLAGS, *target.flags, f"-I{folder}", f"-I{BOARD}", "-include", "board.h", *rest]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        said = " ".join(done.stderr.replace(f"{folder}/", "").split())
        raise ValueError(f"{COMPILER} cannot compile what was made of the filter: {said:.400}")


def _said(*command: str) -> str:
    said = subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip()
    return said.partition("\n")[0]
