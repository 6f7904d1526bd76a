"""What a covariance form is."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

from filters.arrays import FloatArray
from filters.kernels.dense import matmul_narrow, matvec
from filters.records import Estimate, Workspace

Product: TypeAlias = Callable[[FloatArray, FloatArray, FloatArray], None]
Propagation: TypeAlias = Callable[[FloatArray, FloatArray, FloatArray, FloatArray, Workspace], None]
Gain: TypeAlias = Callable[[FloatArray, FloatArray, FloatArray, FloatArray, Workspace], None]
Covariance: TypeAlias = Callable[[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray, Workspace], None]
DelayedCovariance: TypeAlias = Callable[
    [FloatArray, FloatArray, FloatArray, FloatArray, FloatArray, FloatArray, FloatArray, Workspace], None
]
Cross: TypeAlias = Callable[[FloatArray, FloatArray, FloatArray, Workspace], None]
Factor: TypeAlias = Callable[[FloatArray, FloatArray, Workspace], None]
CrossUpdate: TypeAlias = Callable[[Estimate, FloatArray, FloatArray, FloatArray, FloatArray, Estimate, Workspace], None]


class CovarianceForm(NamedTuple):
    """The places in which forms differ: everything that takes a product of matrices.

    Covariances come out exactly symmetric: the lower triangle is mirrored, at no operation. What is antisymmetric in P
    never gets smaller in P - (H P)^T S^-1 (H P) and grows with Phi of an unstable plant.

    What is the same arithmetic has a place for each kind of matrix that it is done with: of one step, Phi_j and Q_j; of
    several, Phi_{k->j} and Q_{k->j}. All are (n, n):
    product(Phi, A, out): writes Phi_j A.
    accumulation(Phi, Phi_from_k, out): writes Phi_j Phi_{k->j}, Eq. (16).
    propagation(Phi, P, Q, out, work): writes Phi_j P Phi_j^T + Q_j, Eq. (8).
    noise(Phi, Q_from_k, Q, out, work): writes Phi_j Q_{k->j} Phi_j^T + Q_j, Eq. (18).
    cycle(Phi_from_k, P, Q_from_k, out, work): writes Phi_{k->j} P Phi_{k->j}^T + Q_{k->j}, Eq. (14); P may be work.nn3.
    carry(Phi, W, out): writes Phi_j W, for W (n, p).
    error(Phi_from_k, delta_x, out): writes Phi_{k->j} delta_x, Eq. (13).
    expectation(H, W, out): writes H_k W, for W (n, p).

    The others take P_{k^-} (n, n), H_k (p, n), R_k (p, p), K_k (n, p).
    gain(P, H, R, K, work): writes K, Eq. (9); leaves S = H P H^T + R in work.S.
    covariance(P, H, R, K, out, work): writes P_{k^+}, Eq. (11), right after `gain`.
    delayed_covariance(Phi, P, H, R, K, P_m, out, work): writes P_{m^+} from Phi_{k->m} and P_{m^-}, Eq. (21), right
    after `gain`.

    Of a measurement of which W = Phi_{k->j} P_{k^-} H_k^T (n, p) is carried, the covariance of the state of j with what
    is expected of the measurement, and S (p, p), the innovation covariance:
    cross(P, H, W, work): writes P H^T, which is W at k.
    factor(S, out, work): writes what divides by S, (p, p): its inverse, or factors.
    cross_share(C, factor, G, work): writes C S^-1, for the covariance C (p, p) of what is expected of another
    measurement with what is expected of this one; C may be work.S.
    cross_gain(W, S, K, work): writes W S^-1, which is K_k at k.
    cross_update(before, W, S, factor, z, after, work): writes x + W S^-1 z and P - W S^-1 W^T, for the innovation z.
    """

    product: Product
    accumulation: Product
    propagation: Propagation
    noise: Propagation
    cycle: Propagation
    carry: Product
    error: Product
    expectation: Product
    gain: Gain
    covariance: Covariance
    delayed_covariance: DelayedCovariance
    cross: Cross
    factor: Factor
    cross_share: Cross
    cross_gain: Cross
    cross_update: CrossUpdate


def dense_form(
    product: Product,
    propagation: Propagation,
    gain: Gain,
    covariance: Covariance,
    delayed_covariance: DelayedCovariance,
    cross: Cross,
    factor: Factor,
    cross_share: Cross,
    cross_gain: Cross,
    cross_update: CrossUpdate,
) -> CovarianceForm:
    """That which multiplies all entries, whatever matrices they are of."""
    return CovarianceForm(
        product=product,
        accumulation=product,
        propagation=propagation,
        noise=propagation,
        cycle=propagation,
        carry=matmul_narrow,
        error=matvec,
        expectation=matmul_narrow,
        gain=gain,
        covariance=covariance,
        delayed_covariance=delayed_covariance,
        cross=cross,
        factor=factor,
        cross_share=cross_share,
        cross_gain=cross_gain,
        cross_update=cross_update,
    )
