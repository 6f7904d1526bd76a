"""All that is counted of a design: of each of the first cycles, and in the long run."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from sched_sim.probability.first_cycles import crowded_for, first_cycles
from sched_sim.probability.long_run import Process, long_run
from sched_sim.probability.model import FULL, Model
from sched_sim.probability.tally import Tally
from sched_sim.schedule.clock import OnProgress


class Followed(NamedTuple):
    """long_run: of a cycle in the mean; None if there is none."""

    cycles: list[Tally]
    long_run: Tally | None


def follow(model: Model, cycles: int, on_progress: OnProgress | None) -> dict[int, Followed]:
    """By how many HR updates are charged to each HR job, 0 where they are charged where they land. In the long run
    there may be too many, and then nothing is counted of HR jobs."""
    known, charged = model.processes()
    settles = not model.no_long_run()
    common = _together([_follow(process, model, cycles, on_progress, settles=settles) for process in known])
    found = {}
    for updates, processes in charged.items():
        has_time = settles and model.high_load(updates) < FULL
        apart = [_follow(process, model, cycles, on_progress, settles=has_time) for process in processes]
        both = _together([common, *apart])
        found[updates] = both if both.long_run is not None else both._replace(long_run=common.long_run)
    return found


def _follow(process: Process, model: Model, cycles: int, on_progress: OnProgress | None, *, settles: bool) -> Followed:
    first = first_cycles(process, cycles, model.taken, model.hyperperiod, model.begin, model.after, on_progress)
    if not settles:
        return Followed(first, None)
    if on_progress is not None:
        on_progress(cycles, cycles, "cycles, and the long run")
    last = long_run(process, model.hyperperiod, model.begin)
    if last is None:
        return Followed(first, None)
    last.behind = last.unknown + last.behind * model.recovery
    for charged in last.crowded:
        last.crowded[charged] *= crowded_for(model.after) + 1
    return Followed(first, last.scaled(1 / model.cycles))


def _together(followed: Sequence[Followed]) -> Followed:
    """Of processes that count different things."""
    tallies = [Tally() for _ in followed[0].cycles]
    last: Tally | None = Tally()
    for cycles, long in followed:
        for tally, more in zip(tallies, cycles, strict=True):
            tally.add(more)
        if last is not None and long is not None:
            last.add(long)
        else:
            last = None
    return Followed(tallies, last)
