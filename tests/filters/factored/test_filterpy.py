"""FilterPy's square root filter as a peer: it takes all measurements at once, by one QR decomposition."""

from __future__ import annotations

import numpy as np
import pytest
from filterpy.kalman import SquareRootKalmanFilter

from filters.factored import FACTORED_FORMS, FactoredFormName, factored_form
from filters.factored.workspace import new_factored_workspace
from tests.filters.factored.problems import close, problem


@pytest.mark.parametrize("name", FACTORED_FORMS)
def test_a_record_of_steps_agrees(name: FactoredFormName) -> None:
    given = problem(n=5, p=3, sources=5, seed=3)
    peer = SquareRootKalmanFilter(dim_x=5, dim_z=3)
    peer.F, peer.H, peer.P, peer.Q, peer.R = given.Phi, given.H, given.P, given.Q, given.R
    form, work = factored_form(name), new_factored_workspace(given.system)
    factors, propagated, P, K = np.zeros((5, 5)), np.zeros((5, 5)), np.zeros((5, 5)), np.zeros((5, 3))
    form.factor(given.P, factors)
    for number in range(20):
        peer.x = np.zeros((5, 1))
        measurement = np.eye(3)[:, [number % 3]]
        peer.predict()
        peer.update(measurement)
        form.propagation(given.Phi, factors, given.Q, propagated, work)
        form.update(propagated, given.H, given.R, K, factors, work)
        form.covariance(factors, P)
        close(P, peer.P)
        close(K @ measurement, peer.x)
