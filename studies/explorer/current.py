"""The design itself, beside all others: what it needs, how it runs, what it is worth."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from sched_sim.design.fit import busy_share
from studies.explorer.accuracy import Accuracy
from studies.explorer.methods import binding_words
from studies.explorer.planned import Planned
from studies.explorer.power import Power, machine_name
from studies.explorer.query import number_text, texts
from studies.explorer.resolved import Resolved


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


def current_of(asked: Resolved, plan: Planned, power: Power, figures: Accuracy | None, misses: int) -> Current:
    return Current(
        plan.least.speed,
        power.of(plan.least.speed),
        binding_words(plan.least.binding),
        plan.speed,
        _runs_at(asked, plan),
        power.of(plan.speed),
        plan.landed,
        asked.sampling.ms(plan.landed),
        None if figures is None else figures.at(plan.landed),
        None if figures is None else figures.at(plan.timing.L),
        "" if asked.outputs is None else asked.outputs.unit,
        busy_share(plan.costs, plan.timing, plan.speed, asked.design.options, asked.tasks),
        misses,
        None if asked.pace is None else plan.fits,
    )


def _runs_at(asked: Resolved, plan: Planned) -> str:
    if asked.design.speed is not None:
        return number_text(plan.speed)
    return "least speed" if asked.machine_pace is None else machine_name(asked)


def said_of(asked: Resolved, plan: Planned) -> dict[str, Any]:
    """Every key of a query, with what the design comes to."""
    times, rate = asked.sampling.times, asked.rate
    N, M, L = asked.sampling.N, asked.sampling.M, asked.asked_L(plan.method)
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
