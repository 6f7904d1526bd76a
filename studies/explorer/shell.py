"""The command lines of `sched-sim` that give the figures of a design."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields

from sched_sim.design.options import Options
from sched_sim.errors import option
from sched_sim.ticks import Number, exact
from studies.explorer.planned import Planned
from studies.explorer.query import number_text
from studies.explorer.resolved import Resolved
from studies.explorer.sources import Sources
from studies.selection.methods import METHODS
from studies.selection.variants import WAYS


def lines(asked: Resolved, plan: Planned, sources: Sources) -> Iterator[list[str]]:
    """Each as its words: the costs counted, if they are; the least speed; the schedule; and the accuracy."""
    if sources.counting:
        yield ["sched-sim", "measure", *sources.counting]
    design = [*_times(asked), "--method", plan.method, *_costs(asked, sources), *_options(asked.design.options)]
    design += [] if sources.tasks is None else ["--tasks", sources.tasks]
    yield ["sched-sim", "minimum", *design]
    yield ["sched-sim", "simulate", *design, *_pace(asked, plan), "--cycles", str(asked.design.cycles)]
    yield from _accuracy(asked, plan, sources)


def _accuracy(asked: Resolved, plan: Planned, sources: Sources) -> Iterator[list[str]]:
    """What the outputs are at the landing; the latest landing that keeps what is asked, on which part."""
    design = asked.design
    if sources.model is None or design.method not in METHODS or METHODS[design.method].needs == "motion":
        return
    about = ["--model", sources.model, *([] if design.output is None else ["--output", design.output])]
    about += [*_times(asked, landing=False), "--method", plan.method]
    if plan.landed is not None:
        later = METHODS[plan.method].landing == "later"
        chosen = [name for name in ("feedback", "low_rate_noise") if later and plan.method == "dual-rate"]
        ways = [word for name in chosen for word in _option(design.options, name)]
        yield ["sched-sim", "accuracy", *about, *(["-L", str(plan.landed)] if later else []), *ways]
    if design.within is not None and sources.tasks is None and not design.options.context_switch:
        names = WAYS if plan.method == "dual-rate" else ()
        ways = [word for name in names for word in (_flag(name), str(getattr(design.options, name)))]
        others = [word for name in ("cpus", "policy") for word in _option(design.options, name)]
        within = ["--within", _text(design.within), *_named("metric", design.metric, "worst")]
        costs = ["--costs", str(sources.costs), *_named("statistic", design.statistic, "minimum")]
        yield ["sched-sim", "design", *within, *about, "--every", "1", *costs, *ways, *others]


def _times(asked: Resolved, *, landing: bool = True) -> list[str]:
    """In the units in which they were said, or a shipped model has them."""
    design, times = asked.design, asked.stated.said
    words = [] if asked.rate is None else ["--hr-hz", number_text(asked.rate)]
    by_rate, by_delay = times.measurement_hz, times.delay_ms
    words += ["-N", str(asked.stated.N)] if by_rate is None else ["--measurement-hz", number_text(by_rate)]
    if asked.stated.M is not None:
        words += ["-M", str(asked.stated.M)] if by_delay is None else ["--delay-ms", number_text(by_delay)]
    if landing and design.land_within_ms is not None:
        words += ["--land-within-ms", _text(design.land_within_ms)]
    elif landing and design.L is not None:
        words += ["-L", str(design.L)]
    return words


def _costs(asked: Resolved, sources: Sources) -> list[str]:
    words = [] if sources.costs is None else ["--costs", sources.costs]
    words += _named("statistic", asked.design.statistic, "minimum")
    return words if sources.part is None else [*words, "--processor", sources.part]


def _pace(asked: Resolved, plan: Planned) -> list[str]:
    return [] if asked.pace is None or asked.part is not None else ["--speed", number_text(plan.speed)]


def _options(options: Options) -> list[str]:
    return [word for choice in fields(Options) for word in _option(options, choice.name)]


def _option(options: Options, name: str) -> list[str]:
    """Nothing of what is as by default."""
    value = getattr(options, name)
    return [] if value == getattr(Options(), name) else [_flag(name), _text(value)]


def _named(name: str, value: str, default: str) -> list[str]:
    return [] if value == default else [_flag(name), value]


def _flag(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def _text(value: Number) -> str:
    return value if isinstance(value, str) else number_text(exact(value, option("value")))
