"""What is asked: one filter design whose costs, and whose measurements' delay, are random."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from sched_sim.costs.table import CostTable
from sched_sim.design.drawn import kinds_by_piece
from sched_sim.design.methods import METHODS
from sched_sim.design.options import Options
from sched_sim.design.pieces import Statistic
from sched_sim.design.timing import Timing
from sched_sim.errors import InputError, option
from sched_sim.probability.cost_distribution import CostDistribution
from sched_sim.probability.samples import unseen_mass
from sched_sim.probability.stated import StatedCost
from sched_sim.schedule.tasks import Task


@dataclass(frozen=True)
class Question:
    """costs: by kind of job, of all that run; constant: those of them that are one number, from the cost table.

    pieces: the kind that each piece of the method is, None for one that does not run. speed: cost units per HR period.
    delays: of measurements, in steps, in place of M; dropout: the probability that one never arrives. preempted,
    cycles, bins: as `sched_sim.probabilities` has them.
    """

    method: str
    costs: Mapping[str, StatedCost]
    constant: Sequence[str]
    pieces: Mapping[str, str | None]
    timing: Timing
    speed: Fraction
    options: Options = Options()
    tasks: Sequence[Task] = ()
    delays: CostDistribution | None = None
    dropout: float = 0.0
    preempted: bool = False
    cycles: int = 1000
    bins: int | None = None

    @property
    def latest(self) -> Timing:
        """With the longest delay."""
        return self.timing if self.delays is None else replace(self.timing, M=int(self.delays.worst))

    @property
    def due(self) -> int:
        """The steps after k by which a correction must have landed."""
        law = METHODS[self.method].law(self.options.feedback)
        return self.latest.M if law.only_first and not self.preempted else self.timing.L

    @property
    def samples(self) -> dict[str, StatedCost]:
        run = set(self.pieces.values())
        return {kind: cost for kind, cost in self.costs.items() if cost.is_sample and kind in run}

    def unseen(self, kind: str) -> float:
        """The most that executions slower than all of this kind's sample may be as a probability, at 95 % for all
        samples together; 0 of what is no sample."""
        samples = self.samples
        return unseen_mass(len(samples[kind].values), len(samples)) if kind in samples else 0.0


def stated_and_constant(
    table: CostTable, method: str, options: Options, stated: Mapping[str, StatedCost], statistic: Statistic
) -> tuple[dict[str, StatedCost], list[str], dict[str, str | None]]:
    """The costs, constant kinds and pieces of a `Question`. Raises InputError for a kind that is neither stated nor in
    the table, and for one that is stated and does not run with these options."""
    in_table = table.costs.get(method, {})
    known = list(dict.fromkeys([*stated, *in_table]))
    pieces = kinds_by_piece(method, known, options, table)
    run = [kind for kind in pieces.values() if kind is not None]
    for kind, cost in stated.items():
        if kind not in run:
            others = f"; {option('gain')} and {option('low_rate_noise')} choose others" if method == "dual-rate" else ""
            raise InputError(
                f"{cost.source}: {kind} does not run with these options: what runs is {', '.join(run)}{others}"
            )
    constant = [kind for kind in run if kind not in stated]
    return (
        {kind: stated[kind] if kind in stated else certain(getattr(in_table[kind], statistic)) for kind in run},
        constant,
        pieces,
    )


def certain(value: Fraction) -> StatedCost:
    return StatedCost([value], [Fraction(1)])
