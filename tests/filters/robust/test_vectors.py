"""Numbers of an independent implementation in NumPy, with and without uncertainty, for both kinds of mu."""

from __future__ import annotations

import numpy as np
import pytest

from filters.robust.model import prepared, weights
from filters.robust.records import Predicted
from filters.robust.run import run
from filters.robust.step import WAYS, WayName, step
from tests.filters.robust.cases import VECTOR_CASES, block_system, sayed_measurements

START = Predicted(np.array([1.0, -1.0]), np.eye(2))

PREDICTIONS = {
    ("T1", 1): (0.4803000000, -0.4901000000, 2.6143920800, 0.3525719600, 2.6013280267),
    ("T1", 5): (0.6332165090, -0.6733970586, 6.4647210767, 4.0432657793, 6.2818204872),
    ("T1", 50): (0.7172634915, -0.4156281873, 32.2189613871, 29.1880632790, 30.8315970110),
    ("T2", 1): (0.8685535443, 0.0547998730, 2.1975203670, -0.2324924826, 1.7802111428),
    ("T2", 5): (1.3046787464, 0.0052635273, 2.3506679114, -0.2367340872, 1.7832008435),
    ("T2", 50): (1.1432544428, -0.0008537676, 2.3506696970, -0.2367342447, 1.7832008574),
    ("T3", 1): (0.7351500000, 0.0000000000, 2.4411960200, 0.0195000000, 1.9608000000),
    ("T3", 5): (1.2942590959, 0.0000000000, 2.6589883220, 0.0195000000, 1.9608000000),
    ("T3", 50): (1.1430131084, 0.0000000000, 2.6589944971, 0.0195000000, 1.9608000000),
    ("T4", 1): (0.8177802674, 0.0460279698, 0.9956667866, -0.4401320888, 1.7443380491),
    ("T4", 5): (2.1588896821, 0.0687294734, 0.9689460471, -0.4550164820, 1.7360469178),
    ("T4", 50): (1.7391122481, 0.0193405012, 0.9689182356, -0.4550319739, 1.7360382882),
    ("T5", 1): (0.6021112055, -0.6077111540, 2.7814756339, 0.2720647556, 3.6756141677),
    ("T5", 5): (0.6797168386, -0.6046730855, 7.0495630761, 4.2836390727, 7.9180766726),
    ("T5", 50): (0.6369726140, -0.4874867160, 11.8410845081, 8.8950739297, 12.3561972790),
    ("T7", 1): (0.5489142857, -0.5601142857, 3.1583326686, 0.3077348114, 3.1470800286),
    ("T7", 5): (0.6287368354, -0.6719290409, 8.0262488167, 4.9053762930, 7.8003568561),
    ("T7", 50): (0.7160859420, -0.4168612457, 40.3913819574, 36.4835110746, 38.6106307766),
}
FINGERPRINTS = {
    "T1": (15, 6.20758973, 1.09861229),
    "T2": (16, 9.44241337, 3.94841038),
    "T3": (16, 9.40925981, 3.91202301),
    "T4": (17, 9.45722847, 0.21082600),
    "T5": (16, 2318.89236515, 9.14318417),
    "T7": (15, 6.26770853, 1.25276297),
}


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("case", VECTOR_CASES)
def test_predictions(case: str, way: WayName) -> None:
    model, mu = VECTOR_CASES[case]
    history = run(model, START.x, START.P, sayed_measurements(50), mu=mu, way=way, backend="numpy")
    for steps in (1, 5, 50):
        x, P = history.x[steps], history.P[steps]
        np.testing.assert_allclose([*x, P[0, 0], P[0, 1], P[1, 1]], PREDICTIONS[case, steps], rtol=1e-9, atol=1e-10)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("case", VECTOR_CASES)
def test_one_step_as_written(case: str, way: WayName) -> None:
    model, mu = VECTOR_CASES[case]
    x, P = step(model, START, sayed_measurements(1)[0], np.zeros(2), mu=mu, way=way)
    np.testing.assert_allclose([*x, P[0, 0], P[0, 1], P[1, 1]], PREDICTIONS[case, 1], rtol=1e-9, atol=1e-10)


@pytest.mark.parametrize("case", VECTOR_CASES)
def test_fingerprints_of_the_block_matrix(case: str) -> None:
    model, mu = VECTOR_CASES[case]
    N, norm, log_determinant = FINGERPRINTS[case]
    A, b = block_system(model, START, sayed_measurements(1)[0], np.zeros(2), mu)
    assert A.shape == (N, N)
    assert b.shape == (N, 3)
    np.testing.assert_array_equal(A, A.T)
    assert np.linalg.norm(A) == pytest.approx(norm, abs=1e-8)
    sign, found = np.linalg.slogdet(A)
    assert sign == -1
    assert found == pytest.approx(log_determinant, abs=1e-8)


def test_weights() -> None:
    model, mu = VECTOR_CASES["T5"]
    found = weights(prepared(model, mu), mu)
    np.testing.assert_allclose(found.Phi1, np.diag([0.0909090909, 1]), atol=1e-10)
    np.testing.assert_allclose(found.Phi2, [[1]])
    assert found.inverse_lambda == pytest.approx(2318.87284229, abs=1e-8)
