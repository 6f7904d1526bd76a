"""Eqs. (18), (23) and (24) as they are printed, and what the approximations cost on a fixed example."""

from __future__ import annotations

import numpy as np
import pytest

from filters.arrays import FloatArray
from filters.delayed import dual_rate
from filters.systems.example import example_system
from tests.filters.cases import relative_difference, standard_run
from tests.strategies import problem


def printed_noise(name: str, Phi: list[FloatArray], Q: list[FloatArray]) -> FloatArray:
    """Q_{(k-N)->k} from the matrices of the N steps between."""
    N = len(Q)
    if name == "sum":
        return sum(Q)  # (23)
    if name == "euler":
        whole = np.linalg.multi_dot([*reversed(Phi), np.eye(len(Q[0]))])
        return sum(Q[N // 2 :]) + whole @ sum(Q[: N // 2]) @ whole.T  # (24)
    total = Q[0]
    for Phi_j, Q_j in zip(Phi[1:], Q[1:], strict=True):
        total = Phi_j @ total @ Phi_j.T + Q_j  # (18)
    return total


@pytest.mark.parametrize("noise", ["exact", "sum", "euler"])
@pytest.mark.parametrize("N", [2, 6, 7])
def test_low_rate_noise_is_as_printed(noise: str, N: int) -> None:
    """Without measurements P_{N^-} = Phi P_0 Phi^T + Q_{0->N}, Eq. (14). For odd N the first half is the shorter."""
    whole = problem(example_system(4, 1, 2, seed=1), N, 0, 1, N, seed=2)
    matrices = whole.system.parameters
    Phi = [matrices.Phi[j % len(matrices.Phi)] for j in range(N)]
    Q = [matrices.Q[j % len(matrices.Q)] for j in range(N)]
    product = np.linalg.multi_dot([*reversed(Phi), np.eye(4)])
    expected = product @ whole.P0 @ product.T + printed_noise(noise, Phi, Q)
    history = dual_rate.run(*whole._replace(measurements=whole.measurements[:0]), low_rate_noise=noise)
    np.testing.assert_allclose(history.P_reference[1], expected, rtol=1e-12, atol=1e-14)


def test_approximate_noise_makes_the_filter_suboptimal_and_euler_less_so() -> None:
    """The paper's N, M, L on the example system, in which Q is not small: how far P_{k^-} and x_j are from optimal."""
    whole = problem(example_system(), 10, 4, 8, 100, seed=1)
    optimal = standard_run(whole)
    covariance, state = {}, {}
    for noise in ("exact", "sum", "euler"):
        history = dual_rate.run(*whole, low_rate_noise=noise, backend="numpy")
        covariance[noise] = relative_difference(history.P_reference[1:], optimal.P_reference[1:])
        state[noise] = relative_difference(history.x[8::10], optimal.x[8::10])
    assert covariance["exact"] < 1e-12
    assert state["exact"] < 1e-12
    assert covariance["sum"] == pytest.approx(0.5119, abs=1e-4)
    assert covariance["euler"] == pytest.approx(0.0876, abs=1e-4)
    assert state["sum"] == pytest.approx(1.318e-2, abs=1e-5)
    assert state["euler"] == pytest.approx(9.004e-3, abs=1e-5)
