"""The highest rate of the HR loop at which a design still meets every deadline, with all else held in seconds."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from sched_sim.design.least_speed import has_closed_form
from sched_sim.design.options import Options
from sched_sim.design.pieces import Costs
from sched_sim.design.rate_pieces import Pieces
from sched_sim.design.times import Times
from sched_sim.schedule.tasks import Task


def highest_rate(
    costs: Costs, times: Times, hr_hz: Fraction, options: Options = Options(), tasks: Sequence[Task] = ()
) -> Fraction | None:
    """The highest rate, in Hz, at which every deadline holds, rounded down to four digits, or to as many as it takes to
    fit; None if there is none.

    The rate of measurements, the delay, the time by which corrections land and the periods of the tasks stay what
    they are in seconds. costs: in seconds. hr_hz: the rate of which the tasks are in HR periods; what is found does
    not hang on it. The tasks' phases may be any, for at most rates they drift through the HR period; but at rates
    at which the period of a task of given offset is a whole number of HR periods its phase is locked, and tasks
    have there the offsets that are given, in seconds: of these rates `rate_search.LOCKED_LOOKS` above what fits at
    any phase are looked at, from the top, spread over all where there are more.

    It is exact where there is a closed form (`has_closed_form`). With several dual-rate corrections on their way,
    tasks, context switches or earliest deadline first it is found by bisection from above, which takes for granted
    that a lower rate fits where a higher one does; then `rate_search.LOOKS` of the rates above at which N, M or L
    is another, spread over all where there are more, are looked at from the top. A rate that is higher still may
    fit.
    """
    pieces = Pieces.of(costs, times, options)
    if has_closed_form(options, tasks) and pieces.one_in_flight:
        return pieces.highest()
    from sched_sim.design.rate_search import Search

    return Search(pieces, tuple(tasks), hr_hz).highest()
