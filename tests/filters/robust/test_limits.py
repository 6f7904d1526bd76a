"""What the robust filter becomes without uncertainty, and where mu grows without bounds."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from filters.robust.model import prepared
from filters.robust.records import Predicted, RobustModel
from filters.robust.step import WAYS, WayName, step
from tests.filters.robust.cases import Array, close, random_model, start

seeds = st.integers(0, 2**31 - 1)
each_way = pytest.mark.parametrize("way", WAYS)


def kalman(model: RobustModel, before: Predicted, y: Array, c: Array, added: float) -> Predicted:
    """The one-step predictor; `added` is the variance of more noise on every state and every measurement."""
    F, H, x, P = model.F, model.H, before.x, before.P
    R = model.D @ model.R @ model.D.T + added * np.eye(len(H))
    Q = model.G @ model.Q @ model.G.T + added * np.eye(len(F))
    S = H @ P @ H.T + R
    K = F @ P @ H.T @ np.linalg.inv(S)
    return Predicted(F @ x + c + K @ (y - H @ x), F @ P @ F.T + Q - K @ S @ K.T)


def inputs(seed: int, n: int, p: int) -> tuple[Array, Array]:
    random = np.random.default_rng([seed, 2])
    return random.normal(size=p), random.normal(size=n)


@each_way
@settings(max_examples=8, deadline=None)
@given(seed=seeds)
def test_without_uncertainty_it_is_the_kalman_predictor(way: WayName, seed: int) -> None:
    """With E = 0, whatever M is; a finite mu is noise of variance 1 / mu on all states and measurements."""
    model, before, (y, c) = random_model(seed, 3, 2, 2, 1, 1), start(3, seed), inputs(seed, 3, 2)
    certain = model._replace(**{name: 0 * getattr(model, name) for name in ("E_F", "E_G", "E_H", "E_D")})
    for mu, added in ((np.inf, 0.0), (4.0, 0.25)):
        found = step(certain, before, y, c, mu=mu, way=way, backend="numpy")
        expected = kalman(model, before, y, c, added)
        close(found.x, expected.x, 1e-12)
        close(found.P, expected.P, 1e-12)


@each_way
def test_it_is_the_kalman_predictor_over_many_steps(way: WayName) -> None:
    model = random_model(7, 4, 4, 2, 0, 0)
    model = model._replace(F=model.F / np.abs(np.linalg.eigvals(model.F)).max())
    found = expected = start(4)
    for i in range(60):
        y, c = inputs(i, 4, 2)
        found, expected = step(model, found, y, c, way=way, backend="numpy"), kalman(model, expected, y, c, 0.0)
        close(found.x, expected.x, 1e-12)
        close(found.P, expected.P, 1e-12)


def test_zero_rows_are_dropped_and_m_with_them() -> None:
    model = random_model(1, 3, 3, 2, 2, 2)
    model.E_F[0] = model.E_G[0] = model.E_H[:] = model.E_D[:] = 0.0
    ready = prepared(model)
    assert (len(ready.E_F), len(ready.E_H)) == (1, 0)
    np.testing.assert_array_equal(ready.M1, model.M1)
    assert not ready.M2.any()
    known = model._replace(M1=0 * model.M1, M2=0 * model.M2)
    assert len(prepared(known, mu=3.0).E_F) == 0
    assert len(prepared(known).E_F) == 1


def test_the_limit_is_reached_like_one_over_mu() -> None:
    model, before, (y, c) = random_model(3, 4, 4, 2, 1, 1), start(4), inputs(3, 4, 2)
    limit = step(model, before, y, c)
    errors = [np.abs(step(model, before, y, c, mu=10.0**k).P - limit.P).max() for k in (4, 6, 8)]
    np.testing.assert_allclose(np.divide(errors[:-1], errors[1:]), 100, rtol=0.02)


def test_in_the_limit_scales_of_the_uncertainty_play_no_part() -> None:
    model, before, (y, c) = random_model(4, 4, 4, 2, 1, 1), start(4), inputs(4, 4, 2)
    other = model._replace(M1=3 * model.M1, M2=0 * model.M2, E_F=7 * model.E_F, E_G=7 * model.E_G)
    expected, found = step(model, before, y, c, xi=0.1), step(other, before, y, c, xi=2.0)
    close(found.x, expected.x, 1e-12)
    close(found.P, expected.P, 1e-12)


@settings(max_examples=20)
@given(seed=seeds)
def test_more_is_claimed_to_be_known_than_by_kalman(seed: int) -> None:
    """In the limit E rows are measurements more, so that P is no greater than the Kalman filter's."""
    model, before, (y, c) = random_model(seed, 4, 4, 2, 1, 1), start(4, seed), inputs(seed, 4, 2)
    robust, standard = step(model, before, y, c).P, kalman(model, before, y, c, 0.0).P
    assert np.linalg.eigvalsh(standard - robust).min() > -1e-10 * np.abs(standard).max()
