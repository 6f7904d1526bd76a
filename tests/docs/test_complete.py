"""Tables of the documentation that list all of something do."""

from __future__ import annotations

import re

import pytest

from sched_sim.cli.report import REPORTS
from sched_sim.design.binding import Binding
from studies import run_sweep
from tests.docs.test_examples import ROOT


def listed(page: str) -> list[str]:
    """The names in the first column of a page's tables."""
    rows = re.findall(r"^\| (`[^|]*) \|", (ROOT / "docs" / page).read_text(encoding="utf-8"), re.M)
    return [name for row in rows for name in re.findall(r"`([^`]+)`", row)]


def test_the_columns_of_a_sweep_and_what_binds() -> None:
    columns = run_sweep(N=3, M=1, L=3, simulate=True, model="camera").table.column_names
    heading = ["binding"]
    bindings = [*Binding.__members__, "task:NAME", "load"]
    assert sorted(listed("howto/sweeps.md")) == sorted([*columns, *heading, *bindings])


@pytest.mark.parametrize("package", ["filters", "sched_sim", "studies", "reports"])
def test_the_folders_of_the_source(package: str) -> None:
    named = {name for name in listed("explanation/house.md") if name.startswith(f"{package}/")}
    folders = {path.parent.relative_to(ROOT).as_posix() for path in (ROOT / package).glob("*/**/__init__.py")}
    assert folders <= named
    assert all((ROOT / name).is_dir() for name in named)


def test_the_reports() -> None:
    assert listed("howto/reports.md") == list(REPORTS)
