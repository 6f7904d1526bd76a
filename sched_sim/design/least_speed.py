"""The least speed of one design, its achieved l, and the staircase between them, as exact fractions."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from fractions import Fraction
from typing import NamedTuple

from sched_sim.design import analysis
from sched_sim.design.arguments import checked
from sched_sim.design.binding import Binding
from sched_sim.design.demand import NOT_LANDED
from sched_sim.design.later import gains_nothing
from sched_sim.design.load import loads
from sched_sim.design.long_pattern import of_bound
from sched_sim.design.methods import method_of
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs, JobCosts, converted, works
from sched_sim.design.timing import Timing
from sched_sim.design.uneven import comes_unevenly, longest_job
from sched_sim.errors import InputError
from sched_sim.schedule.tasks import Task, phases_matter
from sched_sim.ticks import Number, positive, ticks_per_unit, to_ticks


class LeastSpeed(NamedTuple):
    """The least speed of one design, and what fixes it.

    speed: in cost units per HR period; binding: as in the column of a sweep, the name of an `Binding`,
    "task:NAME" or "load", where nothing is missed soon and work piles up.
    """

    speed: Fraction
    binding: str


class Stair(NamedTuple):
    """What one L asks of the processor.

    L: as asked for, in HR steps; speed: the least, in cost units per HR period; binding: what fixes it, as in
    `LeastSpeed`; achieved: the L at which corrections land at that speed, in HR steps.
    """

    L: int
    speed: Fraction
    binding: str
    achieved: int


def least_speed(
    costs: Costs,
    timing: Timing,
    options: Options = Options(),
    tasks: Sequence[Task] = (),
    on_progress: Callable[[int], None] = lambda _runs: None,
    on_work: Callable[[int], None] = lambda _instants: None,
) -> LeastSpeed:
    """The least speed at which every deadline holds (Steffes 2014, Sec. III.C: needed processing power).

    In closed form and exact, where measurements are not whole steps apart for their intervals as they come, whether
    each is used M steps after its k or as soon as it is there (`uneven`). With context-switch costs, other tasks or
    earliest deadline first, and where the dual-rate filter has several corrections on their way, M >= N or L > N, by
    bisection on the simulation, which is exact to one tick and calls `on_progress` before each one, with its number,
    and `on_work` after it, with how many points in time it visited (see `search.least_speed_by_simulation`), or, where
    the intervals repeat only after many steps, an upper bound (`long_pattern`); with tasks whose offset may be any, or
    with jitter, by bisection on the worst response times, for every phase (`any_phase.least_speed_of_any_phase`), of
    uneven intervals an upper bound too. An L > N needs no more than one before the next measurement. Every faster
    processor does too, except where landing earlier costs more: the HR job of step k+1 is the longest of all, or
    same-step feedback spills into the next step.
    Raises InputError for an L that the method cannot have.
    """
    tasks = checked(timing, options, tasks)
    method_of(costs).check_design(costs, timing, options.feedback)
    own = costs
    costs, timing = of_bound(costs, timing)
    if not has_closed_form(options, tasks, costs, timing):
        if phases_matter(tasks):
            from sched_sim.design.any_phase import least_speed_of_any_phase

            return LeastSpeed(*least_speed_of_any_phase(costs, timing, options, tasks, on_progress))
        from sched_sim.design.search import least_speed_by_simulation

        before = alone(costs, timing, options, tasks)
        enough = None if before is None else least_speed(own, before, options)
        floor = _floor(costs, timing, options)
        if before is not None and enough is not None:
            known = enough.speed == floor or gains_nothing(costs, timing, before, enough.speed, floor, options)
            if known:
                return enough
        found = LeastSpeed(*least_speed_by_simulation(costs, timing, options, tasks, on_progress, on_work))
        return found if enough is None or found.speed < enough.speed else enough
    if comes_unevenly(costs, timing):
        return LeastSpeed(longest_job(costs, timing), Binding.hr.name)
    resolution, in_ticks = _in_ticks(costs)
    least = analysis.least_period(in_ticks, timing.N, timing.M, timing.L, options)
    speed = Fraction(least.numerator, least.denominator * resolution)
    return LeastSpeed(speed, Binding(least.code).name)


def least_speed_range(
    costs: Costs, timing: Timing, options: Options = Options(), tasks: Sequence[Task] = ()
) -> tuple[Fraction, Fraction | None]:
    """What the least speed is at least and at most, as far as no simulation is needed to know it; None: not known."""
    tasks = checked(timing, options, tasks)
    method_of(costs).check_design(costs, timing, options.feedback)
    at, bound = of_bound(costs, timing)
    if has_closed_form(options, tasks, at, bound):
        speed = least_speed(costs, timing, options).speed
        return speed, speed
    before = alone(at, bound, options, tasks)
    if before is None:
        return Fraction(0), None
    return _floor(at, bound, options), least_speed(costs, before, options).speed


def achieved_l(costs: Costs, timing: Timing, speed: Number, options: Options = Options()) -> int | None:
    """The L at which corrections land at `speed`, in closed form; None where an HR job overruns its step or nothing
    lands before the next measurement. Where several corrections are on their way, M >= N or L > N with the dual-rate
    filter, the latest of a simulation until it repeats; None where a deadline is missed.

    Raises InputError for options that have no closed form (`has_closed_form`).
    """
    checked(timing, options)
    speed = positive(speed, "speed")
    method_of(costs).check_design(costs, timing, options.feedback)
    costs, timing = of_bound(costs, timing)
    if not has_closed_form(options, ()):
        raise InputError(
            f"options with context_switch={float(options.context_switch):g} and policy={options.policy!r} have no "
            f"closed form: `simulate` says where corrections land"
        )
    if not has_closed_form(options, (), costs, timing):
        from sched_sim.design.steady import run_until_steady

        steady = run_until_steady(costs, timing, speed, options)
        return max(steady.schedule.achieved) if steady.repeats else None
    if comes_unevenly(costs, timing):
        return timing.M if longest_job(costs, timing) <= speed else None
    resolution, in_ticks = _in_ticks(costs, speed)
    landed = analysis.achieved_l(in_ticks, timing.N, timing.M, to_ticks(speed, resolution), options)
    return None if landed == NOT_LANDED else landed


def staircase(
    costs: Costs, N: int, M: int, options: Options = Options(), *, only: Collection[int] | None = None
) -> list[Stair]:
    """Every legal L with its least speed, from the earliest to the latest, or to the one that is meant where none is
    given (`Law.latest`), where later ones are possible; or `only` some of these.

    A step on which `achieved` is less than L is waste: the same processor already lands earlier.
    For the serial methods there is one stair: the correction lands at m, whatever L is.
    """
    method = method_of(costs)
    law = method.law(options.feedback)
    M = 0 if law.undelayed else M
    longest = Timing(N, M, max(N, M))
    checked(longest, options)
    legal = law.legal(N, M)
    if not legal:
        method.check_design(costs, longest, options.feedback)
    landings = [L for L in (legal if only is None else sorted(only)) if L in legal]
    if not landings or has_closed_form(options, (), costs, Timing(N, M, landings[-1])):
        return _in_closed_form(costs, N, M, landings, options)
    stairs = []
    for timing in (Timing(N, M, L) for L in landings):
        least = least_speed(costs, timing, options)
        landed = achieved_l(costs, timing, least.speed, options)
        assert landed is not None
        stairs.append(Stair(timing.L, least.speed, least.binding, landed))
    return stairs


def _in_closed_form(costs: Costs, N: int, M: int, landings: Sequence[int], options: Options) -> list[Stair]:
    """The stairs of one N and M, all at once."""
    import numpy as np

    for first in landings[:1]:
        method_of(costs).check_design(costs, Timing(N, M, first), options.feedback)
    resolution, in_ticks = _in_ticks(costs)
    every_N, every_M = (np.full(len(landings), steps, dtype=np.int64) for steps in (N, M))
    least = analysis.least_period(in_ticks, every_N, every_M, np.array(landings, dtype=np.int64), options)
    landed = analysis.achieved_l(in_ticks, every_N, every_M, least.numerator, options, least.denominator)
    return [
        Stair(L, Fraction(period, steps * resolution), Binding(code).name, achieved)
        for L, period, steps, code, achieved in zip(
            landings, *(column.tolist() for column in (*least, landed)), strict=True
        )
    ]


def has_closed_form(
    options: Options, tasks: Sequence[Task], costs: Costs | None = None, timing: Timing | None = None
) -> bool:
    """Whether the least speed needs no simulation: with these options and tasks, and, if they are given, of this
    method's design."""
    if tasks or options.context_switch or options.policy != "fixed":
        return False
    if costs is None or timing is None:
        return True
    law = method_of(costs).law(options.feedback)
    return law.one_in_flight(timing.N, timing.L) and (law.only_first or not law.several or timing.instants is None)


def alone(costs: Costs, timing: Timing, options: Options, tasks: Sequence[Task]) -> Timing | None:
    """The design that lands before the next measurement is taken, and so in time for this later L; None where there is
    none that has a closed form."""
    last = method_of(costs).law(options.feedback).last_alone(timing.N, timing.M)
    if last is None or last >= timing.L or (timing.instants and timing.N == 1) or not has_closed_form(options, tasks):
        return None
    return Timing(timing.N, timing.M, last)


def _floor(costs: Costs, timing: Timing, options: Options) -> Fraction:
    """Less will never do."""
    return max(method_of(costs).longest(costs, timing), *loads(costs, timing, Fraction(1), options))


def _in_ticks(costs: Costs, *others: Fraction) -> tuple[int, JobCosts[int]]:
    resolution = ticks_per_unit([*(_exact(work) for work in works(costs)), *others])
    return resolution, converted(costs, lambda work: to_ticks(_exact(work), resolution))


def _exact(work: Fraction) -> Fraction:
    return work if isinstance(work, Fraction) else Fraction(work)
