"""The accuracy along a trajectory: there is no periodic regime, so over its steps the median, the 95th percentile and
the worst."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from filters.accuracy.model import LinearModel
from filters.accuracy.prefix import prefix
from filters.accuracy.riccati import steady_prior
from filters.accuracy.trace import Spread, along, spread
from filters.arrays import FloatArray
from sched_sim.bounds import short
from sched_sim.design.options import Options
from sched_sim.errors import InputError, option
from sched_sim.html_table import html_table
from sched_sim.plain_table import plain_table
from sched_sim.ticks import Number, exact
from studies.selection.landing import Landed, Processor, landed
from studies.selection.methods import COMPARED, METHODS, by_reason
from studies.selection.model import Model
from studies.selection.outputs import Outputs
from studies.selection.sampling import Sampling
from studies.selection.trajectory import Linearised, Trajectory, linearised_along
from studies.selection.waiting import too_late


@dataclass(frozen=True, slots=True)
class AlongRow:
    """One method with every so manieth measurement, N steps apart, landing L steps after each; remark: why it has no
    spread, or what was not looked at. oldest_ms: None without a rate. over: of the worst, as in `AccuracyRow`."""

    method: str
    every: int
    N: int
    L: int | None
    spread: Spread | None
    over: float | None
    oldest_ms: float | None
    remark: str = ""


@dataclass(frozen=True, repr=False)
class AlongComparison:
    """first: the step from which on the steps count, that of the first landing of all."""

    model: Model
    outputs: Outputs
    sampling: Sampling
    steps: int
    first: int
    rows: tuple[AlongRow, ...]
    left_out: tuple[str, ...] = ()

    def __repr__(self) -> str:
        remarks = by_reason((row.method, row.remark) for row in self.rows)
        return plain_table(*self._table, [*remarks, *self.left_out])

    def _repr_html_(self) -> str:
        return html_table(*self._table)

    @property
    def _table(self) -> tuple[str, tuple[str, ...], list[tuple[Any, ...]]]:
        """Caption, headings, rows."""
        unit = f", {self.outputs.unit}" if self.outputs.unit else ""
        caption = f"{self.model.name}, {self.steps:,} steps: standard deviation of {self.outputs.name}{unit}"
        headings = ("method", "every", "N", "lands at", "median", "95 %", "worst")
        return (
            caption,
            headings,
            [(row.method, row.every, row.N, row.L, *(row.spread or [None] * 3)) for row in self.rows],
        )


def compared_along(
    model: Model,
    outputs: Outputs,
    sampling: Sampling,
    path: Trajectory,
    *,
    initial_std: Sequence[Number] | str | None = None,
    L: int | None = None,
    methods: Sequence[str] | None = None,
    every: Sequence[int] = (1,),
    options: Options = Options(),
    processor: Processor | None = None,
) -> AlongComparison:
    """Of the methods that lose nothing: others have no closed form along a trajectory.

    initial_std (n,): standard deviations of the states in the first step; if not given, what they settle to there.
    Raises InputError for a method that has none, and where they do not settle.
    """
    assert model.system is not None
    chosen, left_out = _lossless(methods)
    at_each = linearised_along(model.system, path)
    P0 = _initial(model, sampling, at_each, initial_std)

    def lands(name: str, number: int) -> Landed:
        late = too_late(name, sampling, number, options)
        return Landed(None, late) if late else landed(name, sampling.using(number).N, sampling.M, L, options, processor)

    designs = {(number, name): lands(name, number) for number in every for name in ("standard", *chosen)}
    first = max((at.L for at in designs.values() if at.L is not None), default=0)
    if first > path.steps:
        raise InputError(
            f"{option('trajectory')} has {path.steps} steps, and the first correction lands in step {first}: give a "
            f"longer one"
        )
    found: dict[tuple[int, int], Spread] = {}

    def spread_of(number: int, lands: int) -> Spread:
        if (number, lands) not in found:
            landings = [("measurement", k, k + lands) for k in sampling.using(number).taken(path.steps)]
            sensors = {"measurement": (at_each.H, at_each.R)}
            try:
                run = along(at_each.Phi, at_each.Q, sensors, outputs.rows, P0, path.steps, landings)
            except ValueError as error:
                raise InputError(f"{option('trajectory')}: {error}") from None
            found[number, lands] = spread(run.deviations, first)
        return found[number, lands]

    no_delay = spread_of(1, 0).worst
    rows = []
    for number in every:
        using = sampling.using(number)
        for name in chosen:
            at = designs[number, name]
            if at.L is None:
                rows.append(AlongRow(name, number, using.N, None, None, None, None, at.remark))
                continue
            of = spread_of(number, at.L)
            oldest = using.oldest_ms(at.L)
            over = of.worst / no_delay - 1 if no_delay else None
            rows.append(AlongRow(name, number, using.N, at.L, of, over, oldest, at.remark))
    if all(row.spread is None for row in rows):
        raise InputError(f"no correction lands: {'; '.join(by_reason((row.method, row.remark) for row in rows))}")
    return AlongComparison(model, outputs, sampling, path.steps, first, tuple(rows), left_out)


def _lossless(asked: Sequence[str] | None) -> tuple[tuple[str, ...], tuple[str, ...]]:
    exactly = tuple(name for name, method in METHODS.items() if method.lossless)
    for name in asked or ():
        if name not in exactly:
            what = "has no accuracy along a trajectory" if name in METHODS else "is unknown here"
            raise InputError(
                f"{option('method')} {short(name)!r} {what}: choose from {', '.join(exactly)}, or leave out "
                f"{option('trajectory')}"
            )
    if asked:
        return tuple(dict.fromkeys(asked)), ()
    chosen = tuple(name for name in COMPARED if name in exactly)
    lacking = [name for name in COMPARED if name not in exactly]
    return chosen, (f"no {' and no '.join(lacking)} along a trajectory: they have a periodic regime only",)


def _initial(model: Model, sampling: Sampling, at_each: Linearised, asked: Any) -> FloatArray:
    n = model.linear.states
    if asked is not None:
        said = f"{option('initial_std')} {short(asked)}"
        parts = asked.split(",") if isinstance(asked, str) else list(asked)
        values = [float(exact(part, said)) for part in parts]
        if len(values) != n or min(values) < 0:
            raise InputError(f"{said}: give {n} numbers, 0 or more, one for each state")
        return np.diag(np.square(values))
    start = LinearModel(at_each.Phi[0], at_each.Q[0], at_each.H[0], at_each.R[0])
    over = prefix(start, sampling.N)
    P0 = steady_prior(over.Phi[sampling.N], over.Q[sampling.N], start.H, start.R)
    if not np.isfinite(P0).all():
        raise InputError(
            f"{option('initial_std')} is missing: at the first state of {option('trajectory')} the covariance does not "
            f"settle, for a state is not seen there; give the standard deviation of each of the {n} states"
        )
    return P0
