"""The least work: H P is formed once and serves as (P H^T)^T too, S is factored, and Eq. (11) needs one thin product.

Products are blocked, and sums are made within them. Solves run along the rows of (p, n) matrices, which are longer than
those of (n, p) ones.
"""

from __future__ import annotations

from filters.arrays import FloatArray
from filters.covariance_forms.form import dense_form
from filters.kernels.dense import (
    add,
    add_matmul_blocked,
    add_vectors,
    divide_rows,
    matmul_blocked,
    matmul_narrow,
    matmul_transposed_narrow,
    matvec,
    mirror,
    negate,
    place_diagonal,
    subtract_lower_product,
    transpose,
)
from filters.kernels.sequential import (
    solve_unit_lower,
    solve_unit_lower_transposed,
    solve_unit_lower_vector,
    unit_lower_factors,
)
from filters.kernels.solve import cholesky, solve_cholesky
from filters.records import Estimate, Workspace


def propagation(Phi: FloatArray, P: FloatArray, Q: FloatArray, out: FloatArray, work: Workspace) -> None:
    """Phi P Phi^T + Q, Eqs. (8), (14) and (18)."""
    matmul_blocked(Phi, P, work.nn1)
    transpose(Phi, work.nn2)
    add_matmul_blocked(Q, work.nn1, work.nn2, out)
    mirror(out)


def gain(P: FloatArray, H: FloatArray, R: FloatArray, K: FloatArray, work: Workspace) -> None:
    """K^T = S^-1 (H P), Eq. (9) for symmetric P, from the Cholesky factor of S. Leaves H P."""
    matmul_blocked(H, P, work.HP)
    matmul_transposed_narrow(work.HP, H, work.S)
    add(work.S, R, work.S)  # innovation covariance
    cholesky(work.S, work.pp1)
    solve_cholesky(work.pp1, work.HP, work.pn1)
    transpose(work.pn1, K)


def covariance(P: FloatArray, _H: FloatArray, _R: FloatArray, K: FloatArray, out: FloatArray, work: Workspace) -> None:
    """P_{k^+} = P - K (H P), equal to Eq. (11)."""
    negate(K, work.np1)
    add_matmul_blocked(P, work.np1, work.HP, out)
    mirror(out)


def delayed_covariance(
    Phi: FloatArray,
    _P: FloatArray,
    _H: FloatArray,
    _R: FloatArray,
    K: FloatArray,
    P_m: FloatArray,
    out: FloatArray,
    work: Workspace,
) -> None:
    """P_{m^+} = P_{m^-} - (Phi K) (H P Phi^T), equal to Eq. (21)."""
    matmul_narrow(Phi, K, work.np1)
    negate(work.np1, work.np1)
    transpose(Phi, work.nn1)
    matmul_blocked(work.HP, work.nn1, work.pn1)
    add_matmul_blocked(P_m, work.np1, work.pn1, out)
    mirror(out)


def cross(P: FloatArray, H: FloatArray, W: FloatArray, work: Workspace) -> None:
    """(H P)^T, equal to P H^T for symmetric P."""
    matmul_blocked(H, P, work.HP)
    transpose(work.HP, W)


def factor(S: FloatArray, out: FloatArray, work: Workspace) -> None:
    """S = L D L^T, which takes no roots: L below the diagonal, D on it."""
    unit_lower_factors(S, out, work.p1)
    place_diagonal(work.p1, out)


def cross_share(C: FloatArray, L_D: FloatArray, G: FloatArray, work: Workspace) -> None:
    """G^T = L^-T D^-1 L^-1 C^T."""
    transpose(C, work.pp1)
    solve_unit_lower(L_D, work.pp1, work.pp1)
    divide_rows(work.pp1, L_D, work.pp1)
    solve_unit_lower_transposed(L_D, work.pp1, work.pp1)
    transpose(work.pp1, G)


def cross_gain(W: FloatArray, S: FloatArray, K: FloatArray, work: Workspace) -> None:
    """K^T = S^-1 W^T, from the Cholesky factor of S."""
    transpose(W, work.HP)
    cholesky(S, work.pp1)
    solve_cholesky(work.pp1, work.HP, work.pn1)
    transpose(work.pn1, K)


def cross_update(
    before: Estimate, W: FloatArray, _S: FloatArray, L_D: FloatArray, z: FloatArray, after: Estimate, work: Workspace
) -> None:
    """x + G (L^-1 z) and P - V G^T with V = W L^-T and G = V D^-1.

    These are p measurements with uncorrelated noise, V G^T one term v v^T / d for each, of which half is computed.
    """
    transpose(W, work.HP)
    solve_unit_lower(L_D, work.HP, work.HP)
    divide_rows(work.HP, L_D, work.pn1)
    solve_unit_lower_vector(L_D, z, work.p1)
    transpose(work.pn1, work.np1)
    matvec(work.np1, work.p1, work.n1)
    add_vectors(before.x, work.n1, after.x)
    subtract_lower_product(before.P, work.HP, work.pn1, after.P)
    mirror(after.P)


FORM = dense_form(
    matmul_blocked,
    propagation,
    gain,
    covariance,
    delayed_covariance,
    cross,
    factor,
    cross_share,
    cross_gain,
    cross_update,
)
