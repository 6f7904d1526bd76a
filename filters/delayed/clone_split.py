"""Stochastic cloning with its work spread evenly over k and m: S is formed and factored at m, not at k.

Of k only W = P_{k^-} H_k^T and h(x_{k^-}) are needed at k; the steps to m - 1 carry W. At m nothing is carried (see
`clone`), so there is room for S. P - W S^-1 W^T is then p rank-one terms v v^T, of which half is computed, for P is
symmetric. To put terms off to the steps after m would not pay: to carry one takes 2 n^2 - n operations, to subtract it
n^2 + n.

One measurement is on its way at a time, M <= N. Where others are taken before one arrives, S is needed at the first of
them, N steps after k, and cannot wait for m: that is `clone`.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName
from filters.breakdown import check_history, sturdier
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.covariance_forms.form import CovarianceForm
from filters.delayed.clone import CARRY, sampled, start_arguments
from filters.delayed.cloned import Clone, correct, cross, divide
from filters.delayed.cloning import Cloning, Jobs
from filters.delayed.flights import steps
from filters.delayed.standard import PROPAGATE
from filters.history import History, HistoryRecorder
from filters.jobs import JobKind
from filters.measured import Measurements
from filters.problem import check_problem
from filters.records import Estimate, Sample, Workspace, new_estimate, new_workspace
from filters.running import running
from filters.sparse.structure import Structure
from filters.system import System


def split_form(name: CovarianceFormName, structure: Structure | None = None) -> CovarianceForm:
    """The form of this name; there is no update as it is printed, and in its place that of `short` is done."""
    form, by_terms = covariance_form(name, structure), covariance_form("short", structure)
    if name != "textbook":
        return form
    return form._replace(
        cross=by_terms.cross,
        factor=by_terms.factor,
        cross_share=by_terms.cross_share,
        cross_gain=by_terms.cross_gain,
        cross_update=by_terms.cross_update,
    )


def start(
    system: System, form: CovarianceForm, k: int, reference: Estimate, clone: Clone, work: Workspace
) -> FloatArray:
    """Job of step k: h(x_{k^-}) and W of the clone. Returns H_k."""
    return cross(system, form, k, reference, clone, work)


def late_update(
    system: System,
    form: CovarianceForm,
    k: int,
    y: FloatArray,
    H: FloatArray,
    clone: Clone,
    W: FloatArray,
    before: Estimate,
    after: Estimate,
    z: FloatArray,
    work: Workspace,
) -> None:
    """Job of step m, done before it propagates: S of step k and its factor, then as in `clone.cloned_update`.

    H (p, n): H_k. W (n, p): as carried to m - 1; clone.W is still that of k.
    """
    divide(system, form, k, H, clone, work)
    correct(form, y, clone, W, before, after, z, work)


@running("system")
def run(
    system: System,
    N: int,
    M: int,
    L: int,
    x0: FloatArray,
    P0: FloatArray,
    inputs: FloatArray,
    measurements: Measurements,
    *,
    update: CovarianceFormName = "textbook",
    backend: BackendName = "reference",
) -> History:
    """Filter a record of data in which the measurement of step k can be read from step m = k + M on.

    Arguments, results and errors as in `standard.run`. The correction is in the state of step m, whatever L is.
    """
    problem = check_problem(system, N, M, L, x0, P0, inputs, measurements)
    recorder = HistoryRecorder(system)
    form = split_form(update, problem.structure)
    cloning = Cloning(problem, system, form, Jobs(start, late_update), backend)
    for filtered in steps(cloning, problem, N, M, recorder):
        recorder.state(filtered.now.x)
    return check_history(recorder.history(), recorder.references().x, problem, N, sturdier(update), backend)


def _late_update(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    H, clone, W = sampled(system, at)
    z = np.zeros(system.measurements)
    return system, form, at.k, at.y, H, clone, W, at.now, new_estimate(system), z, new_workspace(system)


JOBS: tuple[JobKind[CovarianceForm], ...] = (
    PROPAGATE,
    ("start", start, start_arguments),
    CARRY,
    ("update", late_update, _late_update),
)
