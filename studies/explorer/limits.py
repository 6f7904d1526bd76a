"""How far each of N, M and L may go alone: within these limits no design is refused."""

from __future__ import annotations

from dataclasses import dataclass

from sched_sim.bounds import MOST_STEPS
from sched_sim.design.least_speed import has_closed_form
from sched_sim.design.methods import METHODS
from studies.explorer.resolved import Resolved
from studies.explorer.searched import MOST, in_flight

LADDER = tuple(mantissa * 10**power for power in range(2, 7) for mantissa in (1, 2, 5))
"""Where scales of N end."""


@dataclass(frozen=True, slots=True)
class Limits:
    """First and last of each, in HR steps, where the other two stay."""

    N: tuple[int, int]
    M: tuple[int, int]
    L: tuple[int, int]


def limits(asked: Resolved) -> Limits:
    """With one measurement on its way, if the design has one; else also with as many as it has.

    Another N or M takes another L along, if L was not said. With tasks that rarely repeat together with the
    measurements, costs that lack an entry, or several corrections on their way whose work piles up slowly, a design may
    still be refused.
    """
    options = asked.design.options
    law = METHODS[asked.design.method].law(options.feedback)
    N, M, said = asked.sampling.N, asked.sampling.M, asked.stated.L
    L = law.latest(N, M) if said is None else said
    beside = law.after + law.before
    alone = max(M + beside, 0 if said is None else said + law.before) <= N
    longest = max(M, L)
    scale = max(2 * N, longest)
    last_N = next((rung for rung in LADDER if rung >= scale), MOST_STEPS)
    if not (alone and has_closed_form(options, asked.tasks)):
        last_N = min(last_N, (MOST - longest) // 2)
    last_N = max(N, last_N)
    if alone:
        first_N = max(M + beside if said is None else said + law.before, 1)
        last_M = N - beside if said is None else said - law.after
        return Limits((first_N, last_N), (0, last_M), (M + law.after, N - law.before))
    last_M = M if said is None else said - law.after
    latest = max(law.latest(N, M), L)

    def is_searched(N: int, L: int) -> bool:
        return (N + L) * in_flight(N, L) <= MOST

    first_N = next((few for few in range(1, N) if is_searched(few, law.latest(few, M) if said is None else L)), N)
    last_L = next((late for late in range(latest, L, -1) if is_searched(N, late)), L)
    return Limits((first_N, last_N), (0, last_M), (M + law.after, last_L))
