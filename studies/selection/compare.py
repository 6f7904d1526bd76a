"""The accuracy of each method at the output, side by side."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot
from typing import Any, Literal, TypeAlias

from filters.accuracy.exact import lossless
from filters.accuracy.outcome import Accuracy
from sched_sim.bounds import short
from sched_sim.design.options import Options
from sched_sim.errors import InputError, option
from sched_sim.html_table import html_table
from sched_sim.plain_table import plain_table
from sched_sim.ticks import Number
from studies.selection.conditions import (
    TAU_S,
    Conditions,
    check_ages,
    check_every,
    check_names,
    chosen_methods,
    conditions_of,
    settling,
)
from studies.selection.landing import Landed, Processor, landed
from studies.selection.methods import METHODS, Asked, by_reason
from studies.selection.model import Model, load_model, shipped_defaults
from studies.selection.outputs import Outputs, outputs_of
from studies.selection.sampling import Sampling
from studies.selection.waiting import too_irregular, too_late

Metric: TypeAlias = Literal["worst", "rms"]


@dataclass(frozen=True, slots=True)
class AccuracyRow:
    """One method with every so manieth measurement.

    N: steps between those measurements. accuracy: None where the method does not land, or its regime is none. over: by
    how much its figure is above that of the filter without delay that uses every measurement, 0.04 is 4 %.
    reaction_ms, oldest_ms: of `Accuracy.L` and `Accuracy.oldest`, None without a rate. remark: why there is no
    accuracy, or what was not looked at.
    """

    method: str
    every: int
    N: int
    accuracy: Accuracy | None
    over: float | None
    reaction_ms: float | None
    oldest_ms: float | None
    remark: str = ""


@dataclass(frozen=True, repr=False)
class Comparison:
    """rows: by how many measurements are used, then by method. no_delay: the figure of the filter without delay that
    uses every measurement, a standard deviation in the unit of the outputs. left_out: methods that were not asked for
    and lack something, and what."""

    model: Model
    outputs: Outputs
    sampling: Sampling
    metric: Metric
    no_delay: float
    rows: tuple[AccuracyRow, ...]
    left_out: tuple[str, ...] = ()

    def __repr__(self) -> str:
        remarks = by_reason((row.method, row.remark) for row in self.rows)
        rows = [(*_cells(row)[:-1], row.accuracy.verdict if row.accuracy else "does not land") for row in self.rows]
        return plain_table(self._caption, HEADINGS, rows, [*remarks, *self.left_out])

    def _repr_html_(self) -> str:
        return html_table(self._caption, HEADINGS, [_cells(row) for row in self.rows])

    @property
    def _caption(self) -> str:
        unit = f", {self.outputs.unit}" if self.outputs.unit else ""
        return f"{self.model.name}: standard deviation of {self.outputs.name}{unit}"


HEADINGS = ("method", "every", "N", "lands at", "oldest age", "worst", "rms", "jump", "bias", "verdict")


def _cells(row: AccuracyRow) -> tuple[Any, ...]:
    of = row.accuracy
    if of is None:
        return (row.method, row.every, row.N, *[None] * 6, row.remark)
    return row.method, row.every, row.N, of.L, of.oldest, of.worst, of.rms, of.jump, of.bias, of.verdict


def compare_accuracy(
    model: Any,
    output: Any = None,
    *,
    unit: str | None = None,
    N: int | None = None,
    M: int | None = None,
    hr_hz: Number | None = None,
    measurement_hz: Number | None = None,
    delay_ms: Number | None = None,
    L: int | None = None,
    methods: Sequence[str] | None = None,
    every: Sequence[int] = (1,),
    motion: Sequence[Number] | str | None = None,
    tau_s: Number = TAU_S,
    metric: Metric = "worst",
    options: Options = Options(),
) -> Comparison:
    """How accurate each method is at the outputs, exactly, with a measurement every N steps that is M steps late.

        compare_accuracy("ins-gps")
        compare_accuracy(my_system, "0:3", N=80, M=44, hr_hz=400, every=[1, 2])

    model: the name of a shipped one, whose output, rate, interval and delay are meant where none is given;
    "module:function"; a `filters.System`, (System, typical state), or a `filters.accuracy.LinearModel`.
    output: "position=0:3", the numbers of states, or rows (o, n); unit: its unit.
    L: where the corrections of methods land that may spread them, by default as late as may be.
    every: 2 uses every second measurement. motion: in units of the measurements a second, for fuse-as-fresh.
    tau_s: of PX4's output predictor. options: its `low_rate_noise` and `feedback` count.

    Raises InputError that names what is wrong, its value and what to give.
    """
    check_names(methods=methods)
    asked = Sampling.of(shipped_defaults(model), N, M, hr_hz, measurement_hz, delay_ms)
    loaded = load_model(model, asked.hr_hz)
    outputs = outputs_of(loaded, output, unit)
    return compared(
        loaded,
        outputs,
        asked,
        L=L,
        methods=methods,
        every=every,
        motion=motion,
        tau_s=tau_s,
        metric=metric,
        options=options,
    )


def compared(
    model: Model,
    outputs: Outputs,
    sampling: Sampling,
    *,
    L: int | None = None,
    methods: Sequence[str] | None = None,
    every: Sequence[int] = (1,),
    motion: Sequence[Number] | str | None = None,
    tau_s: Number = TAU_S,
    metric: Metric = "worst",
    options: Options = Options(),
    processor: Processor | None = None,
) -> Comparison:
    """`compare_accuracy` of what has been looked at. processor: where corrections land as it lets them."""
    check_metric(metric)
    check_every(every)
    conditions = conditions_of(model, sampling, motion, tau_s)
    chosen = chosen_methods(methods, conditions)
    check_ages(model, sampling.using(max(every)).N + 1 + max(L or 0, sampling.M))
    no_delay = undelayed(model, outputs, sampling, metric)
    rows = []
    for number in every:
        using = sampling.using(number)
        for name in chosen.methods:
            late = too_late(name, sampling, number, options) or too_irregular(name, using, options)
            at = Landed(None, late) if late else landed(name, using.N, using.M, L, options, processor)
            of, remark = _accuracy(model, outputs, using, name, at, options, conditions)
            rows.append(_row(name, number, using, of, remark, no_delay, metric))
    if all(row.accuracy is None for row in rows):
        reasons = "; ".join(by_reason((row.method, row.remark) for row in rows))
        faster = (
            "" if processor is None else f"; give a faster processor, or use fewer measurements, {option('every')} 2"
        )
        raise InputError(f"no correction lands: {reasons}{faster}")
    return Comparison(model, outputs, sampling, metric, no_delay, tuple(rows), chosen.left_out)


def figure(accuracy: Accuracy, metric: Metric) -> float:
    """With the bias, as if it were the same in each step where the metric is rms."""
    return accuracy.total if metric == "worst" else hypot(accuracy.rms, accuracy.bias)


def undelayed(model: Model, outputs: Outputs, sampling: Sampling, metric: Metric) -> float:
    """The figure of the filter without delay that uses every measurement."""
    with settling(sampling):
        return figure(lossless(model.linear, outputs.rows, sampling.between, 0), metric)


def check_metric(metric: Any) -> None:
    """Raises InputError unless it is one."""
    if metric not in ("worst", "rms"):
        raise InputError(f"{option('metric')} {short(metric)!r} is unknown: give worst or rms")


def _accuracy(
    model: Model,
    outputs: Outputs,
    using: Sampling,
    name: str,
    at: Landed,
    options: Options,
    conditions: Conditions,
) -> tuple[Accuracy | None, str]:
    if at.L is None:
        return None, at.remark
    asked = Asked(
        model.linear,
        outputs.rows,
        using.between,
        using.M,
        at.L,
        options.low_rate_noise,
        conditions.displacement,
        conditions.pull,
    )
    try:
        return METHODS[name].accuracy(asked), at.remark
    except ValueError as error:
        return None, str(error)


def _row(
    name: str, every: int, using: Sampling, of: Accuracy | None, remark: str, no_delay: float, metric: Metric
) -> AccuracyRow:
    if of is None:
        return AccuracyRow(name, every, using.N, None, None, None, None, remark)
    over = figure(of, metric) / no_delay - 1 if no_delay else None
    return AccuracyRow(
        name, every, using.N, of, over, using.ms(of.L), of.L if of.L is None else using.oldest_ms(of.L), remark
    )
