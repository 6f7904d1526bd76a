"""The rival: the dual-rate schedule of Steffes' Fig. 3 as one would write it on `simpy.PreemptiveResource`."""

from __future__ import annotations

from collections.abc import Generator
from typing import Any

import simpy

from sched_sim.design.pieces import DualRateCosts
from sched_sim.design.timing import Timing

Process = Generator[simpy.Event, Any, None]


def run(costs: DualRateCosts, timing: Timing, period: int, cycles: int) -> tuple[int, int, int]:
    """(worst HR response, worst LR update response, last achieved L); costs and period in ticks."""
    env = simpy.Environment()
    cpu = simpy.PreemptiveResource(env)
    worst = {"hr": 0, "lr": 0}
    finished: list[int] = []
    achieved = 0

    def work(priority: int, cost: int, kind: str, release: int) -> Process:
        left = cost
        while left:
            with cpu.request(priority=priority) as turn:
                start = env.now
                try:
                    yield turn
                    start = env.now
                    yield env.timeout(left)
                    left = 0
                except simpy.Interrupt:
                    left -= env.now - start
        worst[kind] = max(worst[kind], env.now - release)

    def low_rate(m: simpy.Event) -> Process:
        yield env.process(work(1, costs.lr_propagate, "lr", env.now))
        yield m
        yield env.process(work(1, costs.lr_update, "lr", env.now))
        finished.append(1)

    def high_rate(step: int) -> Process:
        nonlocal achieved
        offset = step % timing.N
        cost = costs.hr_restart if offset == 1 else costs.hr
        if finished:
            finished.clear()
            achieved, cost = offset, cost + costs.hr_update
        yield env.process(work(0, cost, "hr", env.now))
        if offset == 0:
            env.process(low_rate(env.timeout((step + timing.M) * period - env.now)))

    def clock() -> Process:
        for step in range(cycles * timing.N):
            env.process(high_rate(step))
            yield env.timeout(period)

    env.process(clock())
    env.run()
    return worst["hr"], worst["lr"], achieved
