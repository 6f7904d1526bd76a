"""From what was counted with costs rounded down and up, or with exact ones: each figure between its bounds."""

from __future__ import annotations

from itertools import chain

import numpy as np

from sched_sim.probability.law import exceedance, sum_of
from sched_sim.probability.outcome import Bounds, CycleProbabilities, Floats, Tail
from sched_sim.probability.tally import Tally


def bounded(lower: Tally, upper: Tally, arrive: float, *, exact: bool) -> CycleProbabilities:
    """Of one cycle. arrive: the probability that its measurement does; exact: whether both are the same."""
    behind = max(lower.behind, upper.behind)
    crowded = 0.0 if exact else upper.crowded
    misses, responses = {}, {}
    for kind, jobs in lower.jobs.items():
        more = behind if kind.startswith("lr") else behind + crowded
        misses[kind] = between(lower.missed[kind] / jobs, upper.missed[kind] / upper.jobs[kind] + more)
    late = between(lower.late / lower.due, upper.late / upper.due + behind) if lower.due else Bounds(0.0, 0.0)
    if "lr_propagate" in misses:
        misses["lr_update"] = late
    for kind, mass in lower.responses.items():
        more = behind if kind.startswith("lr") else behind + crowded
        responses[kind] = _tail(mass / _count(lower, kind), upper.responses[kind] / _count(upper, kind), more)
    landing = _landing_exactly(lower, behind) if exact else _landing_between(lower, upper, arrive, behind)
    return CycleProbabilities(misses, landing, late, responses, behind)


def between(lower: float, upper: float) -> Bounds:
    """What rounding has put the wrong way round, the right way round, and at most 1."""
    return Bounds(min(lower, upper, 1.0), min(max(lower, upper), 1.0))


def _count(tally: Tally, kind: str) -> float:
    """Jobs of this kind that have responded."""
    return tally.jobs.get(kind, tally.due)


def _tail(lower: Floats, upper: Floats, more: float) -> Tail:
    length = max(len(lower), len(upper))
    low, up = (np.minimum(exceedance(sum_of(mass, np.zeros(length))), 1.0) for mass in (lower, upper))
    return Tail(low, np.minimum(np.maximum(up, low) + more, 1.0))


def _landing_exactly(tally: Tally, behind: float) -> dict[int, Bounds]:
    return {landed: between(share, share + behind) for landed, share in sorted(tally.landing.items()) if share}


def _landing_between(lower: Tally, upper: Tally, arrive: float, behind: float) -> dict[int, Bounds]:
    """A correction lands later with costs rounded up: P(L > l) is bounded, and P(L = l) is P(L > l - 1) - P(L > l)."""
    steps = sorted({landed for landed, share in chain(lower.landing.items(), upper.landing.items()) if share})
    landing = {}
    low = up = arrive
    for step in steps:
        low_after = sum(share for landed, share in lower.landing.items() if landed > step)
        up_after = min(sum(share for landed, share in upper.landing.items() if landed > step) + behind, arrive)
        landing[step] = between(max(low - up_after, 0.0), max(up - low_after, 0.0))
        low, up = low_after, up_after
    return landing
