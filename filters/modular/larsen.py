"""Larsen's measurement extrapolation for filters of linear and extended parts: nothing is done again.

The correction that a late measurement would have made in the step k in which it was taken is carried to the step m in
which it arrives. Larsen, Andersen, Ravn and Poulsen, Incorporation of time delayed measurements in a discrete-time
Kalman filter, CDC 1998; Steffes 2014, Eqs. (20) and (21), where no other sensor measures in between. With e the error:

    M <- I at k, M <- F M in each prediction, M <- (I - K H) M in each correction by another sensor in between
    x_m <- x_m + M K_k z_k,    P_m <- P_m - M K_k S_k K_k^T M^T,    K_k = P_k H_k^T S_k^-1

e_m = M e_k + noise that is independent of e_k and of the measurement's own, so that P_m stays the covariance of the
error. The estimate is the best one, that of `recalculate`, only if no other sensor measured in between: what these say
about e_k is not used.

In one step: first the late measurement that arrives, then those of the step itself, in the sensors' order, then one
that will come late is taken. So a delay as long as the time between the measurements is allowed. Several of
one sensor and one step may be in flight together: when one has arrived, what was known in k is corrected by it as well.

Where others are taken before one has arrived, in whatever order they do, the gain K_k has to be that of a filter which
knows them all: then, in the whole record, P counts each from the step in which it is taken, as in `carried_gain`, and
of each in flight a product M of its own is carried, with its gain K_k. Once nothing is in flight the estimate is that
of the filter which got each undelayed, whatever other sensors measured in between.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache, partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from filters.arrays import Flags, FloatArray
from filters.backends.choose import BackendName
from filters.kernels.dense import (
    add_matmul_blocked,
    copy,
    matmul_blocked,
    matmul_transposed_narrow,
    matvec,
    mirror,
    store,
    store_vector,
    subtract,
    transpose,
)
from filters.kernels.place import IntArray
from filters.modular.arrivals import Arrivals, arrivals, chosen
from filters.modular.breakdown import PREDICTOR, SOUND, Failure, failed
from filters.modular.carried_gain import run_in_flight
from filters.modular.composition import ModularFilter
from filters.modular.correction import Correction, correction
from filters.modular.correctors import Corrector, estimate_error
from filters.modular.estimate import copy_estimate, empty
from filters.modular.history import Estimates, ModularHistory
from filters.modular.measurements import Measurement
from filters.modular.problem import check_linearised, check_problem
from filters.modular.running import run_kernel
from filters.modular.space import Space, plus
from filters.modular.updates import joseph, short
from filters.modular.workspace import Workspace
from filters.records import Estimate


class Flight(NamedTuple):
    """What is kept of the step in which a measurement was taken that is not there yet.

    reference: the estimate of then. M (n, n): what has become of an error of then.
    """

    reference: Estimate
    M: FloatArray


class Given(NamedTuple):
    """What one correction takes.

    late: the measurement was taken at the flight's reference; otherwise now. waiting: one is in flight.
    """

    of: Space
    flight: Flight
    late: bool
    waiting: bool
    before: Estimate
    y: FloatArray
    lost: Flags
    after: Estimate


def accumulate(M: FloatArray, work: Workspace) -> None:
    """M <- F M, once a prediction has left F in work."""
    matmul_blocked(work.F, M, work.nn1)
    copy(work.nn1, M)


def larsen_correction(composed: ModularFilter, corrector: Corrector) -> Callable[..., None]:
    """The job of this corrector of the filter, see `_correction_by`."""
    late = _late_joseph if composed.update == "joseph" else _late_short
    return _correction_by(corrector.expect, correction(composed, corrector), late)


@cache
def _correction_by(
    expect: Callable[..., None], correct: Correction, correct_late: Callable[..., None]
) -> Callable[..., None]:
    """Job: `after` is `before`, corrected by a measurement, late or not; M is kept up if one is waited for.

    Same functions in, same function out, so that it is compiled once.
    """

    def use(view: Any, observed: Space, work: Workspace, case: Given) -> None:
        if case.late:
            expect(view, observed, case.of, case.flight.reference, work)
            correct_late(view, observed, work, case)
        else:
            correct(view, observed, case.of, case.before, case.y, case.lost, case.after, work)
            if case.waiting:
                _condition(case.flight.M, work)

    return use


def _late_short(view: Any, observed: Space, work: Workspace, case: Given) -> None:
    """The covariance of z_k with e_k becomes that with e_m, and so K_k becomes M K_k."""
    matmul_transposed_narrow(work.cross, case.flight.M, work.gain)
    copy(work.gain, work.cross)
    estimate_error(observed, case.of, case.y, case.lost, work)
    plus(case.of, case.before.x, work.n1, case.after.x)
    short(view, case.before.P, case.after.P, work)


def _late_joseph(view: Any, observed: Space, work: Workspace, case: Given) -> None:
    """P_m <- P_m - M (P_k - P_k') M^T, with P_k' in Joseph's form."""
    reference, M = case.flight
    estimate_error(observed, case.of, case.y, case.lost, work)
    matvec(M, work.n1, work.n2)
    plus(case.of, case.before.x, work.n2, case.after.x)
    joseph(view, reference.P, case.after.P, work)
    subtract(case.after.P, reference.P, work.nn1)
    matmul_blocked(M, work.nn1, work.nn2)
    transpose(M, work.nn3)
    add_matmul_blocked(case.before.P, work.nn2, work.nn3, case.after.P)
    mirror(case.after.P)


def _condition(M: FloatArray, work: Workspace) -> None:
    """M <- M - K (H M)."""
    matmul_blocked(work.H, M, work.cross)
    for r in range(work.gain.shape[0]):
        for i in range(M.shape[0]):
            factor = work.gain[r, i]
            for j in range(M.shape[1]):
                M[i, j] -= factor * work.cross[r, j]


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
    late: Flags,
    taken_late: IntArray,
    current: Estimate,
    scratch: Estimate,
    flight: Flight,
) -> tuple[int, int]:
    """The whole filter as one kernel; `current` holds the prediction for step 0, history is filled.

    arrived: in the order of use. late (count,): which of them were taken before. taken_late (steps + 1,): how many of
    these in each step. Returns as `recalculate.filter_all`.
    """
    following = 0
    waiting = 0
    for j in range(len(inputs) + 1):
        if j > 0:
            predict(motion, space, current, inputs[j - 1], dt, scratch, work)
            if not is_sound(space, scratch, work.nn1):
                return failed(PREDICTOR, j, current, scratch, failure)
            copy_estimate(scratch, current)
            if waiting > 0:
                accumulate(flight.M, work)
        while following < len(arrived.arrives) and arrived.arrives[following] == j:
            s = arrived.sensor[following]
            y, lost = arrived.y[following], arrived.lost[following]
            case = Given(space, flight, late[following], waiting > 0, current, y, lost, scratch)
            use(places[s, 0], places[s, 1], parts, case)
            if not is_sound(space, scratch, work.nn1):
                return failed(s, j, flight.reference if late[following] else current, scratch, failure)
            copy_estimate(scratch, current)
            if late[following]:
                waiting -= 1
            if late[following] and waiting > 0:  # another of that step is to come: what was known then is more now
                case = Given(space, flight, False, False, flight.reference, y, lost, scratch)
                use(places[s, 0], places[s, 1], parts, case)
                copy_estimate(scratch, flight.reference)
            following += 1
        if taken_late[j] > 0:
            waiting = taken_late[j]
            copy_estimate(current, flight.reference)
            for i in range(space.errors):
                for e in range(space.errors):
                    flight.M[i, e] = 1.0 if i == e else 0.0
        store_vector(current.x, history.x, j)
        store(current.P, history.P, j)
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
    """Filter a record of data; each measurement is used in the step in which it arrives.

    Arguments and results as in `late.run`.

    Raises:
        ValueError: a part is unscented, which leaves no F or H; and as `late.run`.
    """
    check_linearised(composed, "larsen")
    x, P, moves = check_problem(composed, x0, P0, inputs)
    steps = len(moves)
    arrived = _in_order_of_use(arrivals(composed, measurements, steps, steps)[0])
    late = arrived.taken < arrived.arrives
    if _several_in_flight(arrived, late):
        return run_in_flight(composed, Estimate(x, P), moves, arrived, backend, products=True)
    taken_late = np.bincount(arrived.taken[late], minlength=steps + 1)
    own = late, taken_late, Estimate(x, P), empty(composed.of), Flight(empty(composed.of), np.empty_like(P))
    job_of = partial(larsen_correction, composed)
    return ModularHistory(*run_kernel(filter_all, job_of, composed, moves, arrived, own, backend))


def _in_order_of_use(arrived: Arrivals) -> Arrivals:
    """In each step those taken before come first, then those of the step in the sensors' order."""
    order = np.lexsort((arrived.sensor, arrived.taken == arrived.arrives, arrived.arrives))
    return chosen(arrived, order)


def _several_in_flight(arrived: Arrivals, late: Flags) -> bool:
    """Whether one is taken, not together with the other, before another late one has arrived."""
    rows = np.flatnonzero(late)
    rows = rows[np.lexsort((arrived.arrives[rows], arrived.taken[rows]))]
    first, second = rows[:-1], rows[1:]  # of those that go together the last to arrive comes last
    together = (arrived.taken[first] == arrived.taken[second]) & (arrived.sensor[first] == arrived.sensor[second])
    return bool(((arrived.taken[second] < arrived.arrives[first]) & ~together).any())
