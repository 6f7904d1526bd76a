"""A sweep: the analysis, and the simulation if asked for, of every point of a grid, kept as it is done."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import astuple, dataclass
from functools import partial
from itertools import chain
from pathlib import Path
from typing import Any, NamedTuple

from sched_sim.design.pieces import works
from sched_sim.design.steady import hyperperiod_steps
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError
from sched_sim.schedule.engine import MANY_JOBS, Engine
from studies.sweep.dispatch import Compute, WorkerDeathError
from studies.sweep.grid import Chunk, Grid
from studies.sweep.rows import Column, Row, columns, rows_of
from studies.sweep.stopping import stop_signals
from studies.sweep.store import Store
from studies.sweep.store_layout import Layout, digest

ANALYSED = 20_000
"""Points between two commits where there is a closed form: some 50 ms of work."""

SIMULATED_STEPS = 50_000
"""Simulated HR steps between two commits of one worker: some 0.2 s of work."""

TIMES_FASTER = 20
"""How much faster machine code simulates, at the least."""

LARGEST_TASK = 1_000
"""Points sent to a worker at a time, at most."""

SEARCH_RUNS, STEPS_TO_START = 50, 200
"""About how many simulations, of a hyperperiod each, one least speed takes; and the HR steps that last as long as
starting one of them."""


@dataclass(frozen=True)
class Sweep:
    """A grid, and over how many measurement cycles each point is simulated (None: analysis alone), by which engine: the
    rows are the same."""

    grid: Grid
    cycles: int | None = None
    engine: Engine = "auto"

    @property
    def columns(self) -> tuple[Column, ...]:
        """The rows' columns."""
        return columns(simulated=self.cycles is not None, accuracy=self.grid.accuracy is not None)

    @property
    def chosen_engine(self) -> Engine:
        """SimPy for few points, for which machine code would not be loaded in time."""
        jobs = self.grid.size * (self.cycles or 0) * sum(self.grid.N) // len(self.grid.N)
        return "simpy" if self.engine == "auto" and jobs < MANY_JOBS else self.engine

    def description(self) -> Mapping[str, Any]:
        """All that the rows depend on, for the results file: equal for two sweeps only if all their rows are."""
        grid = self.grid
        return {
            "format": 5,
            "N": list(grid.N),
            "M": "all legal" if grid.M is None else list(grid.M),
            "L": "all legal" if grid.L is None else list(grid.L),
            "speed": [str(speed) for speed in grid.speeds] or "least",
            "method": list(grid.methods),
            "costs": [table.name for table in grid.tables],
            "unit": [table.unit for table in grid.tables],
            "tasks": [[str(value) for value in astuple(task)] for task in grid.tasks],
            "options": [[str(value) for value in astuple(options)] for options in grid.options],
            "work": [[str(value) for value in works(block.costs)] for block in grid.blocks],
            "simulated cycles": self.cycles,
            **({} if grid.accuracy is None else {"accuracy": grid.accuracy.description()}),
        }

    @property
    def digest(self) -> str:
        """Digest of the description, in hexadecimal."""
        return digest(self.description())

    def open(self, path: Path) -> Store:
        """The results file: made if it is not there; one of another sweep is refused with InputError."""
        return Store(path, Layout(self.description(), self.grid.blocks, self.columns))


class Outcome(NamedTuple):
    """The end of a run.

    before, computed: points that were in the file already, and that were added;
    stopped: the signal that ended the run early, None if it ended by itself.
    """

    before: int
    computed: int
    stopped: int | None


def run(sweep: Sweep, store: Store, compute: Compute, on_progress: Callable[[int], None]) -> Outcome:
    """Do all points that `store` has not; `on_progress` is called with the number of points in the file.

    Ctrl-C and SIGTERM end it early, after what is done has been kept. compute: who simulates, such as `processes(2)`.
    Raises InputError for a point whose simulation kills its process again and again.
    """
    before = done = store.count()
    on_progress(done)
    with stop_signals() as stopped:
        for rows in _computed(sweep, store.missing(sweep.grid.size), compute, lambda: stopped() is not None):
            store.add(rows)
            done += len(rows)
            on_progress(done)
        return Outcome(before, done - before, stopped() if done < sweep.grid.size else None)


def _computed(sweep: Sweep, missing: list[range], compute: Compute, stopped: Callable[[], bool]) -> Iterator[list[Row]]:
    """The rows of the missing points in portions: first what has a closed form, here, then the rest, by `compute`."""
    grid, cycles, engine = sweep.grid, sweep.cycles, sweep.chosen_engine

    def chunk_of(span: range) -> Chunk:
        return grid.chunk(span.start, span.stop)

    simulated: list[range] = []
    for span in chain.from_iterable(grid.spans(gap, lambda _: ANALYSED) for gap in missing):
        if stopped():
            return
        chunk = chunk_of(span)
        if cycles is None and chunk.has_closed_form:
            yield rows_of(chunk, None)
        else:
            simulated.append(span)
    if not simulated:  # nor processes started
        return

    def size(first: Chunk) -> int:
        N = int(first.designs.N[0])
        steps = N * (cycles or 0) // (1 if engine == "simpy" else TIMES_FASTER)
        if cycles is None or not first.has_closed_form:
            steps += SEARCH_RUNS * (STEPS_TO_START + hyperperiod_steps(Timing(N, 0, N), first.block.tasks))
        return min(SIMULATED_STEPS // max(steps, 1), LARGEST_TASK)

    smaller = chain.from_iterable(grid.spans(span, size) for span in simulated)
    try:
        yield from compute(partial(rows_of, cycles=cycles, engine=engine), smaller, chunk_of, stopped)
    except WorkerDeathError as error:
        point = grid.chunk(error.point, error.point + 1)
        (N,), (M,), (L,) = point.designs
        raise InputError(
            f"the simulation of point {point.start} (costs {point.block.table}, method {point.block.method}, N={N}, "
            f"M={M}, L={L}) ends its process each time, as when memory runs out: leave it out of the grid, or have "
            f"fewer workers share the memory; all finished points are kept"
        ) from None
