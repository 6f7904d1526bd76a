"""What a covariance form is."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

from filters.arrays import FloatArray
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

    product(A, B, out): writes A B, all (n, n), Eq. (16).
    propagation(Phi, P, Q, out, work): writes Phi P Phi^T + Q, all (n, n), Eqs. (8), (14) and (18); P may be work.nn3.

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
    propagation: Propagation
    gain: Gain
    covariance: Covariance
    delayed_covariance: DelayedCovariance
    cross: Cross
    factor: Factor
    cross_share: Cross
    cross_gain: Cross
    cross_update: CrossUpdate
