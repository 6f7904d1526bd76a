"""The committed report is what the code makes of the cost table committed with it, byte for byte."""

from __future__ import annotations

import csv
import io
import re
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

from reports.steffes import build
from sched_sim.cost_file import read_cost_table
from sched_sim.costs import Cost, CostTable

PUBLISHED = Path(__file__).parents[2] / "reports" / "published" / "steffes2014"


@cache
def committed_costs() -> CostTable:
    return read_cost_table(PUBLISHED / "measured.toml")


@cache
def rebuilt() -> dict[str, bytes]:
    return build(committed_costs())


def test_the_report_has_no_file_too_many_or_too_few() -> None:
    assert {path.name for path in PUBLISHED.iterdir()} == set(rebuilt())


@pytest.mark.parametrize("name", sorted(path.name for path in PUBLISHED.iterdir()))
def test_the_committed_file_is_rebuilt_byte_for_byte(name: str) -> None:
    assert rebuilt()[name] == (PUBLISHED / name).read_bytes()


def test_another_machine_changes_only_what_is_marked_as_measured() -> None:
    """Other measured costs: in the tables only columns with the mark change, in the text only lines with it, and no
    figure but the two that show measured costs."""
    table = committed_costs()
    slower = {
        method: {kind: Cost.of(cost.minimum * (2 if "update" in kind else 3)) for kind, cost in kinds.items()}
        for method, kinds in table.costs.items()
    }
    other = build(replace(table, costs=slower, provenance={**table.provenance, "machine": "another"}))
    for name, content in rebuilt().items():
        if name.endswith(".csv"):
            columns = [column for column in next(csv.reader(io.StringIO(content.decode()))) if "†" not in column]
            assert picked(content, columns) == picked(other[name], columns)
        elif name.endswith(".svg") and name not in ("costs.svg", "table4.svg"):
            assert content == other[name]
    before, after = (re.split(r"\n\n", files["index.md"].decode()) for files in (rebuilt(), other))
    changed = [one for one, two in zip(before, after, strict=True) if one != two]
    assert changed
    assert all("†" in paragraph for paragraph in changed)


def picked(content: bytes, columns: list[str]) -> list[list[str]]:
    return [[row[column] for column in columns] for row in csv.DictReader(io.StringIO(content.decode()))]


def test_the_page_is_self_contained() -> None:
    page = rebuilt()["index.html"].decode()
    assert len(re.findall(r'<img src="data:image/svg\+xml;base64,', page)) == 7
    assert not re.findall(r'(?:src|href)="(?:https?:)?//', page)


def test_it_names_the_machine_and_both_findings() -> None:
    text = rebuilt()["index.md"].decode()
    assert str(committed_costs().provenance["machine"]) in text
    assert "12 of the 15 cells" in text
    assert "already lands at L = 29" in text
