"""A report's studies as another processor would round them: python -m tests.reports.otherwise NAME FILE.

In a process of its own, since numpy, OpenBLAS and numba choose their code by the processor when they are loaded.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

ROOT = Path(__file__).parents[2]

PLAIN = {
    "OPENBLAS_CORETYPE": "Prescott",
    "NPY_DISABLE_CPU_FEATURES": "AVX2 FMA3 AVX512F AVX512CD AVX512_SKX AVX512_CLX AVX512_CNL AVX512_ICL AVX512_SPR",
    "NUMBA_CPU_NAME": "generic",
    "NUMBA_CPU_FEATURES": "",
}
"""An x86 processor of 2004: no fused multiply-add, vectors of two numbers. Elsewhere the variables say nothing."""


def _patent_multirate() -> Mapping[str, object]:
    from reports.multirate.report import build
    from reports.multirate.results import results

    return {name: content.decode() for name, content in build(results()).items()}


def _steffes() -> Mapping[str, object]:
    from reports.steffes.report import build
    from sched_sim.costs.table_file import read_costs
    from studies.machines.store import kept

    measured = read_costs(ROOT / "reports" / "published" / "steffes2014" / "measured.toml")
    return {name: content.decode() for name, content in build(measured, kept(measured.name)).items()}


def _erkf() -> Mapping[str, object]:
    from reports.erkf.results import simulated
    from reports.pages.stored import as_stored

    return as_stored(simulated())


def _modular() -> Mapping[str, object]:
    from reports.modular.results import simulated

    return simulated()


STUDIES: Mapping[str, Callable[[], Mapping[str, object]]] = {
    "patent-multirate": _patent_multirate,
    "steffes2014": _steffes,
    "erkf": _erkf,
    "modular": _modular,
}


def regenerated(report: str, folder: Path) -> dict[str, object]:
    """What the studies of this report give on a plain processor; files go to `folder`."""
    file = folder / f"{report}.json"
    command = [sys.executable, "-W", "ignore", "-m", "tests.reports.otherwise", report, str(file)]
    environment = {**os.environ, **PLAIN, "MPLBACKEND": "Agg"}
    subprocess.run(command, cwd=ROOT, env=environment, check=True)
    found: dict[str, object] = json.loads(file.read_text(encoding="utf-8"))
    return found


if __name__ == "__main__":
    Path(sys.argv[2]).write_text(json.dumps(STUDIES[sys.argv[1]]()), encoding="utf-8")
