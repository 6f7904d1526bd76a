"""What no report marks as differing from machine to machine is the same text where a processor rounds otherwise."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from filters.arrays import FloatArray
from filters.systems.drive import CargoDrive, simulate_cargo_drive
from reports.erkf import report as erkf
from reports.erkf.results import read as read_erkf
from reports.modular import report as modular
from reports.modular.results import dropout_table
from reports.modular.results import read as read_modular
from reports.pages.machine import MARK, legend
from reports.pages.stored import Rows, digits
from studies.modular import oscillator as spring_mass
from studies.modular.oscillator_run import Record, Setting, oscillation
from studies.robust import drive as robust_drive
from studies.robust.drive import AttitudeMethod
from tests.reports import published
from tests.reports.otherwise import regenerated

REPORTS = ("steffes2014", "patent-multirate", "erkf", "modular", "embedded")
ULPS = 4


def otherwise(values: FloatArray, seed: int = 0) -> FloatArray:
    """The same numbers, wrong by some units in the last place."""
    wrong = np.random.default_rng(seed).integers(-ULPS, ULPS + 1, size=values.shape)
    other: FloatArray = values + wrong * np.spacing(values)
    return other


# ------------------------------------------------------------------------------------------------------- one mark


@pytest.mark.parametrize("report", REPORTS)
def test_a_page_with_marks_explains_them_in_the_same_words(report: str) -> None:
    page = (published.FOLDER / report / "index.md").read_text(encoding="utf-8")
    assert (legend("").partition(":")[0] in page) == (MARK in page)


# ---------------------------------------------------------------------------------------- a little of the studies, anew


def test_the_oscillators_table_does_not_depend_on_the_last_digits() -> None:
    setting = Setting(rate=20)
    records = [oscillation(setting, seed) for seed in range(6)]
    others = [
        Record(
            one.seed,
            otherwise(one.truth),
            [seen._replace(y=otherwise(np.asarray(seen.y), k)) for k, seen in enumerate(one.measurements)],
        )
        for one in records
    ]
    tables = [
        dropout_table({"usual": [*spring_mass.rows(each, setting, (0.1, 0.8, 0.95), "reference")]})
        for each in (records, others)
    ]
    assert tables[0] == tables[1]


@pytest.mark.exhaust
@pytest.mark.parametrize("method", [robust_drive.EKF, robust_drive.MORE_ROBUST, robust_drive.LIMIT_ALL])
def test_the_drives_errors_do_not_depend_on_the_last_digits(method: AttitudeMethod) -> None:
    drive = simulate_cargo_drive(1.0)
    other = CargoDrive(drive.time_s, *(otherwise(values) for values in drive[1:]))
    texts = []
    for one in (drive, other):
        error = np.degrees(robust_drive.estimate_attitude(one, method).x[:, :3] - one.attitude)
        texts.append([digits(value) for value in np.sqrt(np.mean(error**2, axis=0))])
    assert texts[0] == texts[1]


# -------------------------------------------------------------------------------------- all of it, on a plain processor


@pytest.mark.exhaust
@pytest.mark.parametrize("report", ["patent-multirate", "steffes2014"])
def test_what_is_computed_at_once_is_the_same_on_a_plain_processor(report: str, tmp_path: Path) -> None:
    for name, content in regenerated(report, tmp_path).items():
        assert content == (published.FOLDER / report / name).read_text(encoding="utf-8"), name


@pytest.mark.exhaust
@pytest.mark.parametrize("report", ["erkf", "modular"])
def test_the_simulated_reports_differ_only_where_marked_on_a_plain_processor(report: str, tmp_path: Path) -> None:
    tables: dict[str, Rows] = regenerated(report, tmp_path)  # type: ignore[assignment]
    folder = published.FOLDER / report
    if report == "erkf":
        stored = read_erkf(folder)
        published.is_unchanged_where_unmarked(
            erkf.build(stored), erkf.build(stored._replace(tables={**stored.tables, **tables})), ["singular-values.svg"]
        )
    else:
        kept = read_modular(folder)
        published.is_unchanged_where_unmarked(
            modular.build(kept), modular.build(kept._replace(tables={**kept.tables, **tables})), []
        )
