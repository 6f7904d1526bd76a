"""The grid of a sweep: its axes, and the map from a design index to a design point."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from itertools import accumulate, product
from typing import TYPE_CHECKING

from sched_sim.costs.table import CostTable
from sched_sim.design.least_speed import has_closed_form, least_speed
from sched_sim.design.method import Law
from sched_sim.design.methods import METHODS, select
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs, Statistic
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError, option
from sched_sim.schedule.tasks import Task, check_cpus, phases_matter
from studies.sweep.legal import Designs, Legal

if TYPE_CHECKING:
    from studies.sweep.accuracy import OutputAccuracy

MOST_PAIRS = 10_000_000
"""Pairs of N and M looked through for those that are legal."""


@dataclass(frozen=True, slots=True)
class Block:
    """The part of a grid with one cost table, one method and one set of options.

    number: its position among the blocks; table: the table's name; processor: the name of the one that its times are
    for; unit: that of `costs`, what the method's pieces cost; tasks: the user's other ones, accuracy: at which
    output, the same for all blocks; busy: whether the machine was while the costs were timed, None if `measure` did not
    time them.
    """

    number: int
    table: str
    processor: str | None
    unit: str
    method: str
    options: Options
    costs: Costs
    tasks: tuple[Task, ...]
    busy: bool | None = None
    accuracy: OutputAccuracy | None = field(default=None, compare=False)

    @property
    def has_closed_form(self) -> bool:
        """Whether the least speed of a design with one correction on its way at a time needs no simulation."""
        return has_closed_form(self.options, self.tasks)


@dataclass(frozen=True, slots=True)
class Chunk:
    """Consecutive points of one block: `size` of them from the design index `start` on.

    A design (N, M, L) has a point for each of `speeds`, or one if there are none: at its own least speed.
    skip: how many points of the first design come before `start`.
    """

    block: Block
    start: int
    size: int
    designs: Designs
    speeds: tuple[Fraction, ...]
    skip: int

    @property
    def has_closed_form(self) -> bool:
        """Whether no least speed of it needs a simulation."""
        law = METHODS[self.block.method].law(self.block.options.feedback)
        one_in_flight = law.only_first or bool((self.designs.N - law.before >= self.designs.L).all())
        return one_in_flight and self.block.has_closed_form

    @property
    def points(self) -> range:
        """The design indexes."""
        return range(self.start, self.start + self.size)

    @property
    def positions(self) -> range:
        """Positions of the points among all of `designs`, speeds running fastest."""
        return range(self.skip, self.skip + self.size)


@dataclass(frozen=True)
class Grid:
    """The axes of a sweep, each sorted and without repeats; M or L may be None: all that are legal.

    statistic: which figure of a measured cost. No speeds: each design is looked at at its own least speed. tasks: the
    user's other ones, beside every design; accuracy: at which output, None if that was not asked for.
    Where a table lacks what a method needs for M > N, such points are left out.
    A point's design index counts, from 0, the legal points in the order table, method, options, N, M, L, speed, the
    last running fastest.
    Raises InputError where a cost table lacks an entry, two tables have one name, a task cannot run beside every
    design, or no point is legal.
    """

    N: tuple[int, ...]
    M: tuple[int, ...] | None
    L: tuple[int, ...] | None
    speeds: tuple[Fraction, ...]
    methods: tuple[str, ...]
    tables: tuple[CostTable, ...]
    options: tuple[Options, ...]
    statistic: Statistic = "minimum"
    tasks: tuple[Task, ...] = ()
    accuracy: OutputAccuracy | None = None

    def __post_init__(self) -> None:
        names = [table.name for table in self.tables]
        for name in names:
            if names.count(name) > 1:
                raise InputError(f"two cost tables are named {name!r}: give each file a `name` of its own")
        self._check_simulated()
        pairs = sum(N + 1 for N in self.N) if self.M is None else len(self.N) * len(self.M)
        if pairs > MOST_PAIRS:
            raise InputError(
                f"the grid has {pairs:,} pairs of N and M: at most {MOST_PAIRS:,}; give fewer values of "
                f"{option('N')} or {option('M')}"
            )
        if not self.size:
            ranges = f"N={_extent(self.N)}, M={_extent(self.M)}, L={_extent(self.L)}"
            raise InputError(
                f"the grid is empty: none of the {self.left_out} combinations of {ranges} is legal: {self._rules()}"
            )

    def _check_simulated(self) -> None:
        """Raises InputError where designs that have no closed form cannot be simulated either."""
        units = list(dict.fromkeys(table.unit for table in self.tables))
        if self.tasks and len(units) > 1:
            raise InputError(
                f"the costs of the tasks are in one unit, and those of the cost tables in {' and '.join(units)}: sweep "
                f"{option('costs')} of one unit at a time"
            )
        for options in self.options:
            check_cpus(self.tasks, options.cpus)
        if not all(has_closed_form(options, self.tasks) for options in self.options):
            from sched_sim.design.steady import longest_run

            for N in self.N:
                longest_run(Timing(N, 0, N), self.tasks)

    def _rules(self) -> str:
        lacking = [reason for block in self.blocks if (reason := _lacking(block))]
        if lacking and self.M is not None and self.M[0] > self.N[-1]:
            return lacking[0]
        return (
            "legal are M <= L for standard, recalculate, larsen, clone and carried-gain, M < L for dual-rate (M <= L "
            "with same-step feedback), M < L <= N for delayed-horizon, M <= L <= N for other methods of late "
            f"measurements, and 1 <= L <= N without {option('M')} for the multirate and robust methods: choose "
            f"{option('L')} and {option('method')} so"
        )

    @cached_property
    def blocks(self) -> tuple[Block, ...]:
        keys = product(self.tables, self.methods, self.options)
        return tuple(
            Block(
                number=number,
                table=table.name,
                processor=table.processor,
                unit=table.unit,
                method=method,
                options=options,
                costs=select(table, method, options, self.statistic),
                tasks=self.tasks,
                busy=table.measured_on_busy_machine,
                accuracy=self.accuracy,
            )
            for number, (table, method, options) in enumerate(keys)
        )

    @cached_property
    def _legal(self) -> tuple[Legal, ...]:
        """By block; blocks under one law share theirs."""
        laws = [(_law(block), _is_simulated(block)) for block in self.blocks]
        of_law = {law: Legal(law[0], self.N, self.M, self.L, simulated=law[1]) for law in set(laws)}
        return tuple(of_law[law] for law in laws)

    @cached_property
    def _ends(self) -> tuple[int, ...]:
        return tuple(accumulate(legal.size * self._points_per_design for legal in self._legal))

    @property
    def _points_per_design(self) -> int:
        return max(len(self.speeds), 1)

    @property
    def size(self) -> int:
        """How many points are legal."""
        return self._ends[-1]

    @cached_property
    def left_out(self) -> int:
        """How many combinations of the given values are not legal. A value that stands for all legal ones is none."""
        return sum(legal.left_out for legal in self._legal) * self._points_per_design

    @cached_property
    def refused(self) -> Mapping[str, str]:
        """By the method of which no point is legal, why not, of its first one."""
        left = {block.method for block, legal in zip(self.blocks, self._legal, strict=True) if legal.size}
        first = {block.method: block for block in reversed(self.blocks)}
        return {method: self._why_none(first[method]) for method in self.methods if method not in left}

    def _why_none(self, block: Block) -> str:
        law = METHODS[block.method].law(block.options.feedback)
        N, M = self.N[0], 0 if self.M is None else self.M[0]
        if law.undelayed:
            return f"it has no delay: give {option('M')} 0, or leave it out, and 1 <= L <= N"
        if reason := law.why_none(N, M):
            return reason
        try:
            timing = Timing(N, M, law.latest(N, M) if self.L is None else self.L[0])
            least_speed(block.costs, timing, block.options, block.tasks)
        except InputError as error:
            return str(error)
        return "no point of it is legal"

    def chunk(self, start: int, stop: int) -> Chunk:
        """The points start .. stop-1, which must lie in one block (see `spans`)."""
        block = self.blocks[next(number for number, end in enumerate(self._ends) if start < end)]
        first = self._ends[block.number - 1] if block.number else 0
        per_design = self._points_per_design
        design, skip = divmod(start - first, per_design)
        end = -(-(stop - first) // per_design)
        designs = self._legal[block.number].designs(design, end)
        return Chunk(block, start, stop - start, designs, self.speeds, skip)

    def spans(self, indexes: range, size: Callable[[Chunk], int]) -> Iterator[range]:
        """`indexes` cut into ranges that lie in one block each; `size` tells how many points, from the first one."""
        start = indexes.start
        while start < indexes.stop:
            first = self.chunk(start, start + 1)
            stop = min(start + max(size(first), 1), self._ends[first.block.number], indexes.stop)
            yield range(start, stop)
            start = stop


MORE_THAN_N = Timing(1, 2, 2)


def _lacking(block: Block) -> str | None:
    """What the costs of a block lack for M > N."""
    return METHODS[block.method].lacking(block.costs, MORE_THAN_N)


def _law(block: Block) -> Law:
    """Of the dual-rate filter by deadlines, beside tasks of any phase, where several corrections are on their way their
    worst is not known."""
    law = METHODS[block.method].law(block.options.feedback)
    by_deadlines = not law.only_first and block.options.policy == "edf" and phases_matter(block.tasks)
    return law._replace(several=False) if by_deadlines or _lacking(block) else law


def _is_simulated(block: Block) -> bool:
    """Whether the least speed of a design of it, with several on their way at once, is found by simulation."""
    law = METHODS[block.method].law(block.options.feedback)
    if phases_matter(block.tasks):
        return False
    return law.several and not (law.only_first and block.has_closed_form)


def _extent(values: tuple[int, ...] | None) -> str:
    if values is None:
        return "all"
    return str(values[0]) if len(values) == 1 else f"{values[0]}..{values[-1]}"
