"""All that is known of one design, as plain data: what the explorer shows."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from sched_sim.errors import InputError
from studies.explorer.choices import Choices, choices_of
from studies.explorer.design import Design
from studies.explorer.document import document
from studies.explorer.given import Given
from studies.explorer.limits import Limits, limits
from studies.explorer.methods import MethodView, Planned, binding_words, method_view, planned, refused_view
from studies.explorer.power import Power, machine_name, power_of
from studies.explorer.query import number_text, query_of, texts
from studies.explorer.resolved import Resolved, resolved
from studies.explorer.schedule import Timeline, timeline


@dataclass(frozen=True, slots=True)
class Current:
    """The design itself. least: the least speed, in cost units per HR period, power: that as a power; speed: that it
    runs at, in words runs_at, pace: that as a power. achieved_l: where corrections land then, std: the figure of the
    output there, std_at_L: at the L that was asked for, both in `unit`; load: share of the time of the processors;
    misses: in the schedule that is shown; fits: None where it runs at its least speed."""

    least: Fraction
    power: float
    binding: str
    speed: Fraction
    runs_at: str
    pace: float
    achieved_l: int | None
    landed_ms: float | None
    std: float | None
    std_at_L: float | None
    unit: str
    load: Fraction
    misses: int
    fits: bool | None


@dataclass(frozen=True, slots=True)
class View:
    """What `explore` returns; `document` makes JSON of it. Fractions are exact; powers are floats in `power.unit`;
    lists are columns; None is what is not known or not there."""

    query: str
    design: dict[str, Any]
    choices: Choices
    limits: Limits
    period_ms: float | None
    power: Power
    answer: Any
    warnings: tuple[str, ...]
    notes: tuple[str, ...]
    current: Current
    schedule: Timeline
    methods: tuple[MethodView, ...]
    parts: Any
    commands: Any

    def document(self) -> dict[str, Any]:
        """Plain data: objects, lists, numbers, text and None."""
        found: dict[str, Any] = document(self)
        del found["power"]["per_unit"]
        return found


def explore(design: Design, given: Given = Given()) -> View:
    """All that is known of one design: its schedule, each method's least speed and landing, accuracy and parts.

        explore(Design(N=10, M=4, L=8))
        explore(Design(hr_hz=400, measurement_hz=5, delay_ms=110, model="ins-gps", within="0.4"))

    given: what was loaded beside what ships, by the names that the design has for it.

    Raises InputError that names what is wrong, its value and what to give.
    """
    asked = resolved(design, given)
    current = planned(asked, design.method)
    power = power_of(asked)
    period_ms = None if asked.rate is None else float(1000 / asked.rate)
    shown = timeline(
        current.costs, current.timing, current.speed, design.cycles, design.options, asked.tasks, period_ms
    )
    return View(
        query_of(design),
        _said(asked, current),
        choices_of(asked),
        limits(asked),
        period_ms,
        power,
        None,
        (),
        tuple(filter(None, asked.stated.words.split("\n"))),
        _current(asked, current, power, shown.misses),
        shown,
        tuple(_method(asked, method, current, power) for method in asked.methods),
        (),
        None,
    )


def _method(asked: Resolved, method: str, current: Planned, power: Power) -> MethodView:
    try:
        plan = current if method == current.method else planned(asked, method)
        return method_view(asked, plan, power)
    except InputError as error:
        return refused_view(asked, method, error)


def _current(asked: Resolved, plan: Planned, power: Power, misses: int) -> Current:
    return Current(
        plan.least.speed,
        power.of(plan.least.speed),
        binding_words(plan.least.binding),
        plan.speed,
        _runs_at(asked, plan),
        power.of(plan.speed),
        plan.landed,
        asked.sampling.ms(plan.landed),
        None,
        None,
        "" if asked.outputs is None else asked.outputs.unit,
        plan.load,
        misses,
        None if asked.pace is None else plan.fits,
    )


def _runs_at(asked: Resolved, plan: Planned) -> str:
    if asked.design.speed is not None:
        return number_text(plan.speed)
    return "least speed" if asked.machine_pace is None else machine_name(asked)


def _said(asked: Resolved, plan: Planned) -> dict[str, Any]:
    """Every key of a query, with what the design comes to."""
    times, rate = asked.sampling.times, asked.rate
    N, M, L = asked.sampling.N, asked.sampling.M, plan.timing.L if asked.stated.L is None else asked.stated.L
    table = asked.counts.name if asked.counts.name in asked.given.table_names else None
    lands = None if times is None or rate is None else times.landing_ms(L, rate)
    shipped = None if asked.model is None else asked.model.shipped
    full = replace(
        asked.design,
        hr_hz=rate,
        measurement_hz=None if times is None else times.measurement_hz,
        delay_ms=None if times is None else times.delay_ms,
        land_within_ms=lands if asked.design.land_within_ms is None else asked.design.land_within_ms,
        costs=asked.design.costs or table,
        output=asked.design.output or (shipped and shipped.output),
    )
    return {**texts(full), "N": N, "M": M, "L": L, "cycles": full.cycles, "cpus": full.options.cpus}
