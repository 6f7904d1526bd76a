"""Misses that are too rare for a simulation: by splitting, of which the expectation is that of the simulation itself.

The nearer the jobs of a kind are to their deadlines, the smaller is the weight that a simulation should have. At the
start of a step where it has more, it is split into as many as it has times that weight, each with random numbers of its
own; where it has less, it goes on with a probability, its weight over that one, and with that one, or ends. The mean
weight stays what it was, whatever the weights should be: so the weighted number of misses has the same mean. (M.
Villen-Altamirano and J. Villen-Altamirano, RESTART: a method for accelerating rare event simulations, 1991; and as
weight windows, T. E. Booth and J. S. Hendricks, Importance estimation in forward Monte Carlo calculations, 1984.)
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from operator import attrgetter
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from sched_sim.scenario.engine import memory as at
from sched_sim.scenario.engine.layout import memory_of
from sched_sim.scenario.engine.measured import Ints, measured
from sched_sim.scenario.engine.nearness import BINS, TO_DEADLINE
from sched_sim.scenario.engine.outcome import unfinished
from sched_sim.scenario.engine.run import advanced, empty_log
from sched_sim.scenario.engine.words import ADDED, HAS_HALF, PART, STREAM_SIZE
from sched_sim.scenario.workload import Workload

Floats: TypeAlias = npt.NDArray[np.float64]

MOST_VISITS = 1_000
"""A simulation is split into so many, in the mean, by each band; and into one for four of its steps at the most."""
PILOT_STEPS, LEAST_PILOTS, MOST_PILOTS = 200_000, 5, 500
"""Simulations of so many steps in all, or at least or at most so many, look for the first bands."""
NEXT_PILOTS, ROUNDS = 40, 12
"""No more than so many look for further ones, so often."""
LEAST_SEEN = 10
"""A band begins where so many steps were seen in it, and where the probability has fallen to FALL of the one before."""
FALL = 1 / 4


class Band(NamedTuple):
    """From so near to the deadline on, the weight that a simulation should have."""

    nearness: int
    weight: float


NEARNESS = attrgetter("nearness")


class Count(NamedTuple):
    """What one simulation, split into many, says of a kind of job, weighted: deadlines missed, and jobs of which it is
    known; at how many steps' starts it was how near to its deadlines, weighted and as seen."""

    misses: float
    decided: float
    steps: Floats
    seen: Ints


def bands_of(work: Workload, kind: int, random: np.random.Generator) -> list[Band]:
    """Bands that lead to misses, found by trial: the better they are, the more exact is what comes out of `count`."""
    bands, pilots = [Band(0, 1.0)], min(max(PILOT_STEPS // work.scenario.steps, LEAST_PILOTS), MOST_PILOTS)
    for _ in range(ROUNDS):
        counts = [count(work, kind, bands, random) for _ in range(pilots)]
        steps, seen = (np.sum([getattr(one, name) for one in counts], axis=0) for name in ("steps", "seen"))
        found = _bands(steps, seen, work.scenario.steps)
        if found[-1].nearness <= bands[-1].nearness:
            break
        bands, pilots = found, min(pilots, NEXT_PILOTS)
    return bands


def _bands(steps: Floats, seen: Ints, of_one: int) -> list[Band]:
    """of_one: the steps of one simulation."""
    probability, times = (values[::-1].cumsum()[::-1] for values in (steps / steps.sum(), seen))
    bands, before = [Band(0, 1.0)], 1.0
    for nearness in range(1, TO_DEADLINE + 1):
        weight = float(probability[nearness]) * of_one / min(MOST_VISITS, of_one / 4)
        if times[nearness] >= LEAST_SEEN and probability[nearness] <= FALL * before and weight < 1:
            bands.append(Band(nearness, weight))
            before = probability[nearness]
    return bands


def count(work: Workload, kind: int, bands: Sequence[Band], random: np.random.Generator) -> Count:
    """Of one simulation, from another seed. kind: its number among the workload's."""
    found = measured(work.scenario, int(random.integers(1 << 62)))
    memory, log = memory_of(work, found), empty_log(work, found)
    memory[at.WATCHED], streams = kind, _streams(memory, work)
    misses = decided = 0.0
    steps, seen = np.zeros(BINS), np.zeros(BINS, np.int64)
    waiting = [(memory, 0, 1)]
    while waiting:
        memory, band, copies = waiting.pop()
        if copies > 1:
            waiting.append((memory.copy(), band, copies - 1))
        _renew(memory, streams, random)
        while copies:
            memory[at.FARTHEST], memory[at.NEAREST] = bands[band].nearness, _end(bands, band)
            memory = advanced(memory, log, work.horizon + 1)
            weight, rows = bands[band].weight, _taken_out(memory, log)
            own = rows[rows[:, at.LOG_KIND] == kind]
            misses += weight * np.count_nonzero(own[:, at.LOG_END] > own[:, at.LOG_DEADLINE])
            decided += weight * len(own)
            near = memory[memory[at.HISTOGRAM] :][:BINS]
            steps += weight * near
            seen += near
            near[:] = 0
            if memory[at.NOW] == work.horizon:
                left = unfinished(work, found, memory)
                missed = weight * np.count_nonzero((left[:, 0] == kind) & (left[:, 2] <= work.horizon))
                misses, decided = misses + missed, decided + missed
                break
            band = bisect_right(bands, memory[at.NEAR], key=NEARNESS) - 1
            copies = int(weight / bands[band].weight + random.random())
            if copies > 1:
                waiting.append((memory.copy(), band, copies - 1))
    return Count(float(misses), float(decided), steps, seen)


def _end(bands: Sequence[Band], number: int) -> int:
    return bands[number + 1].nearness if number + 1 < len(bands) else BINS


def _taken_out(memory: Ints, log: Ints) -> Ints:
    """What is in the log, which is empty again."""
    rows = log[: memory[at.LOGGED]]
    memory[at.LOGGED] = 0
    return rows


def _renew(memory: Ints, streams: Ints, random: np.random.Generator) -> None:
    """Random numbers of its own from now on. streams: their addresses."""
    parts = random.integers(PART + 1, size=(streams.size, STREAM_SIZE))
    parts[:, ADDED] |= 1
    parts[:, HAS_HALF] = 0
    memory[streams[:, np.newaxis] + np.arange(STREAM_SIZE)] = parts


def _streams(memory: Ints, work: Workload) -> Ints:
    """The addresses of the streams."""
    rows = memory[memory[at.SENSORS] :][: at.SENSOR * len(work.scenario.sensors)].reshape(-1, at.SENSOR)
    return np.append(rows[:, at.STREAM], memory[at.HR_STREAM])
