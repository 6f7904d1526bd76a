"""The cores that can be emulated, each on a board of QEMU's that has it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from filters.translation.library import Precision
from sched_sim.errors import InputError, option
from sched_sim.text import did_you_mean


@dataclass(frozen=True)
class Target:
    """precision: of its FPU, or double where all is done in software. board: QEMU's name of the machine.

    flags: of gcc, that choose the core and its FPU. code, ram: where the board has memory, 2 MB each.
    per_tick: instructions that pass in a tick of SysTick, as QEMU with -icount shift=0 takes a nanosecond for each.
    """

    name: str
    title: str
    precision: Precision
    board: str
    flags: tuple[str, ...]
    per_tick: int
    code: int = 0x00000000
    ram: int = 0x20000000


TARGETS: Mapping[str, Target] = {
    target.name: target
    for target in (
        Target(
            "cortex-m4f",
            "Arm Cortex-M4 with its FPU, single precision",
            "single",
            "mps2-an386",
            ("-mcpu=cortex-m4", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard"),
            per_tick=40,  # 25 MHz
        ),
        Target(
            "cortex-m7",
            "Arm Cortex-M7 with a double precision FPU",
            "double",
            "mps2-an500",
            ("-mcpu=cortex-m7", "-mfpu=fpv5-d16", "-mfloat-abi=hard"),
            per_tick=40,
        ),
        Target(
            "cortex-m4-soft",
            "Arm Cortex-M4 without an FPU, double precision in software",
            "double",
            "mps2-an386",
            ("-mcpu=cortex-m4", "-mfloat-abi=soft"),
            per_tick=40,
        ),
        Target(
            "cortex-m33",
            "Arm Cortex-M33 with its FPU, single precision",
            "single",
            "mps2-an505",
            ("-mcpu=cortex-m33", "-mfpu=fpv5-sp-d16", "-mfloat-abi=hard"),
            per_tick=50,  # 20 MHz
            code=0x10000000,  # secure, from which it starts
            ram=0x38000000,
        ),
    )
}


def target_of(name: str | None) -> Target:
    """Raises InputError for one that is not known."""
    known = ", ".join(TARGETS)
    if name is None:
        raise InputError(f"{option('target')} is missing: which core is emulated, one of {known}")
    if name not in TARGETS:
        raise InputError(
            f"{option('target')} {name!r} is unknown: {did_you_mean(name, list(TARGETS))}choose from {known}"
        )
    return TARGETS[name]


def precision_of(target: Target, precision: str | None) -> Precision:
    """That of the target if none is given. Raises InputError for one that is none."""
    if precision is None:
        return target.precision
    if precision == "single":
        return "single"
    if precision == "double":
        return "double"
    raise InputError(f"{option('precision')} {precision!r} is unknown: choose from single, double")
