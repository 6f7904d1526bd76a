"""A results file after its writer was killed, or its disk was full: the same sweep goes on, and nothing is lost."""

import os
import random
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from sched_sim.errors import InputError
from studies.sweep.export import export
from studies.sweep.rows import rows_of
from studies.sweep.run import run
from studies.sweep.settings import settings
from studies.sweep.workers import processes
from tests.deaths import call_alone, killed_at_call, traceable
from tests.full_disk import room_for

SWEEP = settings({"N": "5:6", "M": "1:2"}).sweep()
LARGER = settings({"N": "24,26"}).sweep()
"""Some 800 rows."""


def resumed(sweep, path):
    """All rows, after what is missing has been computed."""
    with sweep.open(path) as store:
        run(sweep, store, processes(1), lambda _: None)
        return [row for rows in store.results(1000) for row in rows]


def rows_of_sweep(sweep):
    """In portions of ten, for `Store.add`."""
    spans = sweep.grid.spans(range(sweep.grid.size), lambda _: 10)
    return [rows_of(sweep.grid.chunk(span.start, span.stop), None) for span in spans]


def write_all(folder):
    """A whole life: a file is made, rows are added, some in the log and some written back, it is closed, exported."""
    with SWEEP.open(folder / "r.sqlite") as store:
        store.query("PRAGMA wal_autocheckpoint = 3")
        for rows in rows_of_sweep(SWEEP):
            store.add(rows)
        export(store, folder / "r.csv")


def die_everywhere(start, step):
    """Kill `write_all` at its system calls start, start + step, ...; go on each time, and compare."""
    with TemporaryDirectory() as folder:
        write_all(Path(folder))
        whole, exported = resumed(SWEEP, Path(folder, "r.sqlite")), Path(folder, "r.csv").read_bytes()
    died, call = True, start
    while died:
        with TemporaryDirectory() as name:
            folder = Path(name)
            died = killed_at_call(call, lambda folder=folder: write_all(folder))
            assert not (folder / "r.csv").exists() or (folder / "r.csv").read_bytes() == exported, call
            assert resumed(SWEEP, folder / "r.sqlite") == whole, call
            with SWEEP.open(folder / "r.sqlite") as store:
                export(store, folder / "r.csv")
            assert (folder / "r.csv").read_bytes() == exported, call
            assert sorted(os.listdir(folder)) == ["r.csv", "r.sqlite"], call
        call += step
    assert call > 100


@pytest.mark.skipif(not traceable(), reason="no process can be traced here")
@pytest.mark.parametrize(
    ("start", "step"),
    [(7, 41), *(pytest.param(start, 8, marks=pytest.mark.exhaust) for start in range(1, 9))],
)
def test_a_kill_at_any_system_call_loses_nothing(start, step):
    done = call_alone("tests.studies.sweep.test_store_death", "die_everywhere", start, step)
    assert done.returncode == 0, done.stderr


def test_a_full_disk_loses_nothing(tmp_path):
    """Full from the start, while rows are added, while they are written back; then there is room again."""
    whole = resumed(LARGER, tmp_path / "whole.sqlite")
    for room in range(0, (tmp_path / "whole.sqlite").stat().st_size, 20_000):
        path = tmp_path / f"{room}.sqlite"
        with room_for(room), pytest.raises(InputError, match="make room there") as error:
            resumed(LARGER, path)
        assert str(path) in str(error.value)
        assert resumed(LARGER, path) == whole
        assert not list(tmp_path.glob(f"{path.name}-*"))
        assert not list(tmp_path.glob(".*"))


def test_a_file_that_is_partly_written_back_is_whole_with_its_log(tmp_path):
    """Any pages of it: a disk that loses power owes no order."""
    path = tmp_path / "r.sqlite"
    with LARGER.open(path) as store:
        store.query("PRAGMA wal_autocheckpoint = 0")
        before = pages_of(path)
        for rows in rows_of_sweep(LARGER):
            store.add(rows)
        log = path.with_name("r.sqlite-wal").read_bytes()
        store.query("PRAGMA wal_checkpoint")
        after = pages_of(path)
    whole = resumed(LARGER, path)
    draw = random.Random(1)
    for number in range(30):
        path = tmp_path / f"{number}.sqlite"
        written = draw.sample(range(len(after)), draw.randrange(len(after)))
        pages = {page: before.get(page, bytes(PAGE)) for page in range(max(written, default=0))} | before
        pages |= {page: after[page] for page in written}
        path.write_bytes(b"".join(content for _, content in sorted(pages.items())))
        path.with_name(f"{path.name}-wal").write_bytes(log)
        assert resumed(LARGER, path) == whole, number


PAGE = 4096


def pages_of(path):
    """What is in a file, by the number of its page."""
    content = path.read_bytes()
    return {page: content[page * PAGE :][:PAGE] for page in range(len(content) // PAGE)}
