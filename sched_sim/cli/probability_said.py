"""What `sched-sim probability` says in words: the answer in a sentence, and what it leaves open."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from sched_sim.costs.autocorrelation import doubtful
from sched_sim.costs.table import units
from sched_sim.probability.words import IMPOSSIBLE, NOT_RESOLVED, VANISHES, at_most, chance, clause_of, dependence

if TYPE_CHECKING:
    from fractions import Fraction

    from sched_sim.costs.table import CostTable
    from sched_sim.probability.stated import StatedCost
    from studies.probability.answer import Answer, Figure
    from studies.probability.blocks import Share
    from studies.probability.question import Question


def in_long_run(figure: Figure) -> str:
    """What comes again and again less often is not impossible."""
    assert figure.long_run is not None
    said = chance(figure.long_run, figure.floor)
    return VANISHES if said == IMPOSSIBLE and figure.last.upper else said


def sentence(found: Answer) -> str:
    """The answer."""
    asked = found.question
    high = _clause(
        found.hr_miss,
        asked,
        "An HR deadline is missed with probability {} per step",
        "No HR deadline can be missed",
        "How often an HR deadline is missed is not resolved below {} per step",
    )
    late = _clause(
        found.late,
        asked,
        f"a correction lands after L = {asked.due} with probability {{}} per measurement",
        f"no correction can land after L = {asked.due}",
        f"how often a correction lands after L = {asked.due} is not resolved below {{}} per measurement",
    )
    worst = max(found.correlations.values(), key=abs, default=0.0)
    doubt = f", which is doubtful: rank autocorrelation {worst:.2f}" if doubtful(worst) else ""
    return f"{high}; {late}. This holds for these distributions, executions independent{doubt}."


def _clause(figure: Figure, asked: Question, with_probability: str, impossible: str, unresolved: str) -> str:
    def said(words: str) -> str:
        if words.startswith(NOT_RESOLVED):
            return unresolved.format(at_most(figure.floor))
        return impossible if words == IMPOSSIBLE else with_probability.format(words)

    first = chance(figure.first, figure.floor)
    long_run = None if figure.long_run is None else in_long_run(figure)
    if figure.bound is not None and first == long_run and first.startswith(NOT_RESOLVED):
        most = with_probability.format(f"at most {at_most(figure.bound)}") if figure.bound else impossible
        sure = " (95 %)" if figure.bound else ""
        return f"{most}, with all that samples have not seen at your worst case{sure}"
    clause = said(first)
    if long_run != first:
        clause += f" in the first {asked.cycles:,} cycles" if asked.cycles > 1 else " in the first cycle"
        clause += "" if long_run is None else f", {clause_of(long_run)} in the long run"
    if figure.bound:
        clause += (
            f", at most {at_most(figure.bound)} with all that samples have not seen (95 %) at your worst case, and "
            f"what they have seen as often as in them"
        )
    return clause


def left_open(found: Answer, unit: str) -> Iterator[str]:
    """What finite samples have not seen. unit: of costs."""
    asked = found.question
    together = "" if len(asked.samples) == 1 else f" for all {len(asked.samples)} samples together"
    confidence = f"95 %{together}, if independent"
    for kind, cost in asked.samples.items():
        n = len(cost.values)
        yield (
            f"{kind}: largest of n = {n:,} is {_cost(cost.largest, unit)}; slower ones may occur with probability up "
            f"to {at_most(asked.unseen(kind))} ({confidence}) and are not in this figure"
        )
    if not asked.samples:
        return
    job, cycle = found.resolution.job, found.resolution.cycle
    where = f"{at_most(cycle)} per job or measurement"
    if job != cycle:
        where = f"{at_most(job)} per HR job and " * bool(job) + f"{at_most(cycle)} per measurement"
    yield (
        f"So nothing below {where} is resolved, the sum over all executions that it depends on; what was seen once may "
        f"come 5.6 times as often, what was ten times 1.9 times, a hundred times 1.3 times (95 %), and no figure here "
        f"has that"
    )
    cases = [f"{kind} {_cost(cost.worst, unit)}" for kind, cost in asked.samples.items() if cost.worst is not None]
    unstated = [kind for kind, cost in asked.samples.items() if cost.worst is None]
    if cases:
        but = f"; of {', '.join(unstated)} no worst case is declared, and it is in no bound" if unstated else ""
        yield f"With unseen: slower ones that often, each at your worst case, {', '.join(cases)}{but}"
    else:
        yield "No upper bound: it needs --worst COST, the most that one execution may ever take"


def independence(found: Answer) -> Iterator[str]:
    """What the order of the samples says."""
    samples = found.question.samples
    for kind, correlation in found.correlations.items():
        yield dependence(kind, correlation, len(samples[kind].values))
    if found.blocks is not None:
        blocks = found.blocks
        lengths = ", ".join(f"{length} of {kind}" for kind, length in blocks.lengths.items())
        yield (
            f"Simulated with executions in measured order, in blocks of {lengths}: HR deadlines missed "
            f"{_counted(blocks.missed)}, corrections late {_counted(blocks.late)}; the interval covers the noise of "
            f"this simulation only"
        )


def constants(asked: Question, table: CostTable, unit: str) -> Iterator[str]:
    """What was stated, with its unit; which kinds cost always the same, and what that leaves out."""
    stated = {kind: cost for kind, cost in asked.costs.items() if kind not in asked.constant and not cost.is_sample}
    if stated:
        yield f"As stated: {', '.join(f'{kind} {_from_to(cost, unit)}' for kind, cost in stated.items())}"
    if not asked.constant:
        return
    always = ", ".join(f"{kind} {_cost(asked.costs[kind].largest, unit)}" for kind in asked.constant)
    yield f"Always the same, by {table.name}: {always}"
    entries = table.costs[asked.method]
    spread = [kind for kind in asked.constant if entries[kind].p95 > entries[kind].minimum]
    if spread:
        yield f"These were measured, and their spread is in no figure here: {', '.join(spread)}; state them with --cost"


def _counted(share: Share) -> str:
    low, high = share.interval
    if not share.events:
        return f"none of {share.n:,} (95 %: at most {at_most(high)})"
    return f"{share.events:,} of {share.n:,} (95 %: {at_most(low)} to {at_most(high)})"


def _from_to(cost: StatedCost, unit: str) -> str:
    least = min(cost.values)
    return _cost(least, unit) if least == cost.largest else f"{float(least):.4g} to {_cost(cost.largest, unit)}"


def _cost(value: Fraction | None, unit: str) -> str:
    assert value is not None
    return f"{float(value):.4g} {units(unit)}"
