"""Exported files against the rows, and what happens when they cannot be written."""

import csv
import os

import pytest
from pyarrow import parquet

from sched_sim.errors import InputError
from studies.sweep import export as exporting
from studies.sweep.export import check_export, export
from studies.sweep.run import run
from studies.sweep.settings import settings
from studies.sweep.workers import processes
from tests.full_disk import room_for

SWEEP = settings({"N": "4:6", "M": "1:2", "speed": "0.5,0.8", "simulate": True, "cycles": 2}).sweep()


@pytest.fixture(scope="module")
def store(tmp_path_factory):
    with SWEEP.open(tmp_path_factory.mktemp("sweep") / "r.sqlite") as store:
        run(SWEEP, store, processes(2), lambda _: None)
        yield store


def test_csv_holds_every_row(store, tmp_path):
    export(store, tmp_path / "r.csv")
    with (tmp_path / "r.csv").open(newline="") as file:
        header, *lines = csv.reader(file)
    rows = [row for batch in store.results(10) for row in batch]
    assert header == [column.name for column in store.columns]
    assert len(lines) == len(rows) == SWEEP.grid.size
    for line, row in zip(lines, rows, strict=True):
        for text, cell, column in zip(line, row, store.columns, strict=True):
            if column.kind == "bool":
                assert text == {True: "true", False: "false", None: ""}[cell]
            elif column.kind == "float" and cell is not None:
                assert float(text) == cell
            else:
                assert text == ("" if cell is None else str(cell))


def test_parquet_holds_the_same_with_types(store, tmp_path, monkeypatch):
    monkeypatch.setattr(exporting, "AT_A_TIME", 7)
    export(store, tmp_path / "r.parquet")
    file = parquet.ParquetFile(tmp_path / "r.parquet")
    table = file.read()
    assert file.num_row_groups == -(-SWEEP.grid.size // 7)
    assert table.column_names == [column.name for column in store.columns]
    rows = [row for batch in store.results(10) for row in batch]
    assert [tuple(row.values()) for row in table.to_pylist()] == rows
    assert str(table.schema.field("feasible").type) == "bool"
    assert str(table.schema.field("achieved_l").type) == "int64"
    assert table["achieved_l"].null_count > 0


@pytest.mark.parametrize("name", ["r.csv", "r.parquet"])
def test_a_failed_export_leaves_the_earlier_file(store, tmp_path, name):
    path = tmp_path / name
    path.write_text("earlier")
    with room_for(500), pytest.raises(InputError, match=rf"--export '.*{name}' cannot be written: .*make room there"):
        export(store, path)
    assert path.read_text() == "earlier"
    assert os.listdir(tmp_path) == [name]


@pytest.mark.parametrize(
    ("name", "why"),
    [("r.txt", "must end in .csv or .parquet"), ("none/r.csv", "a folder that exists"), ("folder.csv", "give a file")],
)
def test_exports_are_checked_before_the_work(tmp_path, name, why):
    (tmp_path / "folder.csv").mkdir()
    with pytest.raises(InputError, match=why):
        check_export(tmp_path / name)
