"""Without the emulator or its compiler, and with what they are not told."""

from __future__ import annotations

from pathlib import Path

import pytest

from filters.systems.example import example_system
from sched_sim.errors import InputError
from studies.measurement.emulation.toolchain import COMPILER, EMULATOR, check_installed
from studies.measurement.methods import measure
from tests.command_line import Run, is_refused


def test_missing_programs_are_named_with_their_packages(monkeypatch: pytest.MonkeyPatch, sched_sim: Run) -> None:
    monkeypatch.setenv("PATH", "")
    packages = "gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm"
    said = ["--backend emulated", COMPILER, EMULATOR, packages]
    is_refused(sched_sim("measure --backend emulated --target cortex-m7"), said)
    with pytest.raises(InputError, match=f"^backend emulated needs .*{packages}"):
        measure(example_system(2, 1, 1), "emulated", name="any", target="cortex-m7")


def test_a_compiler_without_its_c_library_misses_newlib(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    for name, says in ((COMPILER, "libm.a"), (EMULATOR, "")):
        (tmp_path / name).write_text(f"#!/bin/sh\necho {says}\n")
        (tmp_path / name).chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(InputError, match="needs newlib, not found"):
        check_installed()


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("--backend emulated", ["--target is missing", "cortex-m4f, cortex-m7, cortex-m4-soft, cortex-m33"]),
        ("--backend emulated --target cortex-m4", ["--target 'cortex-m4' is unknown", "did you mean cortex-m4f?"]),
        ("--backend emulated --target cortex-m7 --precision half", ["--precision 'half'", "single, double"]),
        ("--target cortex-m7", ["--target: only with --backend emulated"]),
        ("--backend counted --precision single", ["--precision: only with --backend emulated"]),
        ("--backend emulated --target cortex-m7 --thorough", ["--thorough: leave it out", "the same in each run"]),
    ],
)
def test_wrong_flags_are_refused_before_anything_runs(sched_sim: Run, line: str, said: list[str]) -> None:
    is_refused(sched_sim(f"measure {line}"), said)
