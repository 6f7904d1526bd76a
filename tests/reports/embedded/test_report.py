"""The committed report is what the code makes of the results stored in it, byte for byte."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from reports.embedded import results as results_of
from reports.embedded.live import recorded
from reports.embedded.report import build
from reports.embedded.results import SHIPPED, shipped
from sched_sim.costs.table import Cost, CostTable
from sched_sim.errors import InputError
from studies.embedded.known_loop import Check
from studies.embedded.sources import EMULATED, FORMS, NATIVE, Source
from tests.command_line import Run
from tests.reports import published
from tests.reports.embedded.page import rebuilt, rows, stored


def test_the_report_is_complete_and_opens_offline() -> None:
    published.is_complete("embedded", rebuilt())
    published.is_self_contained(rebuilt())


@pytest.mark.parametrize("name", published.names("embedded"))
def test_the_committed_file_is_rebuilt_byte_for_byte(name: str) -> None:
    published.is_rebuilt("embedded", name, rebuilt())


@pytest.mark.exhaust
def test_the_command_writes_the_report(sched_sim: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("reports.embedded.results.results", lambda _thorough, _progress: stored())
    published.is_written("embedded", rebuilt(), sched_sim, tmp_path)


# ------------------------------------------------------------------------------------------------ machines, and tools


def slower(table: CostTable) -> CostTable:
    """As on another machine."""
    costs = {
        method: {kind: Cost.of(cost.minimum * (2 if "update" in kind else 3)) for kind, cost in kinds.items()}
        for method, kinds in table.costs.items()
    }
    return replace(table, costs=costs, provenance={**table.provenance, "machine": "another"})


@pytest.mark.exhaust
def test_another_machine_changes_only_what_is_marked() -> None:
    native = {source.name for source in NATIVE}
    costs = {key: slower(table) if key[0] in native else table for key, table in stored().costs.items()}
    tables = {**stored().tables, "live": [[*row[:3], row[3].replace("0", "1")] for row in stored().tables["live"]]}
    other = build(stored()._replace(costs=costs, tables=tables))
    published.differs_only_where_marked(
        rebuilt(), other, ["answer.svg", "least-speed.svg", "least-speed-others.svg", "staircase.svg"]
    )


def test_what_is_shipped_is_what_was_published() -> None:
    costs, tables = shipped()
    for key, table in costs.items():
        assert replace(table, path="") == replace(stored().costs[key], path="")
    assert tables == {name: stored().tables[name] for name in SHIPPED}


def asked_of(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Instead of measuring, the stored tables; the names of what was asked for."""
    asked = []

    def table_of(source: Source, form: str, *, thorough: bool = False) -> CostTable:
        asked.append(f"{source.name}{' thorough' if thorough else ''}, {form}")
        return stored().costs[source.name, form]  # type: ignore[index]

    monkeypatch.setattr(results_of, "table_of", table_of)
    monkeypatch.setattr(results_of, "record", lambda _thorough, _progress: recorded(stored().tables))
    return asked


@pytest.mark.exhaust
def test_what_is_not_there_is_said_and_the_rest_is_of_what_is_shipped(monkeypatch: pytest.MonkeyPatch) -> None:
    """No emulator, no C compiler, no right to real-time priorities."""

    def refuse(_thorough: bool, _progress: object) -> None:
        raise InputError("live needs the right to real-time priorities")

    asked = asked_of(monkeypatch)
    monkeypatch.setattr(results_of, "missing", lambda: ["qemu-system-arm"])
    monkeypatch.setattr(results_of, "record", refuse)
    monkeypatch.setattr("shutil.which", lambda _name: None)
    monkeypatch.delenv("CC", raising=False)
    without = results_of.results(thorough=True)
    assert asked == [f"{name} thorough, {form}" for name in ("numba", "numpy") for form in FORMS]
    files = build(without)
    page = published.text(files)
    assert "**Nothing was emulated here**: qemu-system-arm not found: install the packages gcc-arm-none-eabi" in page
    assert "C † is missing: no C compiler found: install gcc or clang" in page
    assert "**Not run here** †: live needs the right to real-time priorities." in page
    assert files["staircase.svg"] == rebuilt()["staircase.svg"]
    for here, everywhere in zip(published.rows(files, "speeds-short.csv"), rows("speeds-short.csv"), strict=True):
        assert "C †" not in here
        assert here == {heading: cell for heading, cell in everywhere.items() if heading != "C †"}


@pytest.mark.exhaust
def test_with_all_tools_everything_is_run(monkeypatch: pytest.MonkeyPatch) -> None:
    asked, told = asked_of(monkeypatch), []
    monkeypatch.setattr(results_of, "missing", list)
    monkeypatch.setattr(results_of, "check", lambda target, _table: Check(target.name, (2001, 2001), 41, 0))
    monkeypatch.setattr(results_of, "instructions", lambda _timing: 1000)
    monkeypatch.setattr(results_of, "folder", lambda method, precision: (method, precision, "core", 1, 2))
    found = results_of.results(progress=lambda done, total, _what: told.append((done, total)))
    assert len(asked) == len(FORMS) * len([*EMULATED, *NATIVE])
    assert [done for done, _ in told] == [*range(19), 20]
    assert {total for _, total in told} == {20}
    assert found.said == {"emulated": "", "c": "", "live": ""}
    assert found.records("boards")[0]["instructions"] == "1000"


# ------------------------------------------------------------------------------------------------ what it says
