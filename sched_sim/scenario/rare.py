"""The probability of misses that are too rare for one simulation to show: by splitting it near the deadlines."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

import numpy as np

from sched_sim.bounds import check_kind, whole
from sched_sim.errors import InputError
from sched_sim.scenario.distribution import Z95, below_which_unresolved
from sched_sim.scenario.draws import stream
from sched_sim.scenario.engine.limits import holds
from sched_sim.scenario.scenario import Scenario
from sched_sim.scenario.workload import workload
from sched_sim.schedule.clock import OnProgress

RUNS = 200
LEAST_RUNS = 20
"""So many must have seen a miss, for an interval from the spread between them."""


@dataclass(frozen=True)
class RareMisses:
    """How often jobs of one kind miss their deadlines, from independent runs, each split into many.

    runs: how many; missed: in how many of them one did, however small its weight. probability: of those decided, the
    share that misses; interval: its 95 % interval, from the spread between the runs. Both None where fewer than
    LEAST_RUNS saw a miss; but where nothing ever was so near a deadline that a run was split, and none missed, the
    interval goes from 0 to 3/n, n decided in all runs together.
    """

    runs: int
    missed: int
    probability: float | None
    interval: tuple[float, float] | None


def rare_misses(
    scenario: Scenario, kind: str, *, runs: int = RUNS, on_progress: OnProgress | None = None
) -> RareMisses:
    """Of jobs of a kind, as `Outcome.jobs` names them, in the steps of the scenario; from its seed.

    The mean of the weighted misses is that of `JobFigures.misses`, and so with those decided: the probability is their
    quotient, with an error from that of the order of 1 / runs. Delays and losses are drawn once for a run, execution
    times for each of the parts into which it is split.
    on_progress: called before each run.
    Raises InputError for a kind that is not there, for fewer than LEAST_RUNS runs, and for times that machine code does
    not hold.
    """
    from sched_sim.scenario.engine.splitting import bands_of, count

    check_kind(scenario, Scenario, "scenario", "read_scenario(...), or a Scenario")
    if whole(runs, "runs") < LEAST_RUNS:
        raise InputError(f"runs is {runs}: give at least {LEAST_RUNS}, for an interval from their spread")
    work = workload(scenario)
    if kind not in work.kinds:
        raise InputError(f"kind {kind!r} is not there: choose from {', '.join(map(repr, work.kinds))}")
    if not holds(work):
        raise InputError(
            f"scenario {scenario.name!r}: rare misses are found by compiled code, and times in the ticks in which all "
            f"is whole do not fit into 64 bits: give costs and times with fewer digits"
        )
    number, random = work.kinds.index(kind), stream(scenario.seed, f"{kind} splitting")
    bands = bands_of(work, number, random)
    misses, decided = np.empty(runs), np.empty(runs)
    for run in range(runs):
        if on_progress is not None:
            on_progress(run, runs, "runs")
        counted = count(work, number, bands, random)
        misses[run], decided[run] = counted.misses, counted.decided
    missed = int(np.count_nonzero(misses))
    if not missed and len(bands) == 1:
        return RareMisses(runs, 0, None, (0.0, below_which_unresolved(float(decided.sum()))))
    if missed < LEAST_RUNS:
        return RareMisses(runs, missed, None, None)
    probability = float(misses.sum() / decided.sum())
    spread = float(np.std(misses - probability * decided, ddof=1))
    half = Z95 * spread / sqrt(runs) / float(decided.mean())
    return RareMisses(runs, missed, probability, (max(probability - half, 0.0), min(probability + half, 1.0)))
