"""A sweep as a person with Python asks for it: values of the axes in, a table out."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator, Set
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pyarrow as pa

from sched_sim.bounds import short, whole
from sched_sim.errors import InputError
from sched_sim.html_table import html_table
from studies.sweep.arrow import schema, tables
from studies.sweep.axes import LONGEST_RANGE
from studies.sweep.export import AT_A_TIME
from studies.sweep.run import run
from studies.sweep.settings import settings
from studies.sweep.workers import processes

SHOWN = 20
"""Rows in a notebook."""


@dataclass(frozen=True)
class Rows:
    """A row for each design, with the columns of `sched-sim sweep --export`.

    pandas, polars and pyarrow read it (`polars.DataFrame(rows)`, `pyarrow.table(rows)`); `rows.table.to_pandas()`.
    """

    table: pa.Table

    def __len__(self) -> int:
        return int(self.table.num_rows)

    def __arrow_c_stream__(self, requested_schema: Any = None) -> Any:
        return self.table.__arrow_c_stream__(requested_schema)

    def _repr_html_(self) -> str:
        more = f"the first {SHOWN} of {len(self):,} designs" if len(self) > SHOWN else f"{len(self):,} designs"
        rows = self.table.slice(0, SHOWN).to_pylist()
        return html_table(more, self.table.column_names, [list(row.values()) for row in rows])


def _plain(values: Any) -> Any:
    """An axis's values as a grid file would have them; sets in an order that is the same every time."""
    if hasattr(values, "tolist"):
        return values.tolist()
    if isinstance(values, Set):
        return sorted(values, key=str)
    return list(islice(values, LONGEST_RANGE + 1)) if isinstance(values, Iterator | tuple) else values


def run_sweep(
    *,
    results: str | Path | None = None,
    workers: int = 0,
    on_progress: Callable[[int], None] = lambda _done: None,
    **axes: Any,
) -> Rows:
    """Analyse every design of a grid, and simulate it with `simulate=True`.

        run_sweep(N="10:90:10", M=[1, 2], speed="0.6:1.6:0.05", method="dual-rate")

    axes: by the names that a grid file has: N, M, L, speed, method, costs, statistic, processor, hr_hz, tasks,
    simulate, cycles, engine, and the fields of `sched_sim.Options`; each a value, several of them, or text such as
    "10:90:10", whose end is included. By default M and L are all that are legal, and the speed is each design's least.
    results: an SQLite file that keeps the rows as they are done: the same sweep again goes on where it ended.
    workers: processes that simulate; with 0 this one does. on_progress: called with the number of designs done.

    Raises InputError that lists all that is wrong with the axes, and for a results file of another sweep;
    KeyboardInterrupt for Ctrl-C, after what is done has been kept.
    """
    if whole(workers, "workers") < 0:
        raise InputError(f"workers is {workers}: give a whole number, 0 or more")
    if results is not None and (not isinstance(results, str | Path) or not str(results)):
        raise InputError(f"results is {short(repr(results))}: give the path of an SQLite file")
    sweep = settings({name: _plain(values) for name, values in axes.items()}).sweep()
    with TemporaryDirectory() as folder, sweep.open(Path(results or Path(folder, "rows.sqlite"))) as store:
        stopped = run(sweep, store, processes(workers), on_progress).stopped
        if stopped is not None:
            raise KeyboardInterrupt(f"stopped by {signal.Signals(stopped).name}")
        return Rows(pa.concat_tables([schema(store.columns).empty_table(), *tables(store, AT_A_TIME)]))
