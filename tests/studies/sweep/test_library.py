"""A sweep asked for in Python: the rows of the command, as a table that others read."""

from __future__ import annotations

import signal
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pytest
from pyarrow import parquet

from sched_sim import InputError
from studies import run_sweep
from tests.command_line import Run


def test_its_rows_are_those_that_the_command_exports(sched_sim: Run, tmp_path: Path) -> None:
    done = sched_sim("sweep -N 4:5 -M 1:2 --speed 0.8,1.2 --simulate --cycles 2 --policy fixed,edf --export r.parquet")
    assert done.code == 0
    rows = run_sweep(N="4:5", M=[1, 2], speed=[0.8, "6/5"], simulate=True, cycles=2, policy=["fixed", "edf"])
    assert rows.table.equals(parquet.read_table(tmp_path / "r.parquet"))
    assert len(rows) == rows.table.num_rows


def test_others_read_them() -> None:
    rows = run_sweep(N=5, M=2)
    assert pa.table(rows).equals(rows.table)
    assert pa.RecordBatchReader.from_stream(rows).read_all().equals(rows.table)


@pytest.mark.parametrize("N", [range(4, 7), (4, 5, 6), [4, 5, 6], np.arange(4, 7), "4:6", "4,5,6"], ids=repr)
def test_values_of_an_axis(N: Any) -> None:
    assert run_sweep(N=N, M=np.int64(2)).table.equals(run_sweep(N="4:6", M=2).table)


def test_it_goes_on_from_its_results_file(tmp_path: Path) -> None:
    path, told = tmp_path / "rows.sqlite", []
    whole = run_sweep(N="4:5", M=1, results=path)
    with closing(sqlite3.connect(path)) as connection, connection:
        connection.execute("DELETE FROM rows WHERE point >= 3")
    assert run_sweep(N="4:5", M=1, results=str(path), on_progress=told.append).table.equals(whole.table)
    assert (told[0], told[-1]) == (3, len(whole))


def test_ctrl_c_keeps_what_is_done(tmp_path: Path) -> None:
    path = tmp_path / "rows.sqlite"
    sweep = {"N": "10:12", "simulate": True, "cycles": 500, "results": path}
    with pytest.raises(KeyboardInterrupt, match="SIGINT"):
        run_sweep(**sweep, on_progress=lambda done: signal.raise_signal(signal.SIGINT) if done else None)
    with closing(sqlite3.connect(path)) as connection:
        (kept,) = connection.execute("SELECT COUNT(*) FROM rows").fetchone()
    assert 0 < kept < len(run_sweep(N="10:12"))


@pytest.mark.parametrize(
    ("axes", "message"),
    [
        ({}, "N is missing: give N .such as N 10"),
        ({"N": "x", "cpus": 3}, "^N is 'x': .*; cpus '3' is unknown: choose from 1, 2$"),
        ({"N": 5, "rate": 2}, "^rate: this key is not permitted; the keys here are N, M, L, speed"),
        ({"N": 5, "cycles": 2**63}, "^cycles: must be at most 10,000,000"),
        ({"N": 5, "simulate": "yes"}, "^simulate: must be true or false"),
        ({"N": 5, "hr_hz": 400}, "^hr_hz .hr_hz in a grid file. needs costs in seconds"),
        ({"N": 5, "costs": "none"}, "cost table 'none' not found"),
        ({"N": 5, "M": 7, "L": 3}, "the grid is empty"),
    ],
)
def test_errors_name_the_argument(axes: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        run_sweep(**axes)
