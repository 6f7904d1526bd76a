"""The committed report is what the code makes of the results stored in it, byte for byte, and what it says is true."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from reports.modular import build
from reports.modular_results import TABLES, Results, read
from tests.command_line import Run
from tests.reports import published


@cache
def stored() -> Results:
    return read(published.FOLDER / "modular")


@cache
def rebuilt() -> dict[str, bytes]:
    return build(stored())


def text() -> str:
    return published.text(rebuilt())


def rows(name: str) -> list[dict[str, str]]:
    return published.rows(rebuilt(), name)


def test_the_report_is_complete_and_opens_offline() -> None:
    published.is_complete("modular", rebuilt())
    published.is_self_contained(rebuilt())


def test_the_page_is_not_too_large() -> None:
    assert len(rebuilt()["index.html"]) < 1_500_000


@pytest.mark.parametrize("name", published.names("modular"))
def test_the_committed_file_is_rebuilt_byte_for_byte(name: str) -> None:
    published.is_rebuilt("modular", name, rebuilt())


def test_the_command_writes_the_report(sched_sim: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("reports.modular_results.results", lambda _progress: stored())
    monkeypatch.setattr("reports.modular.build", lambda found: rebuilt() if found is stored() else {})
    published.is_written("modular", rebuilt(), sched_sim, tmp_path)


def test_what_is_stored_is_read_back() -> None:
    assert set(stored().tables) == set(TABLES)
    for name, content in stored().files().items():
        assert content == (published.FOLDER / "modular" / name).read_bytes()


# ---------------------------------------------------------------------------------------------- what the text claims


def test_dropout_of_80_percent_is_felt() -> None:
    """In every reading but one the residual grows; in the last it falls."""
    error, innovation, after = rows("verdict.csv")
    assert all(3 < float(error[name]) < 6 for name in ("position", "velocity", "acceleration"))
    assert 1.4 < float(innovation["position"]) < 1.6
    assert float(innovation["acceleration"]) > 2.5
    assert float(after["position"]) < 0.7
    errors = [float(row["position, % of amplitude"].split(" ± ")[0].replace(",", "")) for row in rows("dropout.csv")]
    assert errors == sorted(errors)


def test_what_decides_is_the_time_between_measurements() -> None:
    of = {row["In a period"]: row for row in rows("rates.csv")}
    assert float(of["20"]["80 %, % of amplitude"]) > 100
    assert float(of["400"]["80 %, % of amplitude"]) < 3
    assert all(float(row["times"]) > 2.1 for row in of.values())
    assert of["100"]["borne, %"] == "80.0"


def test_where_its_model_is_true_the_filter_is_as_accurate_as_it_says() -> None:
    for row in rows("consistency.csv"):
        if row["Filter"] == "usual, its own model true":
            assert float(row["inside, %"]) > 90
            assert float(row["NEES"]) == pytest.approx(3, abs=0.15)
        if row["Filter"] == "usual":
            assert float(row["NEES"]) < 2.54


def test_the_run_that_is_drawn_is_half_dropped() -> None:
    run = stored().columns("oscillator")
    for name in ("position", "acceleration"):
        assert np.isnan(run[f"{name} measured"]).mean() == pytest.approx(0.5, abs=0.08)
