"""The step in closed form: a Kalman one-step prediction that also measures 0 = E_H x + E_D v and 0 = E_F x + E_G w."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.kernels.dense import add_matvec
from filters.kernels.place import clear, place
from filters.kernels.schur import add_diagonal, add_outer, complement, decorrelate
from filters.robust.records import Predicted, RobustModel, Weights


class ClosedWorkspace(NamedTuple):
    """Scratch arrays for l = p + t2 + t1 measurements, real and not, and n states that follow them."""

    rows: FloatArray  # (l + n, n), [H; E_H; E_F; F]
    measurement_noise: FloatArray  # (p + t2, q), [D; E_D]
    process_noise: FloatArray  # (t1 + n, m), [E_G; G]
    rows_times: FloatArray  # (l + n, n)
    measurement_noise_times: FloatArray  # (p + t2, q)
    process_noise_times: FloatArray  # (t1 + n, m)
    J: FloatArray  # (l + n, l + n), lower triangle
    values: FloatArray  # (l + n,)
    variances: FloatArray  # (l + n,)


def new_closed_workspace(model: RobustModel) -> ClosedWorkspace:
    """Scratch memory for `step_closed`."""
    n, m, q = len(model.F), model.G.shape[1], model.D.shape[1]
    measured, uncertain = len(model.H) + len(model.E_H), len(model.E_F)
    total = measured + uncertain + n
    return ClosedWorkspace(
        rows=np.zeros((total, n)),
        measurement_noise=np.zeros((measured, q)),
        process_noise=np.zeros((uncertain + n, m)),
        rows_times=np.zeros((total, n)),
        measurement_noise_times=np.zeros((measured, q)),
        process_noise_times=np.zeros((uncertain + n, m)),
        J=np.zeros((total, total)),
        values=np.zeros(total),
        variances=np.zeros(total),
    )


def step_closed(
    model: RobustModel,
    weights: Weights,
    before: Predicted,
    y: FloatArray,
    c: FloatArray,
    after: Predicted,
    work: ClosedWorkspace,
) -> None:
    """Job: x_{i|i-1} and P_{i|i-1} become x_{i+1|i} and P_{i+1|i}, for y (p,) and c (n,).

    The lower triangle of the joint matrix J of measurements and next state is formed; eliminating the measurements from
    it leaves P, which is therefore symmetric. The noise is made uncorrelated first: where E_D makes a measurement free
    of noise, the matrix of all measurements is hardly regular, and half the digits would be lost.
    """
    n, p, t1, t2 = len(model.F), len(model.H), len(model.E_F), len(model.E_H)
    measured, known = p + t2, p + t2 + t1
    place(model.H, 0, 0, work.rows)
    place(model.E_H, p, 0, work.rows)
    place(model.E_F, measured, 0, work.rows)
    place(model.F, known, 0, work.rows)
    place(model.D, 0, 0, work.measurement_noise)
    place(model.E_D, p, 0, work.measurement_noise)
    place(model.E_G, 0, 0, work.process_noise)
    place(model.G, t1, 0, work.process_noise)

    clear(work.J)
    place(weights.Phi2, 0, 0, work.J)
    add_diagonal(weights.inverse_lambda, p, known, work.J)
    place(weights.Phi1, known, known, work.J)
    add_outer(work.measurement_noise, model.R, 0, work.J, work.measurement_noise_times)
    add_outer(work.process_noise, model.Q, measured, work.J, work.process_noise_times)
    for i in range(known + n):
        work.values[i] = 0.0
    for i in range(p):
        work.values[i] = -y[i]
    for i in range(n):
        work.values[known + i] = c[i]
    decorrelate(known, work.J, work.rows, work.values, work.variances)
    add_matvec(work.rows, before.x, work.values)
    add_outer(work.rows, before.P, 0, work.J, work.rows_times)
    complement(known, work.J, work.values)
    for i in range(n):
        after.x[i] = work.values[known + i]
        for j in range(i + 1):
            after.P[i, j] = work.J[known + i, known + j]
            after.P[j, i] = work.J[known + i, known + j]
