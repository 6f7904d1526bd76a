"""A run that rounding has made wrong is refused: variances and gains are held against the filter in fractions."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from filters import multirate_gain
from filters.covariance_forms import COVARIANCE_FORMS
from filters.history import History
from filters.registry import DELAYED_METHODS
from filters.system import System
from filters.systems.linear import linear_system

STEPS = 6
each_form = pytest.mark.parametrize("form", COVARIANCE_FORMS)
each_backend = pytest.mark.parametrize("backend", ["reference", "numpy"])


def nearly_alike(difference: float, R: float, P0: float = 1e6, Q: float = 1e-9) -> tuple[System, np.ndarray]:
    """Position and speed, and two sensors of the position, of which one sees a little of the speed. With its P0."""
    H = [[1.0, 0.0], [1.0, difference]]
    return linear_system([[1, 1], [0, 1]], np.zeros((2, 0)), H, Q * np.eye(2), R * np.eye(2)), P0 * np.eye(2)


def run(system: System, P0: np.ndarray, form: str, backend: str = "reference", method: str = "standard") -> History:
    """A measurement in every step, used at once, but by the dual-rate filter and the delayed horizon a step later."""
    L = int(method in ("dual-rate", "delayed-horizon"))
    measurements = np.ones((STEPS + 1, system.measurements))
    start = np.zeros(2), P0, np.zeros((STEPS, 0)), measurements
    return DELAYED_METHODS[method].run(system, 1, 0, L, *start, update=form, backend=backend)


def fractions(values: ArrayLike) -> Any:
    """An array of fractions, exactly as large as its floats."""
    return np.vectorize(Fraction, otypes=[object])(np.asarray(values, dtype=float))


def inverse(S: Any) -> Any:
    """Of a 2 x 2 matrix."""
    (a, b), (c, d) = S
    return np.array([[d, -b], [-c, a]]) / (a * d - b * c)


def corrected(P: Any, K: Any, H: Any, R: Any) -> Any:
    """The covariance that any gain leaves."""
    kept = fractions(np.eye(2)) - K @ H
    return kept @ P @ kept.T + K @ R @ K.T


def wrong_by(history: History, system: System, P0: np.ndarray) -> tuple[Fraction, Fraction]:
    """The true variance of the errors over what the run says it is, and over that of the best filter, at worst."""
    Phi, _, H, Q, R = (fractions(matrix[0]) for matrix in system.parameters)
    true = best = fractions(P0)
    too_sure = worse = Fraction(0)
    for said, gain in zip(history.P_reference, history.gains, strict=False):
        too_sure = max(too_sure, *np.diag(true) / fractions(np.diag(said)))
        best_gain = best @ H.T @ inverse(H @ best @ H.T + R)
        true, best = corrected(true, fractions(gain), H, R), corrected(best, best_gain, H, R)
        worse = max(worse, *np.diag(true) / np.diag(best))
        true, best = Phi @ true @ Phi.T + Q, Phi @ best @ Phi.T + Q
    return too_sure, worse


def refused_or_right(system: System, P0: np.ndarray, form: str, backend: str = "reference") -> None:
    """No run comes back whose standard deviations or errors are off by more than rounding's share in them."""
    try:
        history = run(system, P0, form, backend)
    except ValueError as error:
        assert "give update=" in str(error)  # noqa: PT017 - either may be
        return
    too_sure, worse = wrong_by(history, system, P0)
    assert too_sure <= 5
    assert worse <= 6


@each_form
@each_backend
@pytest.mark.parametrize("R", [1e-12, 1e-10, 1e-8, 1e-6, 1e-2, 1.0])
def test_two_sensors_nearly_alike(form: str, backend: str, R: float) -> None:
    refused_or_right(*nearly_alike(1e-7, R), form, backend)


@pytest.mark.parametrize("method", DELAYED_METHODS)
def test_a_gain_that_rounding_has_made_wrong_is_refused_by_every_method(method: str) -> None:
    """Joseph's form leaves a covariance for any gain, so nothing else would be seen of it."""
    said = r"step \d: rounding errors .* give update='short', or filters.multirate_gain"
    if method == "augmentation":  # it has one form
        said = r"step \d: the covariance is no longer .* run filters.larsen with update='joseph'"
    with pytest.raises(ValueError, match=said):
        run(*nearly_alike(1e-7, 1e-10), "joseph", method=method)


@pytest.mark.parametrize("form", ["square-root", "u-d"])
def test_the_remedy_helps(form: Any) -> None:
    system, P0 = nearly_alike(1e-7, 1e-10)
    measurements = np.ones((STEPS + 1, 2))
    history = multirate_gain.run(system, 1, np.zeros(2), P0, np.zeros((STEPS, 0)), measurements, form=form)
    too_sure, worse = wrong_by(history, system, P0)
    assert max(too_sure, worse) < 1.01


@pytest.mark.parametrize("backend", ["reference", "numpy"])
def test_a_model_that_is_not_linear_is_looked_at_too(backend: Any) -> None:
    system, P0 = nearly_alike(1e-7, 1e-10)
    curved = system._replace(f=lambda j, x, u, p, out: system.f(j, x, u, p, out))
    with pytest.raises(ValueError, match=r"step \d: rounding errors"):
        run(curved, P0, "joseph", backend)


@each_form
def test_measurements_without_noise_are_no_reason_to_refuse(form: str) -> None:
    """What is left of P is rounding of zero, and then what Q makes of it."""
    system = linear_system([[1, 1], [0, 1]], np.zeros((2, 0)), [[1, 0]], np.eye(2), [[0]])
    P = run(system, np.eye(2), form).P_reference[-1]
    golden = (1 + 5**0.5) / 2
    np.testing.assert_allclose(P, [[golden**2, golden], [golden, golden**2]], rtol=1e-3)


@given(
    difference=st.floats(-9, 0),
    R=st.floats(-20, 0),
    P0=st.floats(-3, 6),
    Q=st.floats(-18, 0),
    form=st.sampled_from(sorted(COVARIANCE_FORMS)),
    backend=st.sampled_from(["reference", "numpy"]),
)
def test_what_comes_back_is_right(difference: float, R: float, P0: float, Q: float, form: str, backend: str) -> None:
    """All but the form are powers of ten; R and Q as shares of P0."""
    refused_or_right(*nearly_alike(10**difference, 10 ** (P0 + R), 10**P0, 10 ** (P0 + Q)), form, backend)
