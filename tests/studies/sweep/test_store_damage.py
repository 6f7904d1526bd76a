"""A results file whose bytes have changed: its figures are the true ones, or there is an error that names it."""

import random
import re
import sqlite3
from contextlib import closing

import pytest

from sched_sim.errors import InputError
from studies.sweep.run import run
from studies.sweep.settings import settings
from studies.sweep.summary import best, by_method
from studies.sweep.workers import processes

SWEEP = settings({"N": "5:6", "M": "1:2", "speed": "0.6,1", "lr_propagate_by": "m,l"}).sweep()


def figures(path):
    """All that is read of the file, after what is missing has been computed anew."""
    with SWEEP.open(path) as store:
        run(SWEEP, store, processes(1), lambda _: None)
        return [row for rows in store.results(1000) for row in rows], by_method(store), best(store)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The bytes of a file with all rows, and its figures."""
    path = tmp_path_factory.mktemp("whole") / "r.sqlite"
    found = figures(path)
    return path.read_bytes(), found


def overwritten(content, draw):
    length = draw.choice([1, 1, 1, 2, 4, 16, 512])
    at = draw.randrange(len(content))
    return content[:at] + draw.randbytes(length) + content[at + length :]


def with_a_bit_turned(content, draw):
    at = draw.randrange(len(content))
    return content[:at] + bytes([content[at] ^ 1 << draw.randrange(8)]) + content[at + 1 :]


def with_a_piece_from_elsewhere(content, draw):
    length = draw.choice([8, 512, 4096])
    here, there = (draw.randrange(len(content) // length) * length for _ in range(2))
    return content[:here] + content[there : there + length] + content[here + length :]


def cut_off(content, draw):
    return content[: draw.randrange(len(content))]


@pytest.mark.parametrize("change", [overwritten, with_a_bit_turned, with_a_piece_from_elsewhere, cut_off])
def test_no_other_values_than_the_true_ones_are_read(tmp_path, whole, change):
    content, true = whole
    errors = []
    for seed in range(100):
        path = tmp_path / f"{seed}.sqlite"
        path.write_bytes(change(content, random.Random(seed)))
        try:
            assert figures(path) == true, seed
        except InputError as error:
            errors.append(str(error))
    assert 20 < len(errors) <= 100
    assert all(
        re.search(r"\d+\.sqlite is .*: give another results|\d+\.sqlite is damaged.*give another results", error)
        for error in errors
    )


def change_figure(path, points):
    with closing(sqlite3.connect(path)) as connection, connection:
        connection.execute(
            f"UPDATE rows SET min_speed = min_speed + 0.01 WHERE point IN ({', '.join(map(str, points))})"
        )


def test_damaged_rows_are_named_and_the_remedy_works(tmp_path, whole):
    content, true = whole
    path = tmp_path / "r.sqlite"
    path.write_bytes(content)
    change_figure(path, [3, 17])
    with pytest.raises(
        InputError, match="2 rows are not what was written, those of points 3, 17; delete them"
    ) as error:
        figures(path)
    _file, sql = str(error.value).split('"')[1::2]
    with closing(sqlite3.connect(path)) as connection, connection:
        connection.execute(sql)
    assert figures(path) == true


def test_an_export_reads_no_damaged_row(tmp_path, whole):
    content, _ = whole
    path = tmp_path / "r.sqlite"
    path.write_bytes(content)
    with SWEEP.open(path) as store:
        change_figure(path, [5])
        batches = store.results(4)
        with pytest.raises(InputError, match="1 row is not what was written, of point 5"):
            [row for rows in batches for row in rows]


def test_many_damaged_rows_are_counted(tmp_path, whole):
    content, _ = whole
    path = tmp_path / "r.sqlite"
    path.write_bytes(content)
    change_figure(path, range(40))
    with pytest.raises(InputError, match=r"40 rows .* points 0, 1, .*, 19, \.\.\.; give another results"):
        figures(path)


def test_rows_of_another_sweep_are_damaged_ones(tmp_path, whole):
    content, _ = whole
    other = settings({"N": "5:6", "M": "1:2", "speed": "0.6,1.1", "lr_propagate_by": "m,l"}).sweep()
    with other.open(tmp_path / "other.sqlite") as store:
        run(other, store, processes(1), lambda _: None)
    path = tmp_path / "r.sqlite"
    path.write_bytes(content)
    with closing(sqlite3.connect(path)) as connection, connection:
        connection.execute("ATTACH ? AS other", (str(tmp_path / "other.sqlite"),))
        connection.execute("REPLACE INTO rows SELECT * FROM other.rows WHERE point = 7")
    with pytest.raises(InputError, match="of point 7"):
        figures(path)


def test_what_a_user_adds_is_no_damage(tmp_path, whole):
    content, true = whole
    path = tmp_path / "r.sqlite"
    path.write_bytes(content)
    with closing(sqlite3.connect(path)) as connection:
        connection.executescript(
            "CREATE VIEW mine AS SELECT N, M FROM results; CREATE INDEX by_N ON rows (N); ANALYZE; VACUUM;"
        )
    assert figures(path) == true
