"""The jobs of a composed filter of linear and extended parts with late measurements in flight, see `in_flight`.

Each starts from the same memory, which it copies first: done again and again on its own result it would vanish.
"""

from __future__ import annotations

from typing import Any

from filters.arrays import Flags, FloatArray
from filters.kernels.dense import copy
from filters.kernels.solve import cholesky, solve_cholesky
from filters.modular.arrivals import whole
from filters.modular.composition import ModularFilter
from filters.modular.estimate import empty
from filters.modular.in_flight import InFlight, carry, correct_carried, innovate, land, new_in_flight, note, take_in
from filters.modular.space import NOTHING, Space
from filters.modular.typical import Moment
from filters.modular.workspace import Workspace, new_workspace
from filters.records import Estimate

PLACES = 3
"""Of a landing: one was taken before it and one after it, and both are in flight."""


def carry_from(A: FloatArray, A_next: FloatArray, work: Workspace, scratch: FloatArray) -> None:
    """Job: what is carried of one measurement, a step on."""
    copy(A, A_next)
    carry(A_next, work, scratch)


def correct_beside(A: FloatArray, A_next: FloatArray, H: FloatArray, gain: FloatArray, scratch: FloatArray) -> None:
    """Job: what a correction does, besides, with what is carried of one measurement."""
    copy(A, A_next)
    correct_carried(A_next, H, gain, scratch)


def land_from(
    observed: Space,
    work: Workspace,
    of: Space,
    before: Estimate,
    y: FloatArray,
    lost: Flags,
    after: Estimate,
    start: InFlight,
    flights: InFlight,
) -> None:
    """Job: one lands."""
    for place in range(PLACES):
        flights.line[place] = place
        copy(start.A[place], flights.A[place])
        for other in range(PLACES):
            copy(start.T[place, other], flights.T[place, other])
    copy(start.known, flights.known)
    flights.waiting[0] = PLACES
    innovate(observed, y, flights.expected[1], work, flights.scratch.zeta)
    land(1, flights, lost, of, before, after)


def arguments_of_carrying(composed: ModularFilter, number: int, products: bool, at: Moment) -> tuple[Any, ...]:
    """Those of `carry_from`, of what is carried of a measurement by the sensor of this number."""
    space, predictor = composed.of, composed.predictor
    flights = _in_flight(composed, [number], products, at)
    work = new_workspace(space, NOTHING)
    predictor.predict(predictor.motion, space, at.estimate, at.u, composed.dt, empty(space), work)
    return flights.A[0], flights.A[1], work, flights.scratch.nw


def arguments_beside(composed: ModularFilter, number: int, products: bool, at: Moment) -> tuple[Any, ...]:
    """Those of `correct_beside`, of a correction by the sensor of this number while one of the longest is in flight."""
    longest = max(range(len(composed.sensors)), key=lambda each: composed.sensors[each].corrector.observed.errors)
    carried = _in_flight(composed, [longest], products, at)
    own = _in_flight(composed, [number], products, at)
    scratch = own.scratch.pw if products else carried.scratch.pw[: own.scratch.H.shape[0]].copy()
    return carried.A[0], carried.A[1], own.scratch.H, own.scratch.gain, scratch


def arguments_of_landing(composed: ModularFilter, number: int, products: bool, at: Moment) -> tuple[Any, ...]:
    """Those of `land_from`, by the sensor of this number, between two of its own."""
    space, observed = composed.of, composed.sensors[number].corrector.observed
    start, flights = (_in_flight(composed, [number] * PLACES, products, at) for _ in range(2))
    work, after = new_workspace(space, observed), empty(space)
    return observed, work, space, at.estimate, at.y[number], whole(observed), after, start, flights


def _in_flight(composed: ModularFilter, numbers: list[int], products: bool, at: Moment) -> InFlight:
    """Measurements by these sensors, all taken now, and a place that is free."""
    space, correctors = composed.of, [composed.sensors[number].corrector for number in numbers]
    flights = new_in_flight(len(numbers) + 1, space, [each.observed for each in correctors], products=products)
    for place, corrector in enumerate(correctors):
        work = new_workspace(space, corrector.observed)
        corrector.expect(corrector.view(space.errors), corrector.observed, space, at.estimate, work)
        cholesky(work.S, work.pp1)
        solve_cholesky(work.pp1, work.cross, work.gain)
        note(work, flights.scratch)
        take_in(place, flights)
    return flights
