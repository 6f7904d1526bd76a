"""Methods whose HR job does all: the backlog of one priority, step by step."""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

import numpy as np

from sched_sim.design.pieces import (
    AugmentationCosts,
    CarriedCosts,
    CarriedGainCosts,
    CarriedGainInFlightCosts,
    CloneCosts,
    CloneInFlightCosts,
    FuseAsFreshCosts,
    JobCosts,
    LarsenCosts,
    Px4PredictorCosts,
    RecalculateCosts,
    StandardCosts,
)
from sched_sim.design.taken import Taken
from sched_sim.design.timing import Timing
from sched_sim.probability.high_rate import Branch, Counts, HighRate
from sched_sim.probability.level import Level
from sched_sim.probability.outcome import Floats
from sched_sim.probability.tally import Tallies
from sched_sim.probability.timeline import Timeline


class Serial:
    """One level from step 0 on. latest: the l by which corrections must land, in steps after k, where they do in HR
    jobs; weight: of each job in the tallies; behind: mass that is not followed."""

    def __init__(
        self, priority: int, high: HighRate | None, timeline: Timeline, most: int, taken: Taken, latest: int
    ) -> None:
        self.level = Level(priority, high, timeline, most, self._landed)
        self.timeline, self.taken, self.latest = timeline, taken, latest
        self.step, self.weight = 0, 1.0
        self.tallies = Tallies()

    @property
    def total(self) -> float:
        return self.level.total

    @property
    def behind(self) -> float:
        return self.level.gone

    def advance(self, end: int, tallies: Tallies) -> None:
        """Up to the start of this step."""
        self.tallies = tallies
        while self.step < end:
            tally = tallies[self.taken.before(self.step + 1) - 1]
            for index in range(len(self.timeline.segments(self.step))):
                self.level.run(self.step, index, tally, self.weight)
            self.step += 1

    def clear(self) -> dict[Hashable, float]:
        """The mass of states without any backlog, at the start of a step."""
        return {key: float(mass[0]) for key, mass in self.level.parts.items()}

    def restart(self, key: Hashable) -> None:
        """From one of them, with probability 1."""
        self.level.parts, self.level.gone = {key: np.ones(1)}, 0.0

    def take(self, key: Hashable) -> float:
        """The mass of one of them, which goes on no longer."""
        mass = self.level.parts.get(key)
        if mass is None:
            return 0.0
        taken, mass[0] = float(mass[0]), 0.0
        return taken

    def state(self) -> dict[Hashable, Floats]:
        return dict(self.level.parts)

    def _landed(self, step: int, branch: Branch, response: Floats) -> None:
        """The correction of each that arrived is in the state in the step in which the HR job finishes."""
        period = self.timeline.period
        for age in branch.arrived:
            tally = self.tallies[self.taken.before(step - age)]
            finished_in = np.maximum(np.arange(len(response)) - 1, 0) // period
            by_step = np.bincount(finished_in, weights=response)
            for later in np.flatnonzero(by_step).tolist():
                tally.landing[age + later] += float(by_step[later])
            tally.due += float(response.sum())
            tally.late += float(by_step[max(self.latest - age + 1, 0) :].sum())


class WorkOf:
    """How often an HR job of a serial method runs each piece."""

    def __init__(self, costs: JobCosts[Any], timing: Timing) -> None:
        self.costs, self.M, self.taken = costs, timing.M, timing.taken

    def __call__(self, step: int, lands: bool) -> Counts:
        """Where every measurement is M steps late."""
        match self.costs:
            case StandardCosts() | FuseAsFreshCosts():
                return {"propagate": 1, "update": int(lands)}
            case RecalculateCosts():
                return {"propagate": 1, "update": int(lands), "replay": lands * self.M}
            case LarsenCosts():
                products = self.M >= 2 if lands else 2 <= self.taken.since(step) < self.M
                return {"accumulate" if products else "propagate": 1, "update": int(lands)}
            case CloneCosts() | CarriedGainCosts():
                return self._carried(self.costs, step, lands)
            case Px4PredictorCosts():
                return {"predict": 1, "propagate": 1, "pull": 1, "shift": self.M + 1, "update": int(lands)}
            case AugmentationCosts():
                update = {"update": 1, "update_more": self.M, "update_bend": self.M * (self.M - 1) // 2}
                return {"predict": 1, "predict_more": self.M, **(update if lands else {})}
        raise AssertionError(self.costs)

    def _carried(self, costs: CarriedCosts[Any], step: int, lands: bool) -> Counts:
        at_k, at_m = at_k_and_m(costs)
        before = self.taken.before
        carried = max(0, before(step) - before(max(step - self.M + 1, 0)))
        others = max(0, before(step) - before(step - self.M + 1)) if lands else 0
        counts = {at_m: int(lands), "propagate": 1, "carry": carried}
        starts = not self.taken.since(step)
        counts[at_k] = counts.get(at_k, 0) + starts
        if isinstance(costs, CloneInFlightCosts | CarriedGainInFlightCosts):
            counts |= {"couple": starts * carried, "compensate": others}
        return counts

    def at_random(self, step: int, age: int, waiting: bool, arrived: tuple[int, ...]) -> Counts:
        """Where they come up to N steps late, or never."""
        match self.costs:
            case RecalculateCosts():
                return {"propagate": 1, "update": len(arrived), "replay": sum(arrived)}
            case LarsenCosts():
                products = waiting and age >= 2
                return {"accumulate" if products else "propagate": 1, "update": len(arrived)}
            case CloneCosts() | CarriedGainCosts():
                at_k, at_m = at_k_and_m(self.costs)
                carried = int(waiting and age not in arrived)
                starts = not self.taken.since(step)
                return {at_m: len(arrived), "propagate": 1, "carry": carried, at_k: int(starts)}
        raise AssertionError(self.costs)


def at_k_and_m(costs: CarriedCosts[Any]) -> tuple[str, str]:
    """The pieces that run then."""
    return ("start", "update") if isinstance(costs, CloneCosts) else ("update", "land")
