"""PX4's output predictor: a filter at a delayed horizon, and an output that a complementary filter pulls after it.

PX4-Autopilot, src/modules/ekf2/EKF/output_predictor: at the horizon err = f_{j-D} - o_{j-D}; then o_j and all that is
kept of it, o_{j-D} .. o_j, are moved by g err + 0.1 g^2 (sum of err), with g = dt / tau.
"""

from __future__ import annotations

import numpy as np

from filters.accuracy.cyclic.engine import Cycle, Operation
from filters.accuracy.model import LinearModel
from filters.arrays import FloatArray


def predicted_output(model: LinearModel, C: FloatArray, N: int, D: int, g: float, K: FloatArray) -> Cycle:
    """Step 0 of the cycle is that in which a measurement is at the horizon, D steps after it was taken.

    Blocks: the error at the horizon; d_0 .. d_D; the sum of err. d_i is o_{j-i} less what the horizon's estimate,
    propagated to there by the inputs, would be: the noise of the last D steps is in both, so it is in no block, and the
    error of o_j is d_0 + Phi_D (error at the horizon) less that noise.
    """
    from scipy.sparse import csr_matrix, eye, kron

    n, d = model.states, (D + 3) * model.states
    kept = slice(n, (D + 2) * n)
    powers, since = [np.eye(n)], np.zeros((n, n))
    for _ in range(D):
        since = model.Phi @ since @ model.Phi.T + model.Q
        powers.append(model.Phi @ powers[-1])

    blocks = np.zeros((D + 3, D + 3))
    blocks[2 : D + 2, 1 : D + 1] = np.eye(D)  # d_{i-1} becomes d_i
    blocks[D + 2, D + 2] = 1.0
    moved = np.zeros((D + 3, D + 3))
    moved[0, 0] = moved[1, 1] = 1.0
    Q = np.zeros((d, d))
    Q[:n, :n] = model.Q
    propagate = Operation((kron(blocks, np.eye(n)) + kron(moved, model.Phi)).tocsr(), Q)

    on_all = np.zeros((d, n))  # what a correction at the horizon does to the blocks
    on_all[:n] = np.eye(n)
    on_all[kept] = -np.vstack(powers[::-1])  # d_i gets Phi^{D-i}
    gain = on_all @ K
    update = Operation(csr_matrix(np.eye(d) - gain @ model.H @ np.eye(n, d)), gain @ model.R @ gain.T)

    pulled = np.zeros((D + 3, D + 3))
    pulled[D + 2, D + 1] = -1.0  # err = -d_D
    pulled[1 : D + 2, D + 1] = -g - 0.1 * g**2
    pulled[1 : D + 2, D + 2] = 0.1 * g**2
    pull = Operation((eye(d) + kron(pulled, np.eye(n))).tocsr(), corrects=True)
    measured, every = (propagate, update, pull), (propagate, pull)
    output = np.hstack([C @ powers[D], C, np.zeros((len(C), d - 2 * n))])
    return Cycle((measured, *[every] * (N - 1)), output, C @ since @ C.T)
