"""What a designer should be told of a choice: what the same part does better, what leaving measurements out costs."""

from __future__ import annotations

from collections.abc import Iterator

from filters.accuracy.pattern import repeats_soon
from sched_sim.errors import option
from sched_sim.rounding import percent_up
from studies.selection.choice import Candidate, Choice
from studies.selection.question import Accuracies, Question

BOUND = (
    "standard deviations are bounds, no less than the true ones: the intervals between measurements repeat too late to "
    "look at each, so any order of the shorter and the longer is allowed for"
)


def remarks(choice: Choice, question: Question, accuracy: Accuracies) -> Iterator[str]:
    """Lines, most telling first."""
    yield from _no_part(choice)
    for candidate in choice.best:
        yield from _lands_earlier(choice, candidate)
    if any(not repeats_soon(question.sampling.using(of.variant.every).between) for of in choice.best):
        yield BOUND
    first = choice.best[0] if choice.best else None
    if first is not None:
        yield from _leaving_out(question, accuracy, first)


def _no_part(choice: Choice) -> Iterator[str]:
    """What would help where no part runs any of them."""
    looked = [(of, on) for of in choice.best for on in of.parts[:1] if on.needed is not None]
    if not looked or any(of.cheapest for of, _ in looked):
        return
    of, on = min(looked, key=lambda pair: pair[1].needed or 0)
    assert on.needed is not None
    none, faster = "no part will do", f"leave {option('costs')} out for the parts that ship"
    if on.part is None:
        none = "none fits"
    else:
        faster = (
            f"name a faster one with {option('processor')} (see `sched-sim processors`), leave {option('processor')} "
            f"out for all that ship"
        )
    yield (
        f"{none}: {on.name} would need {percent_up(on.needed)} of its speed, with {of.variant.method}; {faster}, give "
        f"a slower {option('hr_hz')}, or use fewer measurements and allow more {option('within')}"
    )


def _lands_earlier(choice: Choice, candidate: Candidate) -> Iterator[str]:
    """The same part lands at 29 of the 80 that are allowed; more may be, than make a difference or it can have."""
    on, L = candidate.cheapest, candidate.L
    if on is None:
        landed, std, where = candidate.landed, candidate.landed_std, "at its least speed it"
    else:
        landed, std, where = on.landed, on.std, f"the same {'machine' if on.part is None else on.name}"
    if landed is None or std is None or L is None or landed >= L:
        return
    most = f"{L} or more" if candidate.allowed is not None and candidate.allowed > L else f"{L}"
    yield f"{candidate.variant.method}: {where} lands at {landed} of the {most} you allow, {std:.4g}{_unit(choice)}"


def _leaving_out(question: Question, accuracy: Accuracies, first: Candidate) -> Iterator[str]:
    """Every second measurement would cost 36 %, landing at N 3.7 %; of what lands in m."""
    sampling = question.sampling
    N, M, using = sampling.N, sampling.M, sampling.using(2)
    if first.variant.every != 1:
        return
    at_all, at_half = (first.variant._replace(method="recalculate", every=every) for every in (1, 2))
    try:
        early, half = accuracy.of(at_all).at(M), accuracy.of(at_half).at(using.M)
        late = accuracy.of(at_all).at(N) if M < N else early
    except ValueError:
        return
    lateness = f"; landing in step L=N={N} instead of M={M} costs {_percent(late / early)}" if M < N else ""
    yield f"using every second measurement would cost {_percent(half / early)} of accuracy{lateness}"


def _percent(ratio: float) -> str:
    percent = 100 * (ratio - 1)
    return f"{percent:.0f} %" if percent >= TWO_DIGITS else f"{percent:.2g} %"


TWO_DIGITS = 10
"""From here on a percentage has no decimals."""


def _unit(choice: Choice) -> str:
    return f" {choice.outputs.unit}" if choice.outputs.unit else ""
