"""Late measurements whose gain is carried: any number of them, of any sensors, in any order of arrival.

That a measurement is being taken is known in its step k, and the covariance does not depend on what it says. So P is
corrected in k, and only the estimate waits; see `in_flight`. Parts are linear or extended. Once nothing is in flight
the estimate is that of the filter which got each measurement undelayed: exactly for linear parts, to first order for
extended ones. Until then the gains of undelayed sensors count what has not landed yet.

The covariance in the history is that of the error of the estimate, P + sum of B S B^T, in every step.

In one step: first the late measurements that arrive, in the order in which they were taken, then those of the step
itself, in the sensors' order, then those that will come late are taken, in the sensors' order.

Taken is what is in the record, also what arrives after its end. A lost measurement is in it too, if it was taken: with
None in place of all its numbers, and the step in which the loss is known as that of its arrival; it is in flight until
then. One that is not in the record was not taken.

With products of transitions in place of gains this is Larsen's way where several are in flight, see `larsen`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache, partial
from heapq import heappop, heappush
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from filters.arrays import Flags, FloatArray
from filters.backends.choose import BackendName
from filters.kernels.dense import copy, copy_vector, store_vector
from filters.kernels.place import IntArray
from filters.kernels.solve import cholesky, solve_cholesky
from filters.modular.arrivals import LAST, Arrivals, arrivals
from filters.modular.breakdown import PREDICTOR, SOUND, Failure, failed
from filters.modular.composition import ModularFilter
from filters.modular.correction import Correction, correction
from filters.modular.correctors import Corrector
from filters.modular.estimate import copy_estimate, empty
from filters.modular.history import Estimates, ModularHistory
from filters.modular.in_flight import (
    InFlight,
    add_what_is_in_flight,
    carry_all,
    correct_all,
    innovate,
    land,
    new_in_flight,
    note,
    take_in,
)
from filters.modular.measurements import Measurement
from filters.modular.problem import check_linearised, check_problem
from filters.modular.running import run_kernel
from filters.modular.space import Space
from filters.modular.updates import Covariance, covariance_of
from filters.modular.workspace import Workspace
from filters.records import Estimate

LANDS, AT_ONCE, TAKEN = range(3)
"""What happens with a measurement in a step, in this order."""
MOST_IN_FLIGHT = 500
"""What each is in the innovation of each other takes memory."""


class Events(NamedTuple):
    """What happens, in order: in which step, with which of the measurements, what.

    place (measurements,): that of each late one among those in flight.
    """

    step: IntArray
    number: IntArray
    what: IntArray
    place: IntArray


class Given(NamedTuple):
    """What one event takes. place: among the flights."""

    of: Space
    flights: InFlight
    place: int
    what: int
    before: Estimate
    y: FloatArray
    lost: Flags
    after: Estimate


def carried_correction(composed: ModularFilter, corrector: Corrector) -> Callable[..., None]:
    """The job of this corrector of the filter: its part of one event."""
    covariance = covariance_of(composed.update, corrector.kind)
    return _correction_by(correction(composed, corrector), taking_by(corrector.expect, covariance))


@cache
def _correction_by(correct: Correction, take: Callable[..., None]) -> Callable[..., None]:
    """Same functions in, same function out, so that it is compiled once."""

    def use(view: Any, observed: Space, work: Workspace, case: Given) -> None:
        scratch = case.flights.scratch
        if case.what == LANDS:
            innovate(observed, case.y, case.flights.expected[case.place], work, scratch.zeta)
        elif case.what == TAKEN:
            take(view, observed, case.of, case.before, case.after, work)
            note(work, scratch)
        else:
            correct(view, observed, case.of, case.before, case.y, case.lost, case.after, work)
            note(work, scratch)

    return use


@cache
def taking_by(expect: Callable[..., None], covariance: Covariance) -> Callable[..., None]:
    """The correction of P by a measurement that is not there yet. Same functions in, same function out."""

    def take(view: Any, observed: Space, space: Space, before: Estimate, after: Estimate, work: Workspace) -> None:
        expect(view, observed, space, before, work)
        cholesky(work.S, work.pp1)
        solve_cholesky(work.pp1, work.cross, work.gain)
        copy_vector(before.x, after.x)
        covariance(view, before.P, after.P, work)

    return take


def filter_all(
    predict: Callable[..., None],
    use: Callable[..., None],
    is_sound: Callable[..., bool],
    motion: Any,
    parts: Any,
    places: IntArray,
    space: Space,
    dt: float,
    inputs: FloatArray,
    arrived: Arrivals,
    history: Estimates,
    failure: Failure,
    work: Workspace,
    events: Events,
    flights: InFlight,
    current: Estimate,
    scratch: Estimate,
) -> tuple[int, int]:
    """The whole filter as one kernel; `current` holds the prediction for step 0, history is filled.

    flights: none at the start. Returns as `recalculate.filter_all`.
    """
    following = 0
    for j in range(len(inputs) + 1):
        if j > 0:
            predict(motion, space, current, inputs[j - 1], dt, scratch, work)
            if not is_sound(space, scratch, work.nn1):
                return failed(PREDICTOR, j, current, scratch, failure)
            copy_estimate(scratch, current)
            carry_all(flights, work)
        while following < len(events.step) and events.step[following] == j:
            number = events.number[following]
            s, place, what = arrived.sensor[number], events.place[number], events.what[following]
            case = Given(space, flights, place, what, current, arrived.y[number], arrived.lost[number], scratch)
            use(places[s, 0], places[s, 1], parts, case)
            if what == LANDS:
                land(place, flights, arrived.lost[number], space, current, scratch)
            elif what == TAKEN:
                take_in(place, flights)
            else:
                correct_all(flights)
            if not is_sound(space, scratch, work.nn1):
                return failed(s, j, current, scratch, failure)
            copy_estimate(scratch, current)
            following += 1
        store_vector(current.x, history.x, j)
        copy(current.P, history.P[j])
        add_what_is_in_flight(flights, history.P[j])
    return SOUND, len(inputs)


def run(
    composed: ModularFilter,
    x0: ArrayLike,
    P0: ArrayLike,
    inputs: ArrayLike,
    measurements: Iterable[Measurement],
    *,
    backend: BackendName = "reference",
) -> ModularHistory:
    """Filter a record of data; the covariance counts each measurement when it is taken, the estimate when it arrives.

    Arguments and results as in `late.run`.

    Raises:
        ValueError: a part is unscented, which leaves no F or H; more than MOST_IN_FLIGHT are in flight at once; and as
            `late.run`.
    """
    check_linearised(composed, "carried-gain")
    x, P, moves = check_problem(composed, x0, P0, inputs)
    arrived = arrivals(composed, measurements, len(moves), LAST, awaited=True)[0]
    return run_in_flight(composed, Estimate(x, P), moves, arrived, backend, products=False)


def run_in_flight(
    composed: ModularFilter,
    start: Estimate,
    moves: FloatArray,
    arrived: Arrivals,
    backend: BackendName,
    *,
    products: bool,
) -> ModularHistory:
    """The same once all is checked; start is written to. products: they are carried in place of gains."""
    events = events_of(arrived, len(moves))
    places = int(events.place.max(initial=-1)) + 1
    if places > MOST_IN_FLIGHT:
        raise ValueError(
            f"{places} measurements are in flight at once, and there is room for {MOST_IN_FLIGHT}: leave out what "
            f"never arrives, give one that is lost the step in which that is known, or use late='recalculate'"
        )
    observed = [sensor.corrector.observed for sensor in composed.sensors]
    flights = new_in_flight(places, composed.of, observed, products=products)
    own = events, flights, start, empty(composed.of)
    job_of = partial(carried_correction, composed)
    return ModularHistory(*run_kernel(filter_all, job_of, composed, moves, arrived, own, backend))


def events_of(arrived: Arrivals, steps: int) -> Events:
    """What happens in so many steps, in the order that this module says."""
    late = np.flatnonzero(arrived.taken < arrived.arrives)
    at_once = np.flatnonzero(arrived.taken == arrived.arrives)
    lands = late[arrived.arrives[late] <= steps]
    number = np.concatenate([lands, at_once, late])
    what = np.repeat([LANDS, AT_ONCE, TAKEN], [len(lands), len(at_once), len(late)])
    step = np.concatenate([arrived.arrives[lands], arrived.taken[at_once], arrived.taken[late]])
    among = np.where(what == LANDS, arrived.taken[number], arrived.sensor[number])
    order = np.lexsort((number, among, what, step))
    step, number, what = step[order], number[order], what[order]
    return Events(step, number, what, _places(number, what, len(arrived.taken)))


def _places(number: IntArray, what: IntArray, count: int) -> IntArray:
    """Of each late measurement, the first that is free when it is taken."""
    place = np.full(count, -1, np.int64)
    free: list[int] = []
    used = 0
    for which, happens in zip(number, what, strict=True):
        if happens == TAKEN:
            if free:
                place[which] = heappop(free)
            else:
                place[which], used = used, used + 1
        elif happens == LANDS:
            heappush(free, place[which])
    return place
