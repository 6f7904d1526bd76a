"""The least speed of the designs of a chunk, and whether and where they land at the speeds asked for; exact."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from math import gcd
from typing import NamedTuple

import numpy as np

from sched_sim.design import analysis, whole
from sched_sim.design.binding import Binding
from sched_sim.design.demand import NOT_LANDED
from sched_sim.design.least_speed import achieved_l, has_closed_form, least_speed
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs, converted, works
from sched_sim.design.quotient import Quotient
from sched_sim.design.timing import Timing
from sched_sim.schedule.tasks import Task, phases_matter
from sched_sim.ticks import ticks_per_unit, to_ticks
from studies.sweep.grid import Chunk
from studies.sweep.legal import Ints


class Least(NamedTuple):
    """The least speed of one design in lowest terms, cost units per HR period, and what binds."""

    numerator: int
    denominator: int
    binding: str


class Outcome(NamedTuple):
    """At one point's speed: whether every deadline holds, and the L at which corrections land, None if they do not."""

    feasible: bool
    achieved: int | None


class Analysis(NamedTuple):
    """`least` by design, `outcomes` by point."""

    least: list[Least]
    outcomes: list[Outcome]

    def speed(self, chunk: Chunk, position: int) -> Fraction:
        """The speed of the point at `position`."""
        if chunk.speeds:
            return chunk.speeds[position % len(chunk.speeds)]
        return Fraction(*self.least[position][:2])


def analyse(chunk: Chunk) -> Analysis:
    """In closed form; with context-switch costs, other tasks, earliest deadline first or several corrections on their
    way, which have none, by simulation."""
    return _in_closed_form(chunk) if chunk.has_closed_form else _by_simulation(chunk)


def _in_closed_form(chunk: Chunk) -> Analysis:
    options, speeds = chunk.block.options, chunk.speeds
    resolution = ticks_per_unit([*works(chunk.block.costs), *speeds])
    costs = converted(chunk.block.costs, lambda work: to_ticks(work, resolution))
    periods = [to_ticks(speed, resolution) for speed in speeds]
    least = analysis.least_period(costs, *chunk.designs, options)

    positions = np.array(chunk.positions)
    design = positions // max(len(speeds), 1)
    N, M, L = (axis[design] for axis in chunk.designs)
    at_least = Fractions(least.numerator[design], least.denominator[design])
    at = Fractions(np.array(periods, dtype=object)[positions % len(speeds)], np.ones_like(N)) if speeds else at_least
    landed = analysis.achieved_l(costs, N, M, at.numerator, options, at.denominator)
    enough = at.reaches(at_least)
    feasible = enough & (landed != NOT_LANDED) & (landed <= L)
    return Analysis(
        least=list(_lowest_terms(least, resolution)),
        outcomes=[
            Outcome(bool(holds), None if step == NOT_LANDED else step)
            for holds, step in zip(feasible.tolist(), landed.tolist(), strict=True)
        ],
    )


class Fractions(NamedTuple):
    """Elementwise HR periods in ticks."""

    numerator: Ints
    denominator: Ints

    def reaches(self, other: Fractions) -> Ints:
        """In Python's integers: the products may be too large for others."""
        return self.numerator.astype(object) * other.denominator >= other.numerator.astype(object) * self.denominator


def _lowest_terms(periods: Quotient[whole.Ints], resolution: int) -> Iterator[Least]:
    """The speeds of HR periods in ticks, `resolution` ticks being one cost unit."""
    names = {code.value: code.name for code in Binding}
    for numerator, denominator, code in zip(*(part.tolist() for part in periods), strict=True):
        denominator *= resolution
        common = gcd(numerator, denominator)
        yield Least(numerator // common, denominator // common, names[code])


def _by_simulation(chunk: Chunk) -> Analysis:
    """A point is feasible if the simulation never has a miss at its speed; it lands at the latest L of all cycles, of
    the first ones where something is missed."""
    costs, options, tasks = chunk.block.costs, chunk.block.options, chunk.block.tasks
    timings = [Timing(*design) for design in zip(*(axis.tolist() for axis in chunk.designs), strict=True)]
    least_speeds = [least_speed(costs, timing, options, tasks) for timing in timings]
    least = [Least(item.speed.numerator, item.speed.denominator, item.binding) for item in least_speeds]
    result = Analysis(least, [])
    per_design = max(len(chunk.speeds), 1)
    for position in chunk.positions:
        design = position // per_design
        timing, speed = timings[design], result.speed(chunk, position)
        if has_closed_form(options, tasks, costs, timing):
            landed = achieved_l(costs, timing, speed, options)
            enough = speed >= least_speeds[design].speed
            outcome = Outcome(enough and landed is not None and landed <= timing.L, landed)
        else:
            outcome = _simulated(costs, timing, speed, options, tasks)
        result.outcomes.append(outcome)
    return result


FIRST_CYCLES = 4
"""That are simulated to see where corrections land if deadlines are missed."""


def _simulated(costs: Costs, timing: Timing, speed: Fraction, options: Options, tasks: Sequence[Task]) -> Outcome:
    from sched_sim.design.any_phase import worst_landing
    from sched_sim.design.simulate import simulate
    from sched_sim.design.steady import run_until_steady

    if phases_matter(tasks):
        landed = worst_landing(costs, timing, speed, options, tasks)
        if landed is not None:
            return Outcome(True, landed)
    elif (steady := run_until_steady(costs, timing, speed, options, tasks)).repeats:
        return Outcome(True, max(steady.schedule.achieved))
    schedule = simulate(costs, timing, speed, FIRST_CYCLES, options, tasks)
    overrun = schedule.responses["hr"].misses > 0
    lands = not overrun and schedule.achieved.total() == FIRST_CYCLES
    return Outcome(False, max(schedule.achieved) if lands else None)
