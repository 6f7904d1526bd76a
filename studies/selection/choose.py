"""Which filter keeps an accuracy, how late its corrections may land for it, and what processor it needs then."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from sched_sim.costs.table import INSTRUCTION, CostTable
from sched_sim.design.fit import check_shares
from sched_sim.design.methods import METHODS as SCHEDULED
from sched_sim.design.options import Options
from sched_sim.design.pieces import Statistic
from sched_sim.errors import InputError, option
from sched_sim.processors.part import Part, why_not_instructions
from sched_sim.processors.part_file import load_part, shipped_parts
from sched_sim.schedule.tasks import Task
from sched_sim.ticks import Number, positive
from studies.selection.choice import Candidate, Choice
from studies.selection.compare import Metric, check_metric, undelayed
from studies.selection.conditions import TAU_S, check_ages, check_every, check_names, chosen_methods, conditions_of
from studies.selection.considered import NOT_TRIED, considered, ordinal
from studies.selection.costs import tables_for
from studies.selection.methods import METHODS, by_reason
from studies.selection.model import load_model, shipped_defaults
from studies.selection.outputs import outputs_of
from studies.selection.parts import Parts, by_cost, too_slow
from studies.selection.question import Accuracies, Question
from studies.selection.remarks import remarks
from studies.selection.sampling import Sampling
from studies.selection.variants import candidates, kept, variants
from studies.selection.waiting import too_late


def choose_filter(
    within: Number,
    model: Any,
    output: Any = None,
    *,
    unit: str | None = None,
    N: int | None = None,
    M: int | None = None,
    hr_hz: Number | None = None,
    measurement_hz: Number | None = None,
    delay_ms: Number | None = None,
    methods: Sequence[str] | None = None,
    every: Sequence[int] = (1, 2, 3, 4),
    metric: Metric = "worst",
    motion: Sequence[Number] | str | None = None,
    tau_s: Number = TAU_S,
    processors: Sequence[str | Part] | None = None,
    costs: Sequence[str] | None = None,
    statistic: Statistic = "minimum",
    options: Options = Options(),
    tasks: Sequence[Task] = (),
) -> Choice:
    """The filters that keep the outputs within a standard deviation, and the least processor for each.

        choose_filter(0.38, "ins-gps")
        choose_filter("0.5", my_system, "position=0:3", unit="m", N=80, M=44, hr_hz=400)

    model, output, unit, N to delay_ms, motion, tau_s, metric: as in `compare_accuracy`. every: 2 tries every second
    measurement too. processors: parts by name, path or as they are, by default all that ship; costs: tables by name or
    path, by default counts for the model, in each form of the covariance update that is worth it. options: of the
    choices of the dual-rate filter those that differ from the paper's are kept to, of the others all are tried.
    tasks: with costs in seconds where there are parts, and the least speed is that of the filter alone; else, as with
    tables of no counts, in the unit of the tables, and the least speed is with them.

    Raises InputError that names what is wrong, its value and what to give; where no method keeps the accuracy, it says
    the best that there is, and how.
    """
    check_names(methods=methods, processors=processors, costs=costs)
    sampling = Sampling.of(shipped_defaults(model), N, M, hr_hz, measurement_hz, delay_ms)
    check_rate(processors, sampling)
    loaded = load_model(model, sampling.hr_hz)
    tables = tables_for(loaded, costs)
    return chosen(
        Question(
            loaded,
            outputs_of(loaded, output, unit),
            sampling,
            within_of(within),
            metric,
            conditions_of(loaded, sampling, motion, tau_s),
            tables,
            parts_for(processors, tables, sampling),
            options,
            kept(options),
            statistic,
            tasks,
        ),
        methods,
        every,
    )


def within_of(value: Number) -> float:
    """Raises InputError unless it is a number greater than 0."""
    return float(positive(value, option("within")))


def parts_for(asked: Sequence[str | Part] | None, tables: Sequence[CostTable], sampling: Sampling) -> tuple[Part, ...]:
    """All that ship if none is asked for, of instructions those that state their cycles; none where they cannot be
    looked at. Raises InputError where one that was asked for cannot be."""
    instructions = all(table.unit == INSTRUCTION for table in tables)
    if sampling.hr_hz is None or not (instructions or all(table.operations for table in tables)):
        if asked:
            raise InputError(
                f"{option('processor')} needs counted operations, and {option('costs')} {tables[0].shown} has none: "
                f"count with `sched-sim measure --backend counted -o FILE`"
            )
        return ()
    loaded = [part if isinstance(part, Part) else load_part(part) for part in asked or shipped_parts()]
    parts = tuple({part.name: part for part in loaded}.values())
    if not instructions:
        return parts
    reasons = {part.name: [why_not_instructions(table, part) for table in tables] for part in parts}
    if asked and (refused := [reason for of in reasons.values() for reason in of if reason]):
        raise InputError(refused[0])
    return tuple(part for part in parts if not any(reasons[part.name]))


def check_rate(asked: Sequence[str | Part] | None, sampling: Sampling) -> None:
    """Raises InputError for parts without a rate; before anything is counted, which may take long."""
    if asked and sampling.hr_hz is None:
        raise InputError(f"{option('processor')} without {option('hr_hz')}: give the rate of the HR loop")


def chosen(question: Question, methods: Sequence[str] | None = None, every: Sequence[int] = (1, 2, 3, 4)) -> Choice:
    """`choose_filter` of what has been looked at."""
    check_metric(question.metric)
    check_every(every)
    sampling, tables = question.sampling, question.tables
    if sampling.hr_hz is not None and question.second is not None:
        check_shares(question.tasks, sampling.hr_hz, question.second)
    wanted = chosen_methods(methods, question.conditions)
    check_ages(question.model, 2 * (sampling.using(max(every)).N + 1) + sampling.M)
    no_delay = undelayed(question.model, question.outputs, sampling, question.metric)
    names = [
        name for name in candidates(methods, tables, sampling.M) if name in wanted.methods or METHODS[name].needs == ""
    ]
    without = by_reason((name, _why_not(name, tables[0])) for name in methods or () if name not in names)
    if not names:
        has = ", ".join(name for name in tables[0].costs if name in METHODS)
        raise InputError(f"{option('method')} {'; '.join(without)}: choose from {has}")
    accuracy = Accuracies(question)
    looked = [
        considered(question, accuracy.of, variant)
        for variant in variants(names, every, tables, question.options, question.ways)
    ]
    beside = [of for of in looked if of.variant.is_beside(question.options) and of.allowed is not None]
    left = any(of.reason == NOT_TRIED or (of.L or 0) < (of.allowed or 0) for of in beside)
    looked = [of for of in looked if of.reason != NOT_TRIED]
    if all(candidate.allowed is None for candidate in looked):
        raise InputError(_out_of_reach(question, looked, no_delay))
    keeping = [candidate for candidate in looked if candidate.least is not None]
    if not keeping:
        reasons = by_reason((of.variant.method, of.reason) for of in looked if of.allowed is not None)
        raise InputError(f"{option('method')}: none of these can be had: {'; '.join(reasons)}")
    best = [_least(keeping, name) for name in names if any(of.variant.method == name for of in keeping)]
    parts = Parts(question.parts, question.statistic)
    best = sorted((_on_parts(question, accuracy, parts, candidate) for candidate in best), key=_rank)
    others = [
        min((of for of in looked if of.variant.method == name), key=_nearness)
        for name in names
        if not any(of.variant.method == name for of in keeping)
    ]
    left_out = [words for words in wanted.left_out if any(f"no {name}:" in words for name in SCHEDULED)]
    left_out += [f"no {words}" for words in without]
    left_out += [
        f"dual-rate: another schedule, by {option('lr_propagate_by')} l or {option('feedback')} same-step, may need "
        f"less: unless you give these options, they are compared only up to a landing with the next measurement, and "
        f"where no simulation is needed"
    ] * (left and not any(of.variant.is_beside(question.options) for of in best))
    choice = Choice(
        question.model,
        question.outputs,
        sampling,
        question.within,
        question.metric,
        no_delay,
        tables[0].unit,
        tuple(best),
        tuple(sorted(keeping, key=_power)),
        tuple(others),
        tuple(left_out),
    )
    return replace(choice, remarks=tuple(remarks(choice, question, accuracy)))


def with_parts(question: Question, looked: Sequence[Candidate]) -> tuple[Candidate, ...]:
    """Each of them on each part, cheapest first."""
    accuracy, parts = Accuracies(question), Parts(question.parts, question.statistic)
    return tuple(sorted((_on_parts(question, accuracy, parts, candidate) for candidate in looked), key=_rank))


def _why_not(method: str, table: CostTable) -> str:
    """Why one that was asked for is not looked at."""
    if method not in SCHEDULED:
        return (
            f"every measurement that is late is left out, so that it never corrects and no {option('within')} is kept"
        )
    return f"the cost table {table.shown} has no costs of it"


def _on_parts(question: Question, accuracy: Accuracies, parts: Parts, candidate: Candidate) -> Candidate:
    rate, variant = question.sampling.hr_hz, candidate.variant
    if rate is None or candidate.L is None:
        return candidate
    delay = 0 if METHODS[variant.method].landing == "at once" else question.sampling.M
    timing = question.sampling.using(variant.every).timing(delay, candidate.L)
    curve = accuracy.of(variant)
    looked = [
        replace(on, std=None if on.landed is None else curve.at(max(on.landed, candidate.first)))
        for on in parts.look(variant.table, variant.method, timing, rate, variant.options, question.tasks)
    ]
    if not looked:
        return candidate
    looked.sort(key=by_cost)
    reason = "" if any(on.fits for on in looked) else too_slow(looked)
    return replace(candidate, parts=tuple(looked), reason=reason)


def _out_of_reach(question: Question, looked: Sequence[Candidate], no_delay: float) -> str:
    possible = [of for of in looked if _can_be_had(question, of)] or looked
    known = [of for of in possible if not METHODS[of.variant.method].floored]
    looked = known or [_in_full(question, of) for of in possible]
    best = min(looked, key=lambda of: of.best)
    unit = f" {question.outputs.unit}" if question.outputs.unit else ""
    asked = f"{option('within')} {question.within:g}"
    if not best.best < float("inf"):
        return f"{asked}: no method has a bounded error: {best.reason}"
    names = list(dict.fromkeys(of.variant.method for of in looked if of.best == best.best))
    using = "every measurement" if best.variant.every == 1 else f"every {ordinal(best.variant.every)} measurement"
    after = question.sampling.using(best.variant.every).ms(best.first)
    when = f"L={best.first}" if after is None else f"L={best.first}, {after:g} ms after its measurement was taken"
    return (
        f"{asked}: no method reaches it; the best there is, is {question.metric} {_up(best.best)}{unit}, by "
        f"{', '.join(names)}, landing at {when}, with {using} (without delay it would be {no_delay:.6g}{unit}); allow "
        f"{option('within')} {_up(best.best)}, measure more often, shorten the delay, or take a better sensor"
    )


def _can_be_had(question: Question, candidate: Candidate) -> bool:
    """Whether the method can have such a delay at all."""
    variant = candidate.variant
    return not too_late(variant.method, question.sampling, variant.every, variant.options)


def _in_full(question: Question, candidate: Candidate) -> Candidate:
    """With the figure itself, where so far it is only known that it is more than that of a lossless method."""
    curve = Accuracies(question, whole=True).of(candidate.variant)
    return replace(candidate, best=curve.at(candidate.first))


def _up(value: float) -> str:
    """To six digits, not below it."""
    from math import ceil, floor, log10

    scale = 10.0 ** (floor(log10(value)) - 5)
    return f"{ceil(value / scale * (1 - 1e-12)) * scale:.6g}"


def _least(keeping: Sequence[Candidate], method: str) -> Candidate:
    return min((of for of in keeping if of.variant.method == method), key=_power)


def _nearness(candidate: Candidate) -> tuple[bool, float]:
    """What is known exactly goes before what is known to be out of the bound."""
    return METHODS[candidate.variant.method].floored and candidate.variant.every > 1, candidate.best


def _power(candidate: Candidate) -> tuple[Fraction, int, int]:
    """Of equals the one with the most measurements, then the one that is most as in the paper."""
    assert candidate.least is not None
    return candidate.least.speed, candidate.variant.every, candidate.variant.departures


def _rank(candidate: Candidate) -> tuple[int, Fraction, Fraction]:
    """By the price of its cheapest part; without prices by its least speed; last what no part runs."""
    assert candidate.least is not None
    on = candidate.cheapest
    if on is None:
        return (2 if candidate.parts else 1), Fraction(0), candidate.least.speed
    return (1, Fraction(0), candidate.least.speed) if on.price is None else (0, on.price, candidate.least.speed)
