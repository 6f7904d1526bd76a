"""What lies beside a results file, and its other names: nothing of the user's is touched, nothing of ours mistaken."""

import os
import sqlite3
from contextlib import closing

import pytest

from sched_sim.errors import InputError
from studies.sweep.run import run
from studies.sweep.settings import settings
from studies.sweep.store_layout import APPLICATION_ID
from studies.sweep.workers import processes

SWEEP = settings({"N": "5", "M": "1:2"}).sweep()


def resumed(path):
    with SWEEP.open(path) as store:
        run(SWEEP, store, processes(1), lambda _: None)
        return store.count()


def contents(folder):
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir())}


def test_files_of_the_users_own_stay(tmp_path):
    own = ["s.sqlite-new", "s.sqlite-lock", "s.sqlite.csv", "s.sqlite-", ".s.sqlite-new", ".s.sqlite.1-new", "s"]
    for name in own:
        (tmp_path / name).write_text("the user's own")
    before = contents(tmp_path)
    assert resumed(tmp_path / "s.sqlite") == SWEEP.grid.size
    assert resumed(tmp_path / "s.sqlite") == SWEEP.grid.size
    after = contents(tmp_path)
    assert after.pop("s.sqlite")
    assert after == before


@pytest.mark.parametrize("kind", ["-wal", "-shm", "-journal"])
def test_the_log_of_a_file_that_is_gone_is_not_taken_for_the_new_ones(tmp_path, kind):
    (tmp_path / f"s.sqlite{kind}").write_text("the user's own, or rows of a file that was moved")
    before = contents(tmp_path)
    with pytest.raises(InputError, match=rf"s\.sqlite is not there, but .*s\.sqlite{kind} is"):
        resumed(tmp_path / "s.sqlite")
    assert contents(tmp_path) == before


def test_a_lock_file_with_something_in_it_is_the_users(tmp_path):
    (tmp_path / ".s.sqlite.sched-sim-lock").write_text("mine")
    before = contents(tmp_path)
    with pytest.raises(InputError, match="holds something of yours"):
        resumed(tmp_path / "s.sqlite")
    assert contents(tmp_path) == before


def test_a_lock_left_by_a_kill_is_taken_over_and_goes(tmp_path):
    (tmp_path / ".s.sqlite.sched-sim-lock").touch()
    resumed(tmp_path / "s.sqlite")
    assert os.listdir(tmp_path) == ["s.sqlite"]


def test_a_link_is_the_file_that_it_points_to(tmp_path):
    (tmp_path / "there").mkdir()
    (tmp_path / "link.sqlite").symlink_to("there/s.sqlite")
    assert resumed(tmp_path / "link.sqlite") == SWEEP.grid.size
    assert os.listdir(tmp_path / "there") == ["s.sqlite"]
    with (
        SWEEP.open(tmp_path / "there" / "s.sqlite"),
        pytest.raises(InputError, match="is being written by another sweep"),
    ):
        SWEEP.open(tmp_path / "link.sqlite")
    assert sorted(os.listdir(tmp_path)) == ["link.sqlite", "there"]


def test_a_file_of_two_names_is_refused(tmp_path):
    resumed(tmp_path / "s.sqlite")
    os.link(tmp_path / "s.sqlite", tmp_path / "t.sqlite")
    before = contents(tmp_path)
    with pytest.raises(InputError, match=r"t\.sqlite has 2 names \(hard links\)"):
        resumed(tmp_path / "t.sqlite")
    assert contents(tmp_path) == before


def test_a_file_without_checksums_is_told_what_to_do(tmp_path):
    path = tmp_path / "s.sqlite"
    with closing(sqlite3.connect(path)) as connection, connection:
        connection.execute(f"PRAGMA application_id = {APPLICATION_ID}")
        connection.execute("CREATE TABLE rows (point INTEGER PRIMARY KEY, N INTEGER)")
    before = contents(tmp_path)
    with pytest.raises(InputError, match=r"is of an earlier version, which kept no checksums .* give another results"):
        resumed(path)
    assert contents(tmp_path) == before


@pytest.mark.parametrize("name", ["n" * 300, "n" * 250, "loop", "s.sqlite/r.sqlite", "gone/r.sqlite", "."])
def test_a_name_that_cannot_be_used(tmp_path, name):
    (tmp_path / "loop").symlink_to("loop")
    (tmp_path / "s.sqlite").touch()
    with pytest.raises(InputError, match="another results"):
        SWEEP.open(tmp_path / name)
    assert sorted(os.listdir(tmp_path)) == ["loop", "s.sqlite"]
