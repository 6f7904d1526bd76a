"""What the command line says of random costs and delays, such as `--cost lr_update=56,61:1e-6`, `--worst 60us` and
`--delays 4:0.9,6`."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import partial
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from sched_sim.bounds import short
from sched_sim.cli import options as opt
from sched_sim.costs.table import SECONDS
from sched_sim.errors import InputError
from sched_sim.ticks import exact, positive

if TYPE_CHECKING:
    from sched_sim.probability.cost_distribution import CostDistribution
    from sched_sim.probability.stated import StatedCost

Distributions = Annotated[
    Path | None,
    typer.Option(
        "--distributions",
        help="TOML file of random costs: unit, and \\[distribution.KIND] by kind of job, with samples; or values and "
        "probabilities; or values and exceedance, as of a pWCET curve. Or the samples that `measure --filter` writes, "
        "of a filter with one sensor.",
        rich_help_panel=opt.DESIGN,
    ),
]
CostsOfJobs = Annotated[
    list[str] | None,
    typer.Option(
        "--cost",
        help="The cost of one kind of job: lr_update=56,61:1e-6 is 61 once in a million, else 56. 1..56 is each "
        "whole number up to 56. In units of the cost table, or with a unit, 56us,61us:1e-6. Repeatable, and before "
        "what a file says; all other kinds cost what the cost table says, always.",
        metavar="KIND=VALUE:PROBABILITY,...",
        rich_help_panel=opt.DESIGN,
    ),
]
Worst = Annotated[
    list[str] | None,
    typer.Option(
        "--worst",
        help="The most that one execution may ever cost, as you declare it: 60us for all kinds of job that have "
        "samples, lr_update=60us for one. What a sample has not seen is put there. Repeatable.",
        metavar="[KIND=]COST",
        rich_help_panel=opt.DESIGN,
    ),
]
Delays = Annotated[
    str | None,
    typer.Option(
        "--delays",
        help="A random delay instead of -M: 4:0.9,6 is 4 HR steps, or once in ten times 6; with --hr-hz also "
        "100ms:0.9,150ms.",
        metavar="DELAY:PROBABILITY,...",
        rich_help_panel=opt.DESIGN,
    ),
]
Dropout = Annotated[
    str | None,
    typer.Option(
        "--dropout",
        help="The probability that a measurement never arrives.",
        metavar="PROBABILITY",
        rich_help_panel=opt.DESIGN,
    ),
]

MOST_OF_A_RANGE = 10_000
_RANGE = re.compile(r"(\d+)\.\.(\d+)")
_WITH_UNIT = re.compile(r"(.*?)\s*([a-zA-Z]+)")


def stated(
    file: Path | None, costs: Sequence[str] | None, worst: Sequence[str] | None, method: str, unit: str
) -> dict[str, StatedCost]:
    """By kind of job of this method, in units of its cost table. Raises InputError for what cannot be read, and for
    kinds that the method does not have."""
    from sched_sim.probability.cost_file import read_cost_distributions

    found = {} if file is None else read_cost_distributions(file, method, unit)
    return _with_worst(found | _by_kind(costs or (), method, unit), worst or (), method, unit)


def _by_kind(costs: Sequence[str], method: str, unit: str) -> dict[str, StatedCost]:
    from sched_sim.probability.cost_file import check_kind_of_job
    from sched_sim.probability.stated import StatedCost

    found: dict[str, StatedCost] = {}
    for text in costs:
        what = f"--cost {short(text)}"
        kind, equals, numbers = text.partition("=")
        if not equals:
            raise InputError(f"{what}: give KIND=VALUE:PROBABILITY,..., such as --cost lr_update=56,61:1e-6")
        check_kind_of_job(kind, method, what)
        if kind in found:
            raise InputError(f"{what}: {kind} is given twice; leave one out")
        if whole := _RANGE.fullmatch(numbers):
            values, probabilities = _each_whole(opt.whole(whole[1]), opt.whole(whole[2]), what)
        else:
            values, probabilities = _weighted(numbers, what, partial(_cost, unit=unit, what=what))
        found[kind] = StatedCost(values, probabilities, source=what)
    return found


def _with_worst(costs: Mapping[str, StatedCost], worst: Sequence[str], method: str, unit: str) -> dict[str, StatedCost]:
    """Raises InputError for a worst case below a sample, and for one of what has no samples."""
    from sched_sim.probability.cost_file import check_kind_of_job

    found = dict(costs)
    for text in worst:
        what = f"--worst {short(text)}"
        named, equals, cost = text.rpartition("=")
        if equals:
            check_kind_of_job(named, method, what)
        kinds = [kind for kind, one in costs.items() if one.is_sample and (kind == named or not equals)]
        if not kinds:
            raise InputError(
                f"{what}: {named or 'no kind of job'} has {'no ' if equals else ''}samples, of which it could say what "
                f"they have not seen: leave it out, or give samples with --distributions"
            )
        most = _cost(cost, unit, what)
        for kind in kinds:
            found[kind] = replace(found[kind], worst=most, source=f"{what}, {kind}, in {unit}")
    return {kind: replace(cost, source=costs[kind].source) for kind, cost in found.items()}


def random_delays(
    text: str | None, M: int | None, delay_ms: str | None, rate: Fraction | None
) -> CostDistribution | None:
    """In HR steps, those in ms rounded up. M, delay_ms: what other options say of the delay."""
    if text is None:
        return None
    from sched_sim.probability.cost_distribution import CostDistribution
    from sched_sim.probability.stated import wrong_probabilities

    what = f"--delays {short(text)}"
    if M is not None or delay_ms is not None:
        other = f"-M {M}" if delay_ms is None else f"--delay-ms {delay_ms}"
        raise InputError(f"{what} and {other} exclude each other: leave out the one that is wrong")
    values, probabilities = _weighted(text, what, partial(_steps, rate=rate, what=what))
    if wrong := wrong_probabilities(probabilities):
        raise InputError(f"{what}: {wrong}")
    return CostDistribution.of_weights(
        (value, float(share)) for value, share in zip(values, probabilities, strict=True) if share
    )


def lost(text: str | None) -> float:
    """The probability that a measurement never arrives."""
    from sched_sim.probability.stated import probability

    share = Fraction(0) if text is None else probability(text, "--dropout")
    if not 0 <= share < 1:
        raise InputError(f"--dropout {text} must be from 0 to less than 1: it is a probability, 10 % is 0.1")
    return float(share)


def _weighted(text: str, what: str, number: Callable[[str], Fraction]) -> tuple[list[Fraction], list[Fraction]]:
    """VALUE:PROBABILITY,...; one may have no probability, and gets the rest."""
    from sched_sim.probability.stated import probability, with_the_rest

    values: list[Fraction] = []
    said: list[Fraction | None] = []
    for entry in text.split(","):
        value, colon, share = map(str.strip, entry.partition(":"))
        values.append(number(value))
        said.append(probability(share, f"{what}: the probability of {value}") if colon else None)
    return values, with_the_rest(said, what)


def _each_whole(first: int, last: int, what: str) -> tuple[list[Fraction], list[Fraction]]:
    """Each whole number from the first to the last, equally likely."""
    count = last - first + 1
    if not 0 < count <= MOST_OF_A_RANGE:
        raise InputError(f"{what}: give a range such as 1..54, of at most {MOST_OF_A_RANGE:,} numbers")
    return [Fraction(value) for value in range(first, last + 1)], [Fraction(1, count)] * count


def _cost(text: str, unit: str, what: str) -> Fraction:
    """In units of the cost table; with a unit where that is one of time."""
    found = _WITH_UNIT.fullmatch(text)
    if found is None:
        return positive(text, what)
    number, suffix = found.groups()
    if suffix not in SECONDS:
        raise InputError(
            f"{what}: {short(text)!r} is no cost: give a number, with {', '.join(SECONDS)} or no unit behind it"
        )
    if unit not in SECONDS:
        raise InputError(
            f"{what}: {short(text)} is a time, and costs are in units of {unit} here: give --costs a table of times, "
            f"or --processor, or the number of these units"
        )
    return positive(number, what) * SECONDS[suffix] / SECONDS[unit]


def _steps(text: str, rate: Fraction | None, what: str) -> Fraction:
    number = text.removesuffix("ms").strip()
    delay = exact(number, what)
    if delay < 0:
        raise InputError(f"{what}: {short(text)} is negative: no measurement arrives before it is taken")
    if number != text:
        if rate is None:
            raise InputError(f"{what}: {short(text)} without --hr-hz: give the rate of the HR loop, or HR steps")
        return Fraction(ceil(delay * rate / 1000))
    if delay.denominator > 1:
        raise InputError(f"{what}: {short(text)} is no whole number of HR steps: round it up, or give ms")
    return delay
