"""The extended filters on the planar vehicle: its Jacobians; dual-rate against the standard filter and the truth."""

from __future__ import annotations

import numpy as np
import pytest

from filters.history import History
from filters.registry import DELAYED_METHODS
from filters.simulation import simulate_truth
from filters.systems.navigation import Drive, simulate_drive

N, M, L, STEPS = 20, 8, 15, 2000


def test_jacobians_are_the_derivatives() -> None:
    drive = simulate_drive(STEPS, N, seed=0)
    system, x, u, step = drive.system, drive.truth.x[700], drive.inputs[700], 1e-6
    f_change, h_change = np.empty((6, 6)), np.empty((2, 6))
    for i, direction in enumerate(np.eye(6)):
        ahead, behind, seen_ahead, seen_behind = np.empty(6), np.empty(6), np.empty(2), np.empty(2)
        system.f(0, x + step * direction, u, system.parameters, ahead)
        system.f(0, x - step * direction, u, system.parameters, behind)
        system.h(0, x + step * direction, system.parameters, seen_ahead)
        system.h(0, x - step * direction, system.parameters, seen_behind)
        f_change[:, i] = (ahead - behind) / (2 * step)
        h_change[:, i] = (seen_ahead - seen_behind) / (2 * step)
    np.testing.assert_allclose(system.F(0, x, u, system.parameters), f_change, atol=1e-7)
    np.testing.assert_allclose(system.H(0, x, system.parameters), h_change, atol=1e-7)


def run(method: str, drive: Drive) -> History:
    arguments = (drive.system, N, M, L, drive.x0, drive.P0, drive.inputs, drive.truth.measurements)
    return DELAYED_METHODS[method].run(*arguments, backend="numpy")


def with_errors_scaled(factor: float) -> Drive:
    """A drive with all errors and noises, and what the filter knows of them, multiplied by this factor."""
    drive = simulate_drive(STEPS, N, seed=0)
    parameters = drive.system.parameters
    smaller = parameters._replace(Q=factor**2 * parameters.Q, R=factor**2 * parameters.R)
    system, P0 = drive.system._replace(parameters=smaller), factor**2 * drive.P0
    return Drive(system, drive.x0, P0, drive.inputs, simulate_truth(system, N, drive.x0, P0, drive.inputs, seed=0))


def distance_from_standard(method: str, drive: Drive) -> float:
    """The largest difference of a state outside [m, l - 1]."""
    landed = np.arange(STEPS + 1) % N >= L
    return float(np.abs(run(method, drive).x - run("standard", drive).x)[landed].max())


@pytest.mark.parametrize("method", ["recalculate", "larsen", "dual-rate"])
@pytest.mark.exhaust
def test_errors_are_within_their_covariance(method: str) -> None:
    """The normalised estimation error squared at k, where the state is a prediction, is 6 on average."""
    squares = []
    for seed in range(6):
        drive = simulate_drive(STEPS, N, seed)
        history = run(method, drive)
        k = np.arange(N, STEPS + 1, N)
        errors = history.x[k] - drive.truth.x[k]
        squares.append([e @ np.linalg.solve(P, e) for e, P in zip(errors, history.P_reference[1:], strict=True)])
    assert 5.0 < np.mean(squares) < 7.0
    assert np.max(squares) < 30.0  # exceeded once in 20000


def test_recalculation_is_the_extended_filter_itself() -> None:
    assert distance_from_standard("recalculate", with_errors_scaled(1.0)) < 1e-9


@pytest.mark.parametrize("method", ["larsen", "dual-rate"])
def test_extrapolation_tracks_the_extended_filter_to_second_order(method: str) -> None:
    """Phi_{k->l} is taken along the uncorrected trajectory: half the errors, a quarter of the difference."""
    whole, half = (distance_from_standard(method, with_errors_scaled(factor)) for factor in (1.0, 0.5))
    assert 0 < whole < 0.01  # metres, of errors of about a metre
    assert whole / half == pytest.approx(4.0, rel=0.15)
