"""Measurements of random delay, some of which never arrive, against every outcome of a simulation."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from typing import Any

import pytest

from sched_sim.design import dual_rate
from sched_sim.design.dual_rate import DualRate
from sched_sim.design.pieces import CarriedGainCosts, DualRateCosts, LarsenCosts, RecalculateCosts
from sched_sim.design.timing import Timing
from sched_sim.probability.cost_distribution import CostDistribution
from sched_sim.probability.exact import probabilities
from sched_sim.schedule.jobs import HR, Job, step_at
from sched_sim.schedule.processor import Platform, Processor
from tests.drawn_costs import Draw, Seen, all_runs

T = 30
LOST = 99
certain = CostDistribution.certain


def weighted(*pairs: tuple[int, float]) -> CostDistribution:
    return CostDistribution.of_weights((Fraction(value), share) for value, share in pairs)


DELAYS = weighted((0, 0.25), (1, 0.5), (3, 0.25))
FATES = weighted((0, 0.125), (1, 0.25), (3, 0.125), (LOST, 0.5))
"""The same with a dropout of one half."""


class Arrivals(DualRate):
    """LR jobs go on without a measurement that is lost."""

    draw: Draw

    def release(self) -> tuple[Job, ...]:
        step, start, M = self.step, self.next_release, self.M
        self.M = 10**6
        jobs = super().release()
        self.M = M
        if not self.taken.since(step):
            fate = self.draw("delay")
            if fate == LOST:
                self.lost.add(step)
                self.on_the_way.pop()
            else:
                self.arrivals[step + fate] = [*self.arrivals.get(step + fate, []), step]
        for k in self.arrivals.pop(step, []):
            jobs += self._measurement(k, start)
        return jobs

    def _propagate(self, job: Job, now: int) -> tuple[Job, ...]:
        jobs = super()._propagate(job, now)
        if job.step in self.lost:
            self.updates_queued += 1
        return jobs

    def _early_work_done(self, job: Job, now: int) -> tuple[Job, ...]:
        if job.step in self.lost:
            self.in_state += 1
        return super()._early_work_done(job, now)


@pytest.mark.parametrize("dropout", [0.0, 0.5])
def test_dual_rate(dropout: float) -> None:
    values = {"lr_update": weighted((16, 0.875), (40, 0.125))}
    whole = DualRateCosts(10, 9, 4, 9, 0, 0)
    timing = Timing(3, 1, 3)
    cycles, steps = 2, 6
    fates = FATES if dropout else DELAYS

    def run(draw: Draw) -> Seen:
        seen = Seen()
        source = Arrivals(whole, timing, OPTIONS, T, seen.landed.__setitem__)
        source.draw, source.lost, source.arrivals = draw, set(), {}  # type: ignore[attr-defined]
        measured = source._measurement

        def drawn(k: int, now: int) -> tuple[Job, ...]:
            source.costs = DualRateCosts(10, 9, 4, 9, 0, draw("lr_update"))
            return measured(k, now)

        source._measurement = drawn  # type: ignore[method-assign]
        Processor([source], T, steps * T, Platform(1, 0)).run()
        return seen

    laws = {
        name: certain(getattr(whole, name)) for name in ("hr", "hr_restart", "hr_update", "lr_propagate", "lr_gain")
    }
    costs = DualRateCosts(**laws, **values)  # type: ignore[type-var]
    found = probabilities(costs, timing, T, cycles, delays=DELAYS, dropout=dropout, debt=3)
    is_as_seen(found, all_runs({"delay": fates} | values, run), cycles, steps, timing.N)


OPTIONS = dual_rate.Options()


class HrJobs:
    """Recalculate, larsen or carried-gain, written from the timeline once more."""

    def __init__(self, costs: Any, N: int, draw: Draw, seen: Seen) -> None:
        self.costs, self.N, self.draw, self.seen = costs, N, draw, seen
        self.step = self.next_release = 0
        self.awaited: dict[int, int] = {}  # k, and in which step it arrives, or LOST

    def release(self) -> tuple[Job, ...]:
        step, start, draw = self.step, self.next_release, self.draw
        self.step, self.next_release = step + 1, start + T
        older = list(self.awaited)
        if step % self.N == 0:
            self.awaited[step] = step + draw("delay")
        arrived = [k for k, arrives in self.awaited.items() if arrives == step]
        carried = [k for k in older if k not in arrived]
        match self.costs:
            case RecalculateCosts():
                work = draw("propagate") + sum(draw("update") for _ in arrived)
                work += sum(draw("replay") for k in arrived for _ in range(step - k))
            case LarsenCosts():
                work = draw("accumulate" if any(step - k >= 2 for k in older) else "propagate")
                work += sum(draw("update") for _ in arrived)
            case CarriedGainCosts():
                work = draw("propagate") + sum(draw("land") for _ in arrived) + sum(draw("carry") for _ in carried)
                work += draw("update") if step % self.N == 0 else 0
        for k in [k for k in self.awaited if k in arrived or step - k >= int(DELAYS.worst)]:
            del self.awaited[k]

        def landed(_job: Job, now: int) -> tuple[Job, ...]:
            for k in arrived:
                self.seen.landed[k // self.N] = max(step_at(now, T), step) - k
            return ()

        return (Job("hr", step, HR, start, start + T, work, (), landed),)

    def at_horizon(self) -> tuple[Job, ...]:
        return ()


@pytest.mark.parametrize("dropout", [0.0, 0.5])
@pytest.mark.parametrize(
    "costs",
    [
        RecalculateCosts(weighted((10, 0.5), (21, 0.5)), certain(5), certain(6)),
        LarsenCosts(certain(10), weighted((14, 0.5), (31, 0.5)), certain(25)),
        CarriedGainCosts(weighted((10, 0.5), (21, 0.5)), certain(9), certain(4), certain(12)),
    ],
)
def test_serial(costs: Any, dropout: float) -> None:
    N, cycles = 3, 2
    steps = N * cycles
    laws = {name: getattr(costs, name) for name in costs.__dataclass_fields__ if name != "lacks"}

    def run(draw: Draw) -> Seen:
        seen = Seen()
        source: Any = HrJobs(costs, N, draw, seen)
        Processor([source], T, steps * T, Platform(1, 0)).run()
        return seen

    found = probabilities(costs, Timing(N, 1, 1), T, cycles, delays=DELAYS, dropout=dropout, debt=3)
    is_as_seen(found, all_runs({"delay": FATES if dropout else DELAYS} | laws, run), cycles, steps, N)


def is_as_seen(found: Any, runs: Any, cycles: int, steps: int, N: int) -> None:
    landed: Counter[tuple[int, int]] = Counter()
    for share, seen in runs:
        for cycle, lands in seen.landed.items():
            landed[cycle, lands] += share
    assert landed
    for (cycle, lands), share in landed.items():
        assert found.cycles[cycle].landing[lands].lower == pytest.approx(float(share), abs=1e-12)
    for cycle in range(cycles):
        for lands in found.cycles[cycle].landing:
            assert (cycle, lands) in landed or cycle * N + lands >= steps
    assert found.long_run is not None
    assert sum(share.lower for share in found.long_run.landing.values()) == pytest.approx(1 - found.lost, abs=1e-3)
