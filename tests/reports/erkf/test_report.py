"""The committed report is what the code makes of the results stored in it, byte for byte, and what it says is true."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from reports.erkf.report import build
from reports.erkf.results import TABLES, Results
from reports.pages.stored import Rows
from sched_sim.costs.table import Cost, CostTable
from tests.command_line import Run
from tests.reports import published
from tests.reports.erkf.page import PUBLISHED, rebuilt, stored

pytestmark = pytest.mark.exhaust  # the study takes a quarter of a minute; `studies/robust` has its tests


def test_the_report_is_complete_and_opens_offline() -> None:
    published.is_complete("erkf", rebuilt())
    published.is_self_contained(rebuilt())


@pytest.mark.parametrize("name", published.names("erkf"))
def test_the_committed_file_is_rebuilt_byte_for_byte(name: str) -> None:
    published.is_rebuilt("erkf", name, rebuilt())


@pytest.mark.exhaust
def test_another_machine_changes_only_what_is_marked_as_measured() -> None:
    """Other times, other residues: in tables and text only what has the mark changes, and no figure but those two."""

    def slower(table: CostTable) -> CostTable:
        costs = {
            method: {kind: Cost.of(cost.minimum * (2 + number)) for kind, cost in kinds.items()}
            for number, (method, kinds) in enumerate(table.costs.items())
        }
        return replace(table, costs=costs, provenance={**table.provenance, "machine": "another"})

    heading, *body = stored().tables["agreement"]
    others = [[f"{3 * float(cell):.2g}" if 2 <= n < 7 else cell for n, cell in enumerate(row)] for row in body]
    other = build(
        Results(
            {name: slower(table) for name, table in stored().measured.items()},
            {**stored().tables, "agreement": [heading, *others], "singular-values": _other_residues()},
            stored().stored,
        )
    )
    published.differs_only_where_marked(rebuilt(), other, ["costs.svg", "singular-values.svg"])


def _other_residues() -> Rows:
    """Differences of singular values, three times as large."""
    heading, *body = stored().tables["singular-values"]
    residues = [number for number, head in enumerate(heading) if len(str(head).split()) > 2]
    assert residues
    return [heading, *([f"{3 * float(v or 'nan'):g}" if n in residues else v for n, v in enumerate(r)] for r in body)]


def test_the_command_writes_the_report(sched_sim: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("reports.erkf.results.results", lambda _thorough, _progress: stored())
    monkeypatch.setattr("reports.erkf.report.build", lambda found: rebuilt() if found is stored() else {})
    published.is_written("erkf", rebuilt(), sched_sim, tmp_path)


def test_what_is_stored_is_read_back() -> None:
    assert set(stored().tables) == set(TABLES)
    for name, content in stored().files().items():
        assert content == (PUBLISHED / name).read_bytes()
    course = stored().columns("drive")
    np.testing.assert_allclose(course["time_s"], np.arange(1000) / 10)
    assert not any(np.isnan(values).any() for values in course.values())
