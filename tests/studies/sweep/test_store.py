"""The results file: what it keeps, and what it refuses without touching it."""

import os
import sqlite3
from contextlib import closing

import pytest

from sched_sim.errors import InputError
from studies.sweep.rows import rows_of
from studies.sweep.settings import settings

SWEEP = settings({"N": "5:9", "M": "1:2"}).sweep()
OTHER = settings({"N": "5:8", "M": "1:2"}).sweep()


def rows(start, stop):
    return [
        row
        for span in SWEEP.grid.spans(range(start, stop), lambda _: 100)
        for row in rows_of(SWEEP.grid.chunk(span.start, span.stop), None)
    ]


def test_rows_come_back_with_their_block_spelled_out(tmp_path):
    with SWEEP.open(tmp_path / "r.sqlite") as store:
        store.add(rows(0, 60))
        assert store.count() == 60
        (found,) = store.query("SELECT * FROM results WHERE method = 'dual-rate' AND N = 5 AND M = 1 AND L = 2")
        names = [column.name for column in store.layout.result_columns]
    row = dict(zip(names, found, strict=True))
    assert (row["costs"], row["feedback"], row["cpus"], row["context_switch"]) == ("steffes2014", "next-step", 1, 0.0)
    assert (row["min_speed_exact"], row["binding"], row["feasible"]) == ("26/25", "lr_propagate", 1)


def test_missing_are_the_gaps(tmp_path):
    with SWEEP.open(tmp_path / "r.sqlite") as store:
        assert store.missing(60) == [range(60)]
        store.add(rows(10, 20))
        store.add(rows(30, 31))
        store.add(rows(31, 40))
        assert store.missing(60) == [range(10), range(20, 30), range(40, 60)]
        store.add(rows(0, 10) + rows(20, 30))
        assert store.missing(60) == [range(40, 60)]
        store.add(rows(40, 60))
        assert store.missing(60) == []


def test_the_same_sweep_opens_it_again_and_leaves_one_file(tmp_path):
    path = tmp_path / "r.sqlite"
    with SWEEP.open(path) as store:
        store.add(rows(0, 7))
    with SWEEP.open(path) as store:
        assert store.missing(10) == [range(7, 10)]
    assert os.listdir(tmp_path) == ["r.sqlite"]


def folder_bytes(folder):
    return {path.name: path.read_bytes() if path.is_file() else None for path in sorted(folder.iterdir())}


def make_text(path):
    path.write_text("point,costs\n0,steffes2014\n")


def make_empty(path):
    path.touch()


def make_folder(path):
    path.mkdir()


def make_foreign_database(path):
    with closing(sqlite3.connect(path)) as connection, connection:
        connection.execute("CREATE TABLE rows (point INTEGER PRIMARY KEY)")


def make_other_sweep(path):
    with OTHER.open(path):
        pass


def make_killed_other_sweep(path):
    """With its write-ahead log still beside it."""
    with OTHER.open(path) as store:
        store.add([rows_of(OTHER.grid.chunk(0, 1), None)[0]])
        left = {name: (path.parent / name).read_bytes() for name in (path.name, f"{path.name}-wal")}
    for name, content in left.items():
        (path.parent / name).write_bytes(content)


def make_half_a_header(path):
    make_other_sweep(path)
    path.write_bytes(path.read_bytes()[:100])


@pytest.mark.parametrize(
    ("make", "why"),
    [
        (make_text, "is not a results file"),
        (make_empty, "is not a results file"),
        (make_folder, "is not a results file"),
        (make_foreign_database, "is not a results file"),
        (make_half_a_header, "is not a results file"),
        (make_other_sweep, r"belongs to another sweep \(N is \[5, 6, 7, 8\] there and \[5, 6, 7, 8, 9\] here\)"),
        (make_killed_other_sweep, "belongs to another sweep"),
    ],
)
def test_what_is_not_this_sweeps_file_is_refused_and_not_touched(tmp_path, make, why):
    path = tmp_path / "r.sqlite"
    make(path)
    before = folder_bytes(tmp_path)
    with pytest.raises(InputError, match=why) as error:
        SWEEP.open(path)
    assert str(path) in str(error.value)
    assert "another results" in str(error.value)
    assert folder_bytes(tmp_path) == before


@pytest.mark.parametrize(
    "flags",
    [
        {"speed": "0.7"},
        {"L": "5"},
        {"method": "larsen"},
        {"feedback": "same-step"},
        {"context_switch": "0.01"},
        {"simulate": True},
        {"simulate": True, "cycles": 4},
    ],
)
def test_any_other_axis_makes_another_sweep(flags):
    assert settings({"N": "5:9", "M": "1:2", **flags}).sweep().digest != SWEEP.digest


def test_the_order_of_values_does_not():
    again = settings({"N": ["9,5", "6:8"], "M": [2, 1], "method": ["dual-rate,larsen", "standard,recalculate"]}).sweep()
    assert again.digest == SWEEP.digest


def test_another_cost_under_the_same_name_makes_another_sweep(tmp_path):
    table = tmp_path / "mine.toml"
    text = 'name = "mine"\nunit = "step"\n[costs.standard]\npropagate = 0.4\nupdate = 0.6\n'
    table.write_text(text)
    flags = {"N": "5", "method": "standard", "costs": [str(table)]}
    with settings(flags).sweep().open(tmp_path / "r.sqlite"):
        pass
    table.write_text(text.replace("0.6", "0.7"))
    with pytest.raises(InputError, match="work is"):
        settings(flags).sweep().open(tmp_path / "r.sqlite")


def test_two_sweeps_do_not_write_one_file(tmp_path):
    path = tmp_path / "r.sqlite"
    with SWEEP.open(path) as store:
        with pytest.raises(InputError, match="is being written by another sweep"):
            SWEEP.open(path)
        store.add(rows(0, 3))
    with SWEEP.open(path) as store:
        assert store.count() == 3


def test_a_reader_sees_the_rows_while_the_sweep_runs(tmp_path):
    path = tmp_path / "r.sqlite"
    with SWEEP.open(path) as store, closing(sqlite3.connect(path)) as reader:
        store.add(rows(0, 3))
        assert reader.execute("SELECT COUNT(*) FROM results").fetchone() == (3,)


def test_a_folder_that_is_not_there(tmp_path):
    with pytest.raises(InputError, match=r"none/r.sqlite cannot be written: No such file or directory"):
        SWEEP.open(tmp_path / "none" / "r.sqlite")


def test_a_damaged_file_is_an_error_that_names_it(tmp_path):
    path = tmp_path / "r.sqlite"
    with SWEEP.open(path) as store:
        store.add(rows(0, 60))
    content = bytearray(path.read_bytes())
    content[-4096:] = b"\xff" * 4096
    path.write_bytes(content)
    with (
        SWEEP.open(path) as store,
        pytest.raises(InputError, match=r"r\.sqlite is damaged: no row can be read; give another results"),
    ):
        list(store.results(100))
