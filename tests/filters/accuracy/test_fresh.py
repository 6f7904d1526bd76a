"""A late measurement used as if it had just been taken: scatter of a filter without delay, and a bias."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from filters.accuracy import LinearModel, fused_as_fresh, lossless
from filters.accuracy.cyclic.engine import regime
from filters.accuracy.cyclic.gain import settled_gain
from filters.accuracy.cyclic.methods import undelayed
from filters.accuracy.fresh import mean_error
from tests.filters.accuracy.cases import CV, INS, POSITION, all_outputs, models, seen_well


@given(models(), st.integers(1, 8), st.integers(0, 12), st.floats(-10, 10))
def test_it_is_what_the_engine_finds(model: LinearModel, N: int, M: int, moved: float) -> None:
    assume(seen_well(model, N))
    displacement = np.linspace(moved, 1.0, len(model.H))
    engine = regime(undelayed(model, all_outputs(model), N, settled_gain(model, N), displacement))
    found = fused_as_fresh(model, all_outputs(model), N, M, displacement)
    squared = np.square(engine.means).sum(axis=1)
    np.testing.assert_allclose(mean_error(model, all_outputs(model), N, displacement).errors, engine.means, rtol=1e-8)
    np.testing.assert_allclose(found.bias**2, squared.max(), rtol=1e-8)
    np.testing.assert_allclose(found.worst**2, engine.variances.max(), rtol=1e-12)
    np.testing.assert_allclose(found.total**2, (engine.variances + squared).max(), rtol=1e-8)
    assert (found.L, found.oldest, found.verdict) == (M, N + M - 1, "approximate")


def test_a_constant_velocity_is_believed_and_the_position_lags_by_the_whole_delay() -> None:
    np.testing.assert_allclose(mean_error(CV, np.eye(2)[:1], 10, [4.0]).errors, np.full((10, 1), -4.0), rtol=1e-12)


def test_at_15_metres_a_second_and_110_ms_it_is_biased_by_1_65_metres() -> None:
    found = fused_as_fresh(INS, POSITION, 80, 44, [15 * 0.11, 0, 0])
    assert f"{found.bias:.2f}" == "1.65"
    assert found.worst == pytest.approx(lossless(INS, POSITION, 80, 0).worst, rel=1e-12)
    assert found.believed == pytest.approx(found.worst, rel=1e-12)
    assert found.total == pytest.approx(np.hypot(found.worst, found.bias), rel=1e-3)


@pytest.mark.parametrize("displacement", [[1.0], [1.0, np.nan, 0.0], 1.0])
def test_a_wrong_displacement_is_refused(displacement: object) -> None:
    with pytest.raises(ValueError, match=r"displacement=.*give 3 finite numbers, one for each measurement"):
        fused_as_fresh(INS, POSITION, 80, 44, displacement)  # type: ignore[arg-type]
