"""What other processors round otherwise, and another order of tests, changes no verdict."""

from __future__ import annotations

import os
import platform
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.exhaust import share_of

ROOT = Path(__file__).parents[1]
FILES = [
    path for folder in ("filters", "studies", "reports") for path in sorted(ROOT.glob(f"tests/{folder}/**/test_*.py"))
]
PARTS = 4

# What OpenBLAS, NumPy, the C library and numba choose by the processor. Without FMA products are rounded before they
# are added; vectors of another width are added up in another order; sin, exp and their kind have other last digits.
PROCESSORS = {
    "SSE4": {
        "OPENBLAS_CORETYPE": "Nehalem",
        "NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4 AVX512_ICL",
        "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX512F",
        "NUMBA_CPU_NAME": "generic",
    },
    "AVX2": {
        "OPENBLAS_CORETYPE": "Haswell",
        "NPY_DISABLE_CPU_FEATURES": "X86_V4 AVX512_ICL",
        "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX512F",
        "NUMBA_CPU_NAME": "haswell",
    },
}


@pytest.mark.exhaust
@pytest.mark.skipif(platform.machine() != "x86_64", reason="these settings are of x86 processors")
@pytest.mark.parametrize("part", range(PARTS))
@pytest.mark.parametrize("processor", PROCESSORS)
def test_numbers_hold_on_another_processor_and_in_another_order(processor, part, record_property):
    files = FILES[part::PARTS][: share_of(len(FILES) // PARTS + 1)]
    command = [sys.executable, "-m", "pytest", "-q", "-n", "0", "-p", "no:cacheprovider", f"--shuffle={part}", *files]
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")}
    environment |= PROCESSORS[processor]
    run = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout[-5000:]
    record_property(f"tests on {processor}", int(re.findall(r"(\d+) passed", run.stdout)[-1]))
