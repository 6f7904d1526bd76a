"""What it costs to hand out a sweep's tasks by Dask instead of by the pool of this machine's processes.

One worker each, so that Dask's scheduler has a core of its own on a machine of two, as it has on a cluster.
"""

from __future__ import annotations

from collections.abc import Iterator
from importlib.util import find_spec
from itertools import islice
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter, thread_time

from benchmarks.timing import Result
from studies.sweep.dispatch import Compute
from studies.sweep.grid import Chunk
from studies.sweep.rows import Row, rows_of
from studies.sweep.scheduler import cluster
from studies.sweep.settings import settings
from studies.sweep.workers import processes
from tests.studies.sweep.dask_processes import dask_processes

SWEEP = settings({"N": "2:80", "speed": "0.6,0.8"}).sweep()
TASKS, POINTS, TASK_S, ROUNDS = 20, 1000, 0.2, 4
IN_A_ROW = 5


def busy(chunk: Chunk) -> list[Row]:
    """A task that takes TASK_S of a core, with real rows."""
    end = thread_time() + TASK_S
    rows = rows_of(chunk, None)
    while thread_time() < end:
        pass
    return rows


def seconds_a_task(compute: Compute) -> float:
    """The least of any IN_A_ROW of them, the first apart, for which a worker may start."""
    grid = SWEEP.grid
    spans = islice(grid.spans(range(grid.size), lambda _: POINTS), TASKS)
    ends = [perf_counter() for _ in compute(busy, spans, lambda span: grid.chunk(span.start, span.stop), lambda: False)]
    return min(last - first for first, last in zip(ends, ends[IN_A_ROW:], strict=False)) / IN_A_ROW


def results() -> Iterator[Result]:
    if find_spec("distributed") is None:
        print("Not measured: tasks by Dask, for the extra `cluster` is not installed.")
        return
    with TemporaryDirectory() as folder, dask_processes(Path(folder)) as dask:
        dask.worker()
        with cluster(dask.address, SWEEP) as compute:
            turns = [(seconds_a_task(compute), seconds_a_task(processes(1))) for _ in range(ROUNDS)]
    ours, theirs = (min(times) for times in zip(*turns, strict=True))
    yield Result(f"tasks of {TASK_S:g} s: by Dask over by the pool, a worker each", ours / theirs, 1.05, higher=False)
