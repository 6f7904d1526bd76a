"""The committed report is what the code makes of the results stored in it, byte for byte."""

from __future__ import annotations

from pathlib import Path

import pytest

from reports.modular.report import build
from reports.modular.results import TABLES, Results
from studies.machines.parts import Micros, PartTimes
from tests.command_line import Run
from tests.reports import published
from tests.reports.modular.page import rebuilt, stored


def test_the_report_is_complete_and_opens_offline() -> None:
    published.is_complete("modular", rebuilt())
    published.is_self_contained(rebuilt())


def test_the_page_is_not_too_large() -> None:
    assert len(rebuilt()["index.html"]) < 1_200_000


@pytest.mark.parametrize("name", published.names("modular"))
def test_the_committed_file_is_rebuilt_byte_for_byte(name: str) -> None:
    published.is_rebuilt("modular", name, rebuilt())


def test_the_command_writes_the_report(sched_sim: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("reports.modular.results.results", lambda _thorough, _progress: stored())
    monkeypatch.setattr("reports.modular.report.build", lambda found: rebuilt() if found is stored() else {})
    published.is_written("modular", rebuilt(), sched_sim, tmp_path)


def test_what_is_stored_is_read_back() -> None:
    assert set(stored().tables) == set(TABLES)
    for name, content in stored().files().items():
        assert content == (published.FOLDER / "modular" / name).read_bytes()


@pytest.mark.exhaust
def test_another_machine_changes_only_what_is_marked_as_measured() -> None:
    """Other times: in tables and text only what has the mark changes, and no figure but the one that shows times."""
    here = stored().measured
    slower = {
        key: Micros(*(time * (2 + at % 3) for time in micros)) for at, (key, micros) in enumerate(here.parts.items())
    }
    flown = stored().flown
    later = {
        key: Micros(*(time * (2 + at % 3) for time in micros)) for at, (key, micros) in enumerate(flown.parts.items())
    }
    another = PartTimes({**here.provenance, "machine": "another"}, slower)
    again = PartTimes({**flown.provenance, "machine": "another"}, later, flown.name)
    other = build(Results(stored().tables, another, again, stored().stored, stored().flown_before))
    published.differs_only_where_marked(rebuilt(), other, ["parts.svg"])
