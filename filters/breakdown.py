"""Whether a run has stayed with finite numbers and covariances.

It is looked at when the run is over, so that no job costs more: x at the end of every step, and every P_{k^-}, from
which the gains come. P is a covariance if it is finite and P + 1e-8 diag(P) has a Cholesky factor: rounding may have
left a little of what should be zero. So a singular P is one, for states that are known exactly or go together; a
negative variance is not, nor is a combination of states whose variance would be negative.
"""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, function_for
from filters.covariance_forms import CovarianceFormName
from filters.factored import FactoredFormName
from filters.history import History
from filters.kernels.definite import first_indefinite
from filters.noises import check_noises
from filters.problem import Problem
from filters.records import Estimate
from filters.rounding import check_rounding
from filters.system import System


def first_broken(x: FloatArray, P: FloatArray, every: int, backend: BackendName) -> int | None:
    """The first step in which x (steps, n) is not finite or P (any, n, n), of every so many steps, is no covariance."""
    unsound = ~np.isfinite(x).all(axis=1)
    steps = [int(unsound.argmax())] if unsound.any() else []
    c = function_for(backend, first_indefinite)(P, np.empty(P.shape[1:]))
    return min([*steps, *([int(c) * every] if c < len(P) else [])], default=None)


def check_history(
    history: History,
    x_reference: FloatArray | None,
    problem: Problem,
    every: int,
    remedy: str,
    backend: BackendName,
    coarse: System | None = None,
) -> History:
    """The history, if its estimates are finite, and its covariances, Q and R are some; innovations of what was lost
    become nan.

    x_reference (cycles, n): x_{k^-}; None if rounding is not to be looked for, as where P is an approximation.
    every: steps between the P_reference. remedy: what to do about rounding. coarse: what P comes from, if not from the
    system of the run.

    Raises:
        ValueError: they are not, or rounding has made them wrong, see `check_rounding`; the step is named, and the
            function of the system that is to blame, or the remedy.
    """
    steps, rows = len(problem.inputs), len(problem.measured.y)
    R = range(0, min(steps + 1, rows * every), every)
    if coarse is None:
        check_noises(problem.system, range(steps), R, backend)
    else:
        check_noises(coarse, range(0, steps + 1 - every, every), R, backend)
    broken = first_broken(history.x, history.P_reference, every, backend)
    if broken is None:
        if x_reference is not None:
            reference = Estimate(x_reference, history.P_reference)
            check_rounding(
                problem.system, history.x, reference, history.gains, problem.inputs, every, 1, remedy, backend
            )
        lost = ~problem.measured.present[: len(history.innovations)]
        return history._replace(innovations=np.where(lost, np.nan, history.innovations))
    since = range(max(0, broken - 2 * every), broken + 1)
    _check_model(problem, coarse, every, since, history.x)
    raise breakdown(broken, remedy)


def breakdown(step: int, remedy: str) -> ValueError:
    """The error that says in which step a filter left an estimate that is none."""
    return ValueError(
        f"step {step}: the covariance is no longer positive semidefinite, or a value no longer finite, for rounding "
        f"errors or the estimate have outgrown all bounds; {remedy}"
    )


def sturdier(update: CovarianceFormName, form: FactoredFormName = "conventional") -> str:
    """What to do where rounding is too much for these forms."""
    others = []
    if form == "conventional":
        others = [f"update={other!r}" for other in ("short", "joseph") if other != update]
        others += ["filters.multirate_gain with form='square-root' or 'u-d'"]
    return f"give {', or '.join([*others, 'a smaller P0 or more noise (Q, R)'])}"


def _check_model(problem: Problem, coarse: System | None, every: int, steps: range, x: FloatArray) -> None:
    """Raises ValueError that names the function of the system that gives no finite numbers."""
    system, slow = problem.system, problem.system if coarse is None else coarse
    state = x[steps[0]]
    for j in steps:
        sound = np.isfinite(x[j]).all()
        state = x[j] if sound else state
        at_k = j % every == 0
        if at_k or coarse is not None:
            expected = np.empty(system.measurements)
            system.h(j, state, system.parameters, expected)
            _check_finite(j, state, h=expected)
        if at_k:
            _check_finite(j, state, H=slow.H(j, state, slow.parameters))
        if not sound or j == len(problem.inputs):
            return
        following, u = np.empty(system.states), problem.inputs[j]
        system.f(j, state, u, system.parameters, following)
        _check_finite(j, state, f=following)
        if at_k or coarse is None:
            _check_finite(j, state, F=slow.F(j, state, u, slow.parameters))


def _check_finite(j: int, x: FloatArray, **values: FloatArray) -> None:
    for name, value in values.items():
        if not np.isfinite(value).all():
            raise ValueError(
                f"step {j}: {name} of the system gives a value that is not finite at the estimate x = {x}; mend the "
                f"model there, or start nearer to the truth"
            )
