"""The parts against FilterPy, against the document's equations written out in NumPy, and against one another."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from filterpy.kalman import ExtendedKalmanFilter, KalmanFilter, MerweScaledSigmaPoints, UnscentedKalmanFilter
from hypothesis import given
from hypothesis import strategies as st

from filters.arrays import FloatArray
from filters.modular import (
    Measurement,
    ModularFilter,
    ModularHistory,
    Sensor,
    extended_corrector,
    extended_predictor,
    linear_corrector,
    linear_predictor,
    maccormack,
    merwe,
    observe,
    run,
    unscented_corrector,
    unscented_predictor,
)
from filters.modular.correctors import Corrector
from filters.modular.predictors import Predictor
from filters.modular.sigma_points import weights

STEPS, DT, N = 8, 0.2, 3
F = np.array([[1.0, DT, 0.02], [0.0, 1.0, DT], [-0.1, 0.0, 0.9]])
H = np.array([[1.0, 0.0, 0.5], [0.0, 1.0, -0.2]])
Q = np.array([[0.02, 0.01, 0.0], [0.01, 0.03, 0.0], [0.0, 0.0, 0.05]])
R = np.array([[0.3, 0.1], [0.1, 0.2]])
X0 = np.array([1.0, -0.5, 0.3])
P0 = np.array([[0.5, 0.1, 0.0], [0.1, 0.4, 0.1], [0.0, 0.1, 0.3]])


def turning(x: FloatArray, _u: FloatArray, dt: float, out: FloatArray) -> None:
    out[0] = x[0] + dt * np.cos(x[1])
    out[1] = x[1] + dt * x[2]
    out[2] = x[2] - dt * x[0] * x[2]


def turning_jacobian(x: FloatArray, _u: FloatArray, dt: float, out: FloatArray) -> None:
    out[:] = [[1, -dt * np.sin(x[1]), 0], [0, 1, dt], [-dt * x[2], 0, 1 - dt * x[0]]]


def distance(x: FloatArray, out: FloatArray) -> None:
    out[0] = np.sqrt(4.0 + x[0] * x[0])
    out[1] = x[1] * x[2]


def distance_jacobian(x: FloatArray, out: FloatArray) -> None:
    out[:] = [[x[0] / np.sqrt(4.0 + x[0] * x[0]), 0, 0], [0, x[2], x[1]]]


def linear_motion(x: FloatArray, _u: FloatArray, _dt: float, out: FloatArray) -> None:
    out[:] = F @ x


def linear_motion_jacobian(_x: FloatArray, _u: FloatArray, _dt: float, out: FloatArray) -> None:
    out[:] = F


def linear_view(x: FloatArray, out: FloatArray) -> None:
    out[:] = H @ x


def linear_view_jacobian(_x: FloatArray, out: FloatArray) -> None:
    out[:] = H


def of_model(model: Callable[..., None], size: int) -> Callable[..., FloatArray]:
    """The model in FilterPy's form: it returns what ours writes."""

    def returning(*arguments: Any) -> FloatArray:
        out = np.empty(size)
        model(*arguments, out)
        return out

    return returning


f = of_model(lambda x, dt, out: turning(x, np.empty(0), dt, out), N)
h = of_model(distance, 2)


def filtered(predictor: Predictor, corrector: Corrector) -> tuple[ModularHistory, FloatArray]:
    """What the filter makes of measurements in every step but the first, and these."""
    composed = ModularFilter(predictor, [Sensor("only", corrector)], DT)
    truth = np.linspace(X0, X0 + 1, STEPS + 1)
    measurements = [one for one in observe(composed, truth, seed=5) if one.taken > 0]
    history = run(composed, X0, P0, np.zeros((STEPS, 0)), measurements, backend="reference")
    return history, np.array([one.y for one in measurements])


def agree(found: ModularHistory, x: Any, P: Any, tolerance: float = 1e-9) -> None:
    np.testing.assert_allclose(found.x[1:], x, rtol=tolerance, atol=tolerance)
    np.testing.assert_allclose(found.P[1:], P, rtol=tolerance, atol=tolerance)


def started(kalman: Any) -> Any:
    kalman.x, kalman.P, kalman.Q, kalman.R = X0.copy(), P0.copy(), Q, R
    return kalman


def test_linear_equals_filterpy() -> None:
    found, measured = filtered(linear_predictor(F, Q), linear_corrector(H, R))
    kalman = started(KalmanFilter(dim_x=N, dim_z=2))
    kalman.F, kalman.H = F, H
    agree(found, *kalman.batch_filter(measured)[:2])


@pytest.mark.parametrize(
    ("of_motion", "of_view", "tolerance"), [(turning_jacobian, distance_jacobian, 1e-9), (None, None, 1e-6)]
)
def test_extended_equals_filterpy(of_motion: Any, of_view: Any, tolerance: float) -> None:
    """Without Jacobians as well as differences give them."""
    found, measured = filtered(extended_predictor(turning, Q, of_motion), extended_corrector(distance, R, of_view))
    kalman = started(ExtendedKalmanFilter(dim_x=N, dim_z=2))
    x, P = [], []
    for y in measured:
        kalman.F = np.empty((N, N))
        turning_jacobian(kalman.x, np.empty(0), DT, kalman.F)
        moved = f(kalman.x, DT)
        kalman.predict()
        kalman.x = moved  # FilterPy's prediction of the state is linear, of the covariance extended
        jacobian = np.empty((2, N))
        distance_jacobian(kalman.x, jacobian)
        kalman.update(y, lambda _x, H_of_x=jacobian: H_of_x, h)
        x.append(kalman.x)
        P.append(kalman.P)
    agree(found, x, P, tolerance)


@pytest.mark.parametrize("points", [(1.0, 2.0, 0.0), (0.5, 2.0, 1.0), (0.1, 0.0, -1.0)])
def test_unscented_equals_filterpy(points: tuple[float, float, float]) -> None:
    form = merwe(*points)
    found, measured = filtered(unscented_predictor(turning, Q, form), unscented_corrector(distance, R, form))
    theirs = MerweScaledSigmaPoints(N, *points)
    kalman = started(UnscentedKalmanFilter(N, 2, DT, h, f, theirs))
    agree(found, *kalman.batch_filter(measured))


@pytest.mark.parametrize("points", [(1.0, 2.0, 3.0), (0.7, 1.0, 2.0), (1.2, 2.0, 1.0)])
def test_unscented_equals_the_documents_equations(points: tuple[float, float, float]) -> None:
    """MacCormack and Rubinstein, Unscented Kalman Filter Update; its D is P, its b is y."""
    form = maccormack(*points)
    found, measured = filtered(unscented_predictor(turning, Q, form), unscented_corrector(distance, R, form))
    alpha, beta, kappa = points
    w_m = np.full(2 * N + 1, 1 / (2 * alpha**2 * kappa))
    w_c = w_m.copy()
    w_m[0] = (alpha**2 * kappa - N) / (alpha**2 * kappa)
    w_c[0] = w_m[0] - alpha**2 + beta

    def sigma_points(x: FloatArray, D: FloatArray) -> FloatArray:
        columns = alpha * np.linalg.cholesky(kappa * D).T
        return np.vstack([x, x + columns, x - columns])

    x, D = X0, P0
    for b, found_x, found_P in zip(measured, found.x[1:], found.P[1:], strict=True):
        moved = np.array([f(point, DT) for point in sigma_points(x, D)])
        x_hat = w_m @ moved
        D_hat = (moved - x_hat).T @ np.diag(w_c) @ (moved - x_hat) + Q
        points_hat = sigma_points(x_hat, D_hat)
        z = np.array([h(point) for point in points_hat])
        z_hat = w_m @ z
        S = (z - z_hat).T @ np.diag(w_c) @ (z - z_hat) + R
        T = (points_hat - x_hat).T @ np.diag(w_c) @ (z - z_hat)
        K = T @ np.linalg.inv(S)
        x, D = x_hat + K @ (b - z_hat), D_hat - K @ S @ K.T
        np.testing.assert_allclose(found_x, x, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(found_P, D, rtol=1e-9, atol=1e-9)


alphas, betas, kappas = st.floats(0.01, 2), st.floats(-2, 5), st.floats(0.1, 10)


@given(alphas, betas, kappas, st.integers(1, 12))
def test_weights_sum_to_one(alpha: float, beta: float, kappa: float, n: int) -> None:
    for form, beyond in ((merwe, 1 - alpha**2 + beta), (maccormack, -(alpha**2) + beta)):
        found = weights(form(alpha, beta, kappa), n)
        assert found.mean_0 + 2 * n * found.other == pytest.approx(1, abs=1e-14 * max(1, abs(found.mean_0)))
        assert found.covariance_0 - found.mean_0 == pytest.approx(beyond, abs=1e-14 * max(1, abs(found.mean_0)))


PREDICTORS = {
    "linear": linear_predictor(F, Q),
    "extended": extended_predictor(linear_motion, Q, linear_motion_jacobian),
    "numeric": extended_predictor(linear_motion, Q),
    "merwe": unscented_predictor(linear_motion, Q, merwe(0.5, 2.0, 1.0)),
    "maccormack": unscented_predictor(linear_motion, Q, maccormack()),
}
CORRECTORS = {
    "linear": linear_corrector(H, R),
    "extended": extended_corrector(linear_view, R, linear_view_jacobian),
    "numeric": extended_corrector(linear_view, R),
    "merwe": unscented_corrector(linear_view, R, merwe(0.5, 2.0, 1.0)),
    "maccormack": unscented_corrector(linear_view, R, maccormack()),
}


@pytest.mark.parametrize("corrector", CORRECTORS)
@pytest.mark.parametrize("predictor", PREDICTORS)
def test_on_a_linear_system_every_mix_equals_the_linear_filter(predictor: str, corrector: str) -> None:
    expected, _ = filtered(PREDICTORS["linear"], CORRECTORS["linear"])
    found, _ = filtered(PREDICTORS[predictor], CORRECTORS[corrector])
    np.testing.assert_allclose(found.x, expected.x, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(found.P, expected.P, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("extended", [False, True])
def test_a_start_that_knows_nothing_costs_no_digits_that_matter(extended: bool) -> None:
    """100 km of doubt, measurements to 1 m: P stays symmetric, and is what FilterPy's Joseph form gives."""
    T, noise, wide, steps = np.array([[1.0, 1.0], [0.0, 1.0]]), 1e-9 * np.eye(2), 1e10 * np.eye(2), 50

    def move(x: FloatArray, _u: FloatArray, _dt: float, out: FloatArray) -> None:
        out[:] = T @ x

    def first(x: FloatArray, out: FloatArray) -> None:
        out[0] = x[0]

    predictor = extended_predictor(move, noise) if extended else linear_predictor(T, noise)
    corrector = extended_corrector(first, [[1.0]]) if extended else linear_corrector([[1.0, 0.0]], [[1.0]])
    composed = ModularFilter(predictor, [Sensor("position", corrector)])
    positions = [Measurement("position", k, k, [float(k)]) for k in range(steps + 1)]
    found = run(composed, np.zeros(2), wide, np.zeros((steps, 0)), positions).P

    kalman = KalmanFilter(dim_x=2, dim_z=1)
    kalman.P, kalman.F, kalman.Q, kalman.H, kalman.R = wide, T, noise, np.array([[1.0, 0.0]]), np.eye(1)
    for k in range(steps + 1):
        if k:
            kalman.predict()
        kalman.update([[float(k)]])
    np.testing.assert_array_equal(found, np.swapaxes(found, 1, 2))
    np.testing.assert_allclose(found[-1], kalman.P, rtol=1e-6)
