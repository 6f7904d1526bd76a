"""Which parts run a design, or whether the machine does of whose times its costs are: verdicts, cheapest first."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache

from sched_sim.costs.table import COUNTED, INSTRUCTION, SECONDS, CostTable
from sched_sim.design.options import Options
from sched_sim.design.pieces import Statistic
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError, option
from sched_sim.processors.part import Part, why_not_instructions
from sched_sim.schedule.tasks import Task
from studies.explorer.resolved import Resolved
from studies.explorer.same import Same, itself
from studies.explorer.searched import MOST_WORK_BESIDE, patience
from studies.selection.parts import OnPart, Parts, Place, by_cost, looked_at


@dataclass(frozen=True, slots=True)
class Where:
    """Where a design may run: the parts, by a table of counts; without parts the machine of a table of times.

    table: before a part makes times of it; rate: of the HR loop. tasks, and a context switch of the options: in
    seconds, without parts in the unit of the table. chosen: one of the parts, or None.
    """

    table: CostTable
    parts: tuple[Part, ...]
    rate: Fraction
    options: Options
    statistic: Statistic
    tasks: tuple[Task, ...] = ()
    chosen: Part | None = None

    def places(self, method: str) -> list[Place]:
        """With the costs of the method on each. Raises InputError for a table that lacks them."""
        table, parts = itself(self.table), tuple(map(itself, self.parts))
        return _places(table, parts, self.statistic, method, self.rate, self.options)


def where_of(asked: Resolved) -> tuple[Where | None, str]:
    """And why nothing is known of any place."""
    table, rate, given = asked.counts, asked.rate, asked.given
    if rate is None:
        return None, f"no parts: which do depends on the rate of the HR loop: give {option('hr_hz')}"
    parts = tuple(given.part(name) for name in given.part_names)
    if table.unit == INSTRUCTION:
        parts = tuple(part for part in parts if not why_not_instructions(table, part))
        if not parts:
            return None, f"no parts: none here states the cycles of instructions of {table.target}"
    elif not table.operations:
        if table.unit in SECONDS:
            return Where(table, (), rate, asked.design.options, asked.design.statistic, asked.tasks), ""
        return None, f"no parts: {table.name} has no counted operations: choose other costs, such as {COUNTED}"
    if asked.part is None and asked.design.options.context_switch:
        return None, f"no parts: {option('context_switch')} is no time beside counts: choose a processor, for seconds"
    if asked.part is None and asked.tasks:
        return None, "no parts: the costs of the tasks are no times: choose a processor"
    tasks = given.tasks_in("second", Fraction(1), rate)
    return Where(table, parts, rate, asked.design.options, asked.design.statistic, tasks, asked.part), ""


def verdicts(where: Where, method: str, timing: Timing, at: Callable[[int], float | None]) -> tuple[OnPart, ...]:
    """What each place makes of a design, by cost; nothing is known of one on which the least speed takes too long to
    search. at: the figure of the output by landing."""
    looked = [_looked_at(place, timing, where) for place in where.places(method)]
    figured = [replace(on, std=None if on.landed is None else at(on.landed)) for on in looked]
    return tuple(sorted(figured, key=by_cost))


def _looked_at(place: Place, timing: Timing, where: Where) -> OnPart:
    try:
        return looked_at(place, timing, where.options, where.tasks, patience(MOST_WORK_BESIDE))
    except InputError as error:
        return OnPart(place.part, None, None, remark=str(error))


@lru_cache(maxsize=256)
def _places(
    table: Same[CostTable],
    parts: tuple[Same[Part], ...],
    statistic: Statistic,
    method: str,
    rate: Fraction,
    options: Options,
) -> list[Place]:
    return _kept(table, parts, statistic).places(table.value, method, rate, options)


@lru_cache(maxsize=16)
def _kept(_table: Same[CostTable], parts: tuple[Same[Part], ...], statistic: Statistic) -> Parts:
    return Parts([part.value for part in parts], statistic)
