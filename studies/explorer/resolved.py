"""A design with its names looked up and its times in steps."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property

from sched_sim.costs.methods import DELAYED_METHODS
from sched_sim.costs.table import COUNTED, PAPERS, SECONDS, CostTable
from sched_sim.design.methods import METHODS, select
from sched_sim.design.pieces import Costs
from sched_sim.design.stated import Stated
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError, option
from sched_sim.processors.part import Part
from sched_sim.schedule.tasks import Task
from sched_sim.ticks import exact
from studies.explorer.design import Design
from studies.explorer.given import Given
from studies.explorer.query import Queries, number_text
from studies.selection.model import Model
from studies.selection.outputs import Outputs
from studies.selection.sampling import Sampling, with_defaults


@dataclass(frozen=True)
class Resolved:
    """What a design comes to.

    stated: N, M, L and the rate. sampling: of all measurements. counts: the cost table as it is named; table: the same
    in seconds on the part, where there is one. tasks: with costs in the unit of `table`. model, outputs: None where no
    model was named.
    """

    design: Design
    given: Given
    stated: Stated
    sampling: Sampling
    counts: CostTable
    table: CostTable
    part: Part | None
    tasks: tuple[Task, ...]
    model: Model | None
    outputs: Outputs | None
    _costs: dict[str, Costs] = field(default_factory=dict, repr=False, compare=False)

    @property
    def rate(self) -> Fraction | None:
        """Of the HR loop, in Hz."""
        return self.stated.rate

    @cached_property
    def queries(self) -> Queries:
        """Of the design, and of others beside it."""
        return Queries(self.design)

    @cached_property
    def methods(self) -> tuple[str, ...]:
        """Those of a late measurement that the cost table has."""
        return tuple(name for name in DELAYED_METHODS if name in self.table.costs or name in self.table.lacking)

    @property
    def machine_pace(self) -> Fraction | None:
        """What the part, or the machine whose times the costs are, does in an HR period, in the unit of `table`; None
        where costs are no times or the rate is not known."""
        if self.rate is None or self.table.unit not in SECONDS:
            return None
        return 1 / (self.rate * SECONDS[self.table.unit])

    @property
    def pace(self) -> Fraction | None:
        """What is asked for, else the machine's; None: the least of the method."""
        speed = self.design.speed
        return self.machine_pace if speed is None else exact(speed, option("speed"))

    def timing(self, method: str) -> Timing:
        """Raises InputError for times that the method cannot have."""
        return self.stated.timing(method, self.design.options)

    def asked_L(self, method: str) -> int:
        """The step by which corrections must land: as it was said, else the latest; whatever the method makes of it."""
        if self.stated.L is not None:
            return self.stated.L
        return METHODS[method].law(self.design.options.feedback).latest(self.sampling.N, self.sampling.M)

    def costs(self, method: str) -> Costs:
        """Raises InputError for entries that the table lacks."""
        if method not in self._costs:
            self._costs[method] = select(self.table, method, self.design.options, self.design.statistic)
        return self._costs[method]


def resolved(design: Design, given: Given) -> Resolved:
    """Raises InputError for names that are unknown, and for what does not go together."""
    model = None if design.model is None else given.model(design.model, None)
    asked = with_defaults(
        None if model is None else model.shipped,
        design.N,
        design.M,
        design.hr_hz,
        design.measurement_hz,
        design.delay_ms,
    )
    rate = None if asked.hr_hz is None else exact(asked.hr_hz, option("hr_hz"))
    _check_together(design, rate)
    stated = Stated.of(asked.N, asked.M, design.L, rate, asked.measurement_hz, asked.delay_ms, design.land_within_ms)
    held = (None, None) if stated.times is None else (stated.times.measurement_hz, stated.times.delay_ms)
    sampling = Sampling.of(None, stated.N, stated.M, rate, *held)
    part = None if design.processor is None else given.part(design.processor)
    counts = costs_of(design, given)
    table = counts if part is None else costs_of(design, given, design.processor)
    outputs = None
    if design.model is not None:
        model = given.model(design.model, rate)
        outputs = given.outputs(design.model, rate, design.output)
    tasks = given.tasks_in(table.unit, SECONDS.get(table.unit), rate)
    return Resolved(design, given, stated, sampling, counts, table, part, tasks, model, outputs)


def costs_of(design: Design, given: Given, part: str | None = None) -> CostTable:
    """The design's cost table, in seconds on the part, if one is named."""
    if design.costs is not None:
        return given.table(design.costs, part)
    if design.model is not None:
        return given.counts(design.model, part)
    return given.table(PAPERS if design.processor is None else COUNTED, part)


def _check_together(design: Design, rate: Fraction | None) -> None:
    if design.processor is not None and rate is None:
        raise InputError(
            f"{option('processor')} {design.processor} without {option('hr_hz')}: give the rate of the HR loop, such "
            f"as {option('hr_hz')} 400"
        )
    if design.processor is not None and design.speed is not None:
        raise InputError(
            f"{option('speed')} {number_text(exact(design.speed, option('speed')))} and {option('processor')} "
            f"{design.processor} exclude each other: a part's speed follows from {option('hr_hz')}"
        )
    for name in ("output", "within"):
        if getattr(design, name) is not None and design.model is None:
            raise InputError(
                f"{option(name)} without {option('model')}: give the model whose output it is, such as "
                f"{option('model')} ins-gps"
            )
