"""Several measurements in flight: compensated they are as good as their age; as they stand they may be unstable."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from filters.accuracy import LinearModel, lossless, uncompensated
from filters.accuracy.cyclic.engine import regime
from filters.accuracy.cyclic.gain import settled_gain
from filters.accuracy.cyclic.methods import carried
from tests.filters.accuracy.cases import CV, all_outputs, models, seen_well


@given(models(), st.integers(1, 6), st.integers(0, 18))
def test_what_is_not_compensated(model: LinearModel, N: int, L: int) -> None:
    assume(seen_well(model, N))
    found = uncompensated(model, all_outputs(model), N, L)
    best = lossless(model, all_outputs(model), N, L)
    if L <= N:
        assert found == best
        return
    engine = regime(carried(model, all_outputs(model), N, L, settled_gain(model, N), compensated=False))
    assume(abs(engine.radius - 1) > 1e-3)
    assert found.radius == pytest.approx(engine.radius, rel=1e-6)
    if engine.radius > 1:
        assert (found.verdict, found.worst) == ("unstable", np.inf)
    else:
        np.testing.assert_allclose(found.worst**2, engine.variances.max(), rtol=1e-8)
        assert found.worst >= best.worst * (1 - 1e-9)
        assert found.believed == pytest.approx(best.worst)


def test_one_step_beyond_assumption_2_is_enough() -> None:
    assert uncompensated(CV, [0], 10, 10).verdict == "exact"
    assert uncompensated(CV, [0], 10, 11).verdict == "unstable"
    assert lossless(CV, [0], 10, 11).verdict == "exact"
