"""What a sweep finds out about each design point: a row of figures, from the analysis and from the simulation."""

from __future__ import annotations

from typing import Literal, NamedTuple, TypeAlias

from sched_sim.design.timing import Timing
from sched_sim.schedule.engine import Engine
from studies.sweep.grid import Chunk
from studies.sweep.least import analyse

Cell: TypeAlias = int | float | str | None
"""A value as SQLite gives it: true and false are 1 and 0."""

Row: TypeAlias = tuple[Cell, ...]


class Column(NamedTuple):
    """A figure's name and kind."""

    name: str
    kind: Literal["int", "float", "text", "bool"]


ANALYSIS_COLUMNS = (
    Column("point", "int"),  # the design index
    Column("block", "int"),
    Column("N", "int"),
    Column("M", "int"),
    Column("L", "int"),
    Column("speed", "float"),
    Column("hr_hz", "float"),
    Column("min_speed", "float"),
    Column("min_speed_exact", "text"),
    Column("binding", "text"),
    Column("feasible", "bool"),
    Column("achieved_l", "int"),
)
"""speed, min_speed in cost units per HR period; feasible: every deadline holds at `speed`; achieved_l: the L at which
corrections land there, nothing if they do not. No speed given: `speed` is min_speed. hr_hz: where costs are in seconds,
the HR rate at which a period is `speed`."""

ACCURACY_COLUMNS = (Column("worst_std", "float"), Column("rms_std", "float"))
"""Of the output at `achieved_l`, in its unit; nothing where nothing lands."""

SIMULATION_COLUMNS = (
    Column("misses", "int"),
    Column("landed", "int"),
    Column("achieved_l_min", "int"),
    Column("achieved_l_max", "int"),
    Column("utilization", "float"),
    Column("preemptions", "int"),
    Column("hr_response", "float"),
    Column("lr_update_response", "float"),
)
"""The simulated cycles' missed deadlines, corrections that landed and the least and largest L of those, and the
worst response times in HR periods of the HR job and the LR update (nothing if none finished)."""


def columns(*, simulated: bool, accuracy: bool = False) -> tuple[Column, ...]:
    """Those of a sweep's rows."""
    return ANALYSIS_COLUMNS + (ACCURACY_COLUMNS if accuracy else ()) + (SIMULATION_COLUMNS if simulated else ())


def rows_of(chunk: Chunk, cycles: int | None, engine: Engine = "simpy") -> list[Row]:
    """A row for each point, in order; `cycles` measurement cycles of each are simulated, by `engine`, unless it is
    None."""
    block = chunk.block
    analysis = analyse(chunk)
    least = [(n / d, str(n) if d == 1 else f"{n}/{d}", binding) for n, d, binding in analysis.least]
    designs = list(zip(*(axis.tolist() for axis in chunk.designs), strict=True))
    in_seconds = block.unit == "second"
    paces = [(float(speed), float(1 / speed) if in_seconds else None) for speed in chunk.speeds]
    at_least = [] if paces else [(n / d, d / n if in_seconds else None) for n, d, _ in analysis.least]
    per_design = max(len(paces), 1)
    rows: list[Row] = []
    for point, position, (feasible, achieved) in zip(chunk.points, chunk.positions, analysis.outcomes, strict=True):
        design, at = divmod(position, per_design)
        pace = paces[at] if paces else at_least[design]
        rows.append((point, block.number, *designs[design], *pace, *least[design], int(feasible), achieved))
    if block.accuracy is not None:
        periods = [designs[position // per_design][0] for position in chunk.positions]
        landed = [outcome.achieved for outcome in analysis.outcomes]
        stds = block.accuracy.of(block.method, block.options.low_rate_noise, periods, landed)
        rows = [(*row, *figures) for row, figures in zip(rows, stds, strict=True)]
    if cycles is None:
        return rows
    from studies.sweep.simulated import simulated

    timings = [Timing(*design) for design in designs]
    points = [(timings[position // per_design], analysis.speed(chunk, position)) for position in chunk.positions]
    return [row + figures for row, figures in zip(rows, simulated(block, points, cycles, engine), strict=True)]
