"""Each module of the four packages can be imported first, before any other of them; and what the tests import first."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent

IMPORT_EACH = """
import os, sys, traceback
import jinja2, matplotlib.pyplot, numpy, pydantic, rich, simpy, typer  # once for all, for they do not know the packages

for name in sys.argv[1:]:
    child = os.fork()
    if child == 0:
        try:
            __import__(name)
        except BaseException as error:
            print(f"{name}: {error!r}", flush=True)
        os._exit(0)
    os.waitpid(child, 0)
"""


@pytest.mark.exhaust
@pytest.mark.parametrize("package", ["filters", "reports", "sched_sim", "studies"])
def test_each_module_alone(package: str) -> None:
    files = [file.relative_to(ROOT).with_suffix("") for file in (ROOT / package).rglob("*.py")]
    names = sorted(".".join(file.parts).removesuffix(".__init__") for file in files if file.name != "__main__")
    run = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", IMPORT_EACH, *names], capture_output=True, text=True, check=True
    )
    assert run.stdout.splitlines() == []


def test_blas_is_not_loaded_before_it_is_told_how_many_threads_to_take() -> None:
    """As many as the machine has cores in each process of xdist, they would wait for one another."""
    asked = "import tests.conftest, sys; print('numpy' in sys.modules)"
    run = subprocess.run([sys.executable, "-c", asked], cwd=ROOT, capture_output=True, text=True, check=True)
    assert run.stdout == "False\n"
