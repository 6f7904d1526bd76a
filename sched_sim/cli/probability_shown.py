"""What `sched-sim probability` prints: the sentence that answers, tables, JSON and CSV."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import fsum
from typing import TYPE_CHECKING, Any, NamedTuple

from sched_sim.cli.output import lines, print_csv, print_json, print_table
from sched_sim.cli.probability_said import constants, in_long_run, independence, left_open, sentence
from sched_sim.costs.autocorrelation import doubtful
from sched_sim.probability.outcome import Bounds
from sched_sim.probability.responses import LEVELS, exceeded_at_most, period_in
from sched_sim.probability.words import NOT_RESOLVED, at_most, chance
from sched_sim.text import visible_lines

if TYPE_CHECKING:
    from sched_sim.costs.table import CostTable
    from sched_sim.processors.part import Part
    from studies.probability.answer import Answer, Figure
    from studies.probability.question import Question

FEW = 12
"""So many landings have a row of their own."""
ROUNDING = 1e-9
"""What a sum of probabilities leaves of 1 is not told apart from 0 below."""


class About(NamedTuple):
    """What was asked and found. rate: in Hz; words: what times became in steps."""

    found: Answer
    table: CostTable
    rate: Fraction | None
    part: Part | None
    words: str


def show(about: About) -> None:
    found, unit = about.found, about.table.unit
    print(visible_lines(sentence(found)))
    note = lines(
        *_bounds_note(found),
        *left_open(found, unit),
        *independence(found),
        *constants(found.question, about.table, unit),
        about.words,
    )
    print_table(_title(about), [_row(found.question, figure) for figure in _shown(found)], note)
    when = "in the long run" if found.given.long_run else f"in cycle {found.question.cycles:,}"
    title = f"Response times {when}, in {period_in(about.rate)[1]}, exceeded with a probability of at most"
    print_table(title, _responses(about))


def _title(about: About) -> str:
    asked = about.found.question
    where = f"at speed {float(asked.speed):.6g}" if about.part is None else f"on {about.part.title}"
    delay = f"M={asked.timing.M}" if asked.delays is None else f"M={asked.timing.M} to {asked.latest.M}"
    return f"{asked.method}, N={asked.timing.N} {delay} L={asked.timing.L}, {where}"


def _shown(found: Answer) -> list[Figure]:
    """The last landings as one."""
    landings = found.landings
    own = landings if len(landings) <= FEW else landings[: FEW - 1]
    rest = landings[len(own) :]
    misses = [figure for figure in found.misses if figure.what != "lr_update missed"]
    return [
        *misses,
        found.late,
        *own,
        *([_together(f"lands after {own[-1].what.split(' at ')[1]}", own, rest, 1 - found.given.lost)] if rest else []),
    ]


def _together(what: str, before: Sequence[Figure], figures: Sequence[Figure], arrive: float) -> Figure:
    """One figure of the last ones, which are no more than what arrives and does not land before."""

    def total(sooner: Sequence[Bounds], later: Sequence[Bounds]) -> Bounds:
        lower, most = (fsum(bounds[side] for bounds in later) for side in (0, 1))
        left = arrive - fsum(bounds.lower for bounds in sooner)
        return Bounds(lower, max(lower, min(most, left)) if left > ROUNDING else min(most, 1.0))

    def long_run(each: Sequence[Figure]) -> list[Bounds]:
        return [figure.long_run for figure in each if figure.long_run is not None]

    return figures[0]._replace(
        what=what,
        first=total([figure.first for figure in before], [figure.first for figure in figures]),
        last=total([figure.last for figure in before], [figure.last for figure in figures]),
        long_run=total(long_run(before), long_run(figures)) if long_run(figures) else None,
    )


def _row(asked: Question, figure: Figure) -> dict[str, Any]:
    floor, cycles = figure.floor, asked.cycles
    row: dict[str, Any] = {"probability of": figure.what, "per": figure.per}
    if cycles > 1:
        row[f"first {cycles:,} cycles, mean"] = _cell(chance(figure.first, floor))
    row[f"cycle {cycles:,}"] = _cell(chance(figure.last, floor))
    row["long run"] = None if figure.long_run is None else _cell(in_long_run(figure))
    if any(cost.worst is not None for cost in asked.samples.values()):
        row["with unseen, at most"] = None if figure.bound is None else at_most(figure.bound)
    return row


def _cell(said: str) -> str:
    """Below which it is not resolved is said below the table."""
    return said if not said.startswith(NOT_RESOLVED) else NOT_RESOLVED


def _bounds_note(found: Answer) -> list[str]:
    given, asked = found.given, found.question
    notes = []
    if not given.exact:
        notes.append(
            f"Lower and upper bounds: costs are rounded to {given.ticks:,} parts of an HR period, down and up; more "
            f"--bins bring them closer"
        )
    if given.long_run is None:
        notes.append(f"No long run: {given.why_no_long_run}")
    if found.not_followed > found.late.last.lower:
        notes.append(
            f"Further behind than is followed with a probability of at most {at_most(found.not_followed)}: that is in "
            f"every upper bound, and may land at an L that has no row"
        )
    if given.lost:
        share = chance(Bounds(given.lost, given.lost))
        notes.append(f"A measurement never arrives with probability {share}, and lands nowhere")
    miss = found.any_hr_miss
    if asked.cycles > 1 and miss.upper and miss.upper > found.any_floor:
        notes.append(
            f"One HR deadline or more missed in the first {asked.cycles:,} cycles: at most {at_most(miss.upper)}, the "
            f"sum over {asked.cycles * asked.timing.N:,} HR jobs"
        )
    return notes


def _responses(about: About) -> list[dict[str, Any]]:
    found = about.found
    ticks = found.given.ticks
    scale, _ = period_in(about.rate)
    rows = []
    for kind, tail in sorted(found.given.settled.responses.items(), key=lambda response: response[0] != "hr"):
        floor = found.resolution.of(kind)
        row: dict[str, Any] = {"job": kind}
        for level in LEVELS:
            time = exceeded_at_most(tail, level, ticks)
            said = "longer" if time is None else f"{scale * float(time):.4g}"
            row[f"{level:.0e}".replace("e-0", "e-")] = NOT_RESOLVED if level < floor else said
        rows.append(row)
    return rows


def print_rows(about: About) -> None:
    """CSV: a row for each probability."""
    print_csv([_about(about) | _flat(figure) for figure in about.found.figures])


def _flat(figure: Figure) -> dict[str, Any]:
    row: dict[str, Any] = {"probability_of": figure.what, "per": figure.per}
    for when, bounds in (("first", figure.first), ("last", figure.last), ("long_run", figure.long_run)):
        known = bounds_document(bounds, figure.floor) or dict.fromkeys(("least", "most", "impossible"))
        row |= {f"{when}_{name}": value for name, value in known.items()}
    return row | _left_open_document(figure)


def _about(about: About) -> dict[str, Any]:
    asked = about.found.question
    return {
        "method": asked.method,
        "N": asked.timing.N,
        "M": asked.timing.M,
        "L": asked.timing.L,
        "speed": float(asked.speed),
        "speed_exact": str(asked.speed),
        "cost_unit": about.table.unit,
        "processor": None if about.part is None else about.part.name,
        "hr_hz": None if about.rate is None else float(about.rate),
        "cycles": asked.cycles,
    }


def print_document(about: About) -> None:
    """JSON."""
    found = about.found
    given, blocks, miss = found.given, found.blocks, found.any_hr_miss
    print_json(
        {
            "sentence": sentence(found),
            **_about(about),
            "exact": given.exact,
            "ticks": given.ticks,
            "lost": given.lost,
            "no_long_run": given.why_no_long_run or None,
            "probabilities": {figure.what: _document(figure) for figure in found.figures},
            "any_hr_miss_in_first_cycles": bounds_document(miss, found.any_floor),
            "responses_periods": _response_document(found),
            "samples": {kind: _sample(found, kind) for kind in found.question.samples},
            "blocks": None
            if blocks is None
            else {
                "lengths": blocks.lengths,
                "cycles": blocks.cycles,
                "hr_missed": blocks.missed.document,
                "late": blocks.late.document,
            },
            "constant": {kind: float(found.question.costs[kind].largest) for kind in found.question.constant},
        }
    )


def _document(figure: Figure) -> dict[str, Any]:
    return {
        "per": figure.per,
        "first": bounds_document(figure.first, figure.floor),
        "last": bounds_document(figure.last, figure.floor),
        "long_run": bounds_document(figure.long_run, figure.floor),
        **_left_open_document(figure),
    }


def _left_open_document(figure: Figure) -> dict[str, float | bool | None]:
    """By samples. The last two are None where there is no bound; 0 is impossible, at the declared worst cases."""
    return {
        "resolved_above": figure.floor or None,
        "with_unseen_most": figure.bound,
        "with_unseen_impossible": None if figure.bound is None else not figure.bound,
    }


def bounds_document(bounds: Bounds | None, floor: float) -> dict[str, Any] | None:
    """least: None where nothing but an upper bound is known, and where it is impossible."""
    if bounds is None:
        return None
    lower, upper = bounds
    if floor and not floor < lower <= 1 - floor:
        return {"least": max(lower - floor, 0.0) or None, "most": min(upper + floor, 1.0), "impossible": False}
    return {"least": lower or None, "most": upper, "impossible": not upper}


def _response_document(found: Answer) -> dict[str, dict[str, float | None]]:
    """By kind of job and probability; None where longer ones are as likely, or that is not resolved."""
    document: dict[str, dict[str, float | None]] = {}
    for kind, tail in found.given.settled.responses.items():
        document[kind] = {}
        for level in LEVELS:
            time = exceeded_at_most(tail, level, found.given.ticks)
            resolved = level >= found.resolution.of(kind)
            document[kind][f"{level:g}"] = float(time) if resolved and time is not None else None
    return document


def _sample(found: Answer, kind: str) -> dict[str, Any]:
    cost, correlation = found.question.costs[kind], found.correlations.get(kind)
    return {
        "n": len(cost.values),
        "largest": float(cost.largest),
        "unseen_most": found.question.unseen(kind),
        "worst": None if cost.worst is None else float(cost.worst),
        "rank_autocorrelation": correlation,
        "independence_doubtful": None if correlation is None else doubtful(correlation),
    }
