"""At a stated time: as along a record of landings, and in time as in the periodic regime."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from filters.accuracy import LinearModel, after_cycles, along, linear_model, lossless
from tests.filters.accuracy.cases import CV, all_outputs, models


@given(models(), st.integers(1, 6), st.integers(0, 9), st.integers(0, 6))
def test_it_is_what_the_record_of_landings_has_there(model: LinearModel, N: int, L: int, cycles: int) -> None:
    C, P0 = all_outputs(model), 3.0 * np.eye(model.states)
    found = after_cycles(model, C, N, L, cycles, P0)
    record = [("sensor", k, k + L) for k in range(0, cycles * N + 1, N)]
    steps = cycles * N + L + N - 1
    seen = along(model.Phi, model.Q, {"sensor": (model.H, model.R)}, C, P0, steps, record).deviations[-N:]
    assert found.step == steps - N + 1
    np.testing.assert_allclose([found.worst, found.rms], [seen.max(), np.sqrt(np.square(seen).mean())], rtol=1e-9)


def test_in_time_it_is_the_periodic_regime() -> None:
    found, expected = after_cycles(CV, [0], 10, 8, 10**6, np.eye(2)), lossless(CV, [0], 10, 8)
    np.testing.assert_allclose(found[1:], [expected.worst, expected.rms], rtol=1e-12)


def test_what_nothing_measures_has_a_value_at_a_stated_time() -> None:
    model = linear_model(np.eye(2), np.diag([0.01, 0.02]), [[1, 0]], [[1]])
    found = after_cycles(model, [1], 10, 3, 100, np.eye(2))
    assert found.worst**2 == pytest.approx(1 + 0.02 * (1003 + 9))


def test_bad_input_is_named() -> None:
    with pytest.raises(ValueError, match=r"P0 has shape \(3, 3\), needed is \(2, 2\)"):
        after_cycles(CV, [0], 10, 8, 5, np.eye(3))
    with pytest.raises(ValueError, match="cycles=-1 must be a whole number of steps, at least 0"):
        after_cycles(CV, [0], 10, 8, -1, np.eye(2))
