"""From what was counted with costs rounded down and up, or with exact ones: each figure between its bounds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import chain

import numpy as np

from sched_sim.probability.law import exceedance
from sched_sim.probability.outcome import Bounds, CycleProbabilities, Floats, Tail
from sched_sim.probability.tally import Tally


def bounded(lower: Tally, uppers: Mapping[int, Tally], arrive: float, *, exact: bool) -> CycleProbabilities:
    """Of one cycle. uppers: by how many HR updates are charged to each HR job, each an upper bound; arrive: the
    probability that its measurement does; exact: whether there is one, and it is the lower one too."""
    first = next(iter(uppers.values()))
    behind = max(lower.behind, first.behind)
    late = between(lower.late / arrive, (first.late + behind) / arrive)
    misses, responses = {}, {}
    for kind, jobs in lower.jobs.items():
        found = [up.missed[kind] / up.jobs[kind] + _not_in(kind, n, up) for n, up in uppers.items() if kind in up.jobs]
        misses[kind] = between(lower.missed[kind] / jobs, min(found, default=1.0))
    if "lr_propagate" in misses or "lr_update" in lower.responses:
        misses["lr_update"] = late
    for kind in lower.responses:
        tails = [_tail(kind, up) + _not_in(kind, n, up) for n, up in uppers.items() if kind in up.responses]
        responses[kind] = _between_tails(_tail(kind, lower), tails or [np.ones(1)])
    landing = _landing_exactly(lower, behind) if exact else _landing_between(lower, first, arrive, behind)
    return CycleProbabilities(misses, landing, late, responses, behind)


def _not_in(kind: str, charged: int, upper: Tally) -> float:
    """The mass that is not followed, and that of more HR updates than are charged to HR jobs, which delay these and
    tasks, but no LR jobs."""
    return upper.behind + (0.0 if kind.startswith("lr") else upper.crowded[charged])


def between(lower: float, upper: float) -> Bounds:
    """What rounding has put the wrong way round, the right way round, and at most 1."""
    return Bounds(min(lower, upper, 1.0), min(max(lower, upper), 1.0))


def _tail(kind: str, tally: Tally) -> Floats:
    """P(response > x); of LR updates there is one for each correction that is due."""
    return exceedance(tally.responses[kind] / tally.jobs.get(kind, tally.due))


def _between_tails(lower: Floats, uppers: Sequence[Floats]) -> Tail:
    length = max(map(len, (lower, *uppers)))
    low, *ups = (np.pad(tail, (0, length - len(tail)), "edge") for tail in (lower, *uppers))
    low = np.minimum(low, 1.0)
    return Tail(low, np.minimum(np.maximum(np.minimum.reduce(ups), low), 1.0))


def _landing_exactly(tally: Tally, behind: float) -> dict[int, Bounds]:
    return {landed: between(share, share + behind) for landed, share in sorted(tally.landing.items()) if share}


def _landing_between(lower: Tally, upper: Tally, arrive: float, behind: float) -> dict[int, Bounds]:
    """A correction lands later with costs rounded up: P(L > l) is bounded, and P(L = l) is P(L > l - 1) - P(L > l)."""
    seen = [landed for landed, share in chain(lower.landing.items(), upper.landing.items()) if share]
    landing = {}
    low = up = arrive
    for step in range(min(seen), max(seen) + 1) if seen else ():
        low_after = sum(share for landed, share in lower.landing.items() if landed > step)
        up_after = min(sum(share for landed, share in upper.landing.items() if landed > step) + behind, arrive)
        landing[step] = between(max(low - up_after, 0.0), max(up - low_after, 0.0))
        low, up = low_after, up_after
    return landing
