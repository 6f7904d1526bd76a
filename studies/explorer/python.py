"""The lines of Python that give the figures of a design."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields
from fractions import Fraction
from typing import Any

from sched_sim.costs.table import SECONDS
from sched_sim.design.options import Options
from studies.explorer.planned import Planned
from studies.explorer.query import number_text
from studies.explorer.resolved import Resolved
from studies.explorer.sources import Sources
from studies.selection.methods import METHODS


def lines(asked: Resolved, plan: Planned, sources: Sources) -> Iterator[str]:
    """Imports, what the design is of, and what it comes to."""
    made = [*_made(asked, plan, sources)]
    printed = [*_printed(asked, plan, sources)]
    text = "\n".join((*made, *printed))
    yield from (f"from {module} import {', '.join(used)}" for module, names in NAMES.items()
                if (used := [name for name in names if f"{name}(" in text or f"{name}." in text]))  # fmt: skip
    yield from made
    yield from printed


NAMES = {
    "fractions": ("Fraction",),
    "filters.systems.example": ("example_system",),
    "sched_sim": ("Options", "Times", "Timing", "least_speed", "load_costs", "load_part", "on_part", "read_tasks",
                  "select", "simulate"),
    "studies": ("compare_accuracy", "measure"),
}  # fmt: skip
"""That may be used, by module."""


def _made(asked: Resolved, plan: Planned, sources: Sources) -> Iterator[str]:
    if _options(asked):
        chosen = ", ".join(_options(asked))
        yield f"options = Options({chosen})"
    if sources.tasks is not None:
        unit, rate = asked.table.unit, asked.rate
        scale = SECONDS.get(unit)
        about = {"hr_hz": rate, "unit_s": scale, "cost_unit": unit}
        known = "".join(f", {name}={_literal(value)}" for name, value in about.items() if value is not None)
        yield f"tasks = read_tasks({sources.tasks!r}{known})"
    table = _table(asked, sources)
    if sources.part is not None:
        table = f"on_part({table}, load_part({sources.part!r}))"
    chosen = ", options" if _options(asked) else ""
    if asked.design.statistic != "minimum":
        chosen += f", statistic={asked.design.statistic!r}"
    yield f"costs, timing = select({table}, {plan.method!r}{chosen}), {_timing(asked, plan)}"


def _printed(asked: Resolved, plan: Planned, sources: Sources) -> Iterator[str]:
    more = ", options=options" if _options(asked) else ""
    beside = more if sources.tasks is None else f"{more}, tasks=tasks"
    speed, cycles = _literal(plan.speed), asked.design.cycles
    yield f"schedule = simulate(costs, timing, {speed}, {cycles}{beside})"
    yield f"print(least_speed(costs, timing{beside}), schedule.achieved, schedule.misses)"
    method = METHODS.get(plan.method)
    if sources.model is None or plan.landed is None or method is None or method.needs == "motion":
        return
    times = asked.stated.said
    steps = {
        "hr_hz": asked.rate,
        "N": None if times.measurement_hz is not None else asked.stated.N,
        "measurement_hz": times.measurement_hz,
        "M": None if times.delay_ms is not None else asked.stated.M,
        "delay_ms": times.delay_ms,
        "L": plan.landed if method.landing == "later" else None,
    }
    known = "".join(f", {name}={_literal(value)}" for name, value in steps.items() if value is not None)
    output = "" if asked.design.output is None else f", {asked.design.output!r}"
    yield f"print(compare_accuracy({sources.model!r}{output}{known}, methods=[{plan.method!r}]{more}))"


def _table(asked: Resolved, sources: Sources) -> str:
    if sources.counting and asked.model is not None and asked.model.system is None:
        sizes = ", ".join(map(str, asked.model.sizes))
        return f'measure(example_system({sizes}), "counted", name={asked.counts.name!r})'
    return f"load_costs({sources.costs or asked.counts.name!r})"


def _timing(asked: Resolved, plan: Planned) -> str:
    timing, times, rate = plan.timing, asked.stated.times, asked.rate
    steps = f"{timing.N}, {timing.M}, {timing.L}"
    if timing.instants is None or times is None or rate is None:
        return f"Timing({steps})"
    at = _literal(rate) if rate.denominator == 1 else f"Fraction({_literal(rate)})"
    return f"Timing({steps}, Times.of({_literal(times.measurement_hz)}, {_literal(times.delay_ms)}).instants({at}))"


def _options(asked: Resolved) -> list[str]:
    """Those that are not as by default, as arguments."""
    options, default = asked.design.options, Options()
    return [
        f"{choice.name}={_literal(getattr(options, choice.name))}"
        for choice in fields(Options)
        if getattr(options, choice.name) != getattr(default, choice.name)
    ]


def _literal(value: Any) -> str:
    """Numbers exactly."""
    if isinstance(value, Fraction):
        return str(value) if value.denominator == 1 else repr(number_text(value))
    return repr(value)
