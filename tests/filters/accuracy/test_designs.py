"""Many designs at once are those one by one."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from filters.accuracy import LinearModel, lossless, lossless_designs
from tests.filters.accuracy.cases import CV, all_outputs, models

designs = st.lists(st.tuples(st.integers(1, 9), st.integers(0, 20)), min_size=1, max_size=20)


@given(models(), designs)
def test_many_designs_at_once_are_those_one_by_one(model: LinearModel, pairs: list[tuple[int, int]]) -> None:
    N, L = np.array(pairs).T
    found = lossless_designs(model, all_outputs(model), N, L)
    one_by_one = [lossless(model, all_outputs(model), *pair) for pair in pairs]
    np.testing.assert_allclose(found.worst, [each.worst for each in one_by_one], rtol=1e-12)
    np.testing.assert_allclose(found.rms, [each.rms for each in one_by_one], rtol=1e-11)


def test_designs_have_the_shape_of_what_is_given() -> None:
    found = lossless_designs(CV, [0], [[5], [10]], [4, 8, 14])
    assert found.worst.shape == (2, 3)
    assert found.worst[1, 1] == lossless(CV, [0], 10, 8).worst
    assert lossless_designs(CV, [0], [], []).worst.shape == (0,)


@pytest.mark.parametrize(("N", "L", "name"), [([0], [1], "N"), ([5], [-1], "L"), ([5.5], [1], "N")])
def test_designs_that_are_none_are_refused(N: list[float], L: list[float], name: str) -> None:
    with pytest.raises(ValueError, match=rf"{name} must be whole numbers of steps, at least [01]; it holds others"):
        lossless_designs(CV, [0], N, L)
