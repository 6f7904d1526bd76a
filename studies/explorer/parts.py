"""Which parts run a design, or whether the machine does of whose times its costs are: verdicts, cheapest first."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache

from sched_sim.costs.table import INSTRUCTION, SECONDS, CostTable
from sched_sim.design.options import Options
from sched_sim.design.pieces import Statistic
from sched_sim.design.timing import Timing
from sched_sim.errors import option
from sched_sim.processors.part import Part, why_not_instructions
from sched_sim.schedule.tasks import Task
from studies.explorer.same import Same, itself
from studies.selection.parts import OnPart, Parts, by_cost


def known_parts(table: CostTable, parts: Sequence[Part], rate: Fraction | None) -> tuple[tuple[Part, ...], str]:
    """Those on which the costs of a table can be told, and why there are none. rate: of the HR loop."""
    if rate is None:
        return (), f"no parts: which do depends on the rate of the HR loop: give {option('hr_hz')}"
    if table.unit == INSTRUCTION:
        stated = tuple(part for part in parts if not why_not_instructions(table, part))
        none = f"no parts: none here states the cycles of instructions of {table.target}"
        return stated, "" if stated else none
    if table.operations:
        return tuple(parts), ""
    if table.unit in SECONDS:
        return (), ""
    return (
        (),
        f"no parts: {table.name} has no counted operations: choose other {option('costs')}, such as counted-9-3-3",
    )


def verdicts(
    table: CostTable,
    parts: Sequence[Part],
    method: str,
    timing: Timing,
    rate: Fraction,
    options: Options,
    statistic: Statistic,
    tasks: Sequence[Task],
    at: Callable[[int], float | None],
) -> tuple[OnPart, ...]:
    """What each part makes of a design, by cost; without parts the machine, where the costs are times.

    table: before a part makes times of it. tasks, and a context switch of the options: in seconds. at: the figure of
    the output by landing. Raises InputError as `least_speed` does.
    """
    looked = on_parts(table, parts, statistic).look(table, method, timing, rate, options, tasks)
    figured = [replace(on, std=None if on.landed is None else at(on.landed)) for on in looked]
    return tuple(sorted(figured, key=by_cost))


def on_parts(table: CostTable, parts: Sequence[Part], statistic: Statistic) -> Parts:
    """The table on each part, made once."""
    return _kept(itself(table), tuple(map(itself, parts)), statistic)


@lru_cache(maxsize=16)
def _kept(_table: Same[CostTable], parts: tuple[Same[Part], ...], statistic: Statistic) -> Parts:
    return Parts([part.value for part in parts], statistic)
