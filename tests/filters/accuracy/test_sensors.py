"""Several sensors: what their filter settles to, and models that cannot be."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from filters.accuracy import SensorsModel, along, lossless, sensors_model, settled
from tests.filters.accuracy.cases import CV, INS, POSITION, random_model


@pytest.mark.parametrize(("model", "N", "outputs"), [(CV, 10, [0]), (INS, 80, POSITION)])
@pytest.mark.parametrize("L", [0, 4, 44])
def test_one_sensor_settles_to_the_periodic_regime(model: Any, N: int, outputs: list[int], L: int) -> None:
    of = sensors_model(model.Phi, model.Q, {"gps": (model.H, model.R)})
    start, end = max(0, L - N), 20 * N
    P0 = settled(of, {"gps": [0]}, N)
    found = along(of.Phi, of.Q, of.sensors, outputs, P0, end, [("gps", k, k + L) for k in range(0, end + 1, N)])
    exact = lossless(model, outputs, N, L)
    cycle = found.deviations[L + start : L + start + 10 * N]
    assert cycle.max() == pytest.approx(exact.worst, rel=1e-11)
    assert np.sqrt(np.mean(cycle**2)) == pytest.approx(exact.rms, rel=1e-11)


@given(st.integers(0, 2**31 - 1), st.sampled_from([0.9, 1.0, 1.1]))
def test_several_settle_to_what_a_long_recursion_comes_to(seed: int, radius: float) -> None:
    first, second = random_model(seed, radius, 3, 1), random_model(seed + 1, radius, 3, 2)
    of = sensors_model(first.Phi, first.Q, {"gps": (first.H, first.R), "radio": (second.H, second.R)})
    taken = {"gps": [1, 3], "radio": [2, 5]}
    P0 = settled(of, taken, 6)
    landings = [(name, 6 * i + k, 6 * i + k) for name, steps in taken.items() for k in steps for i in range(20)]
    found = along(of.Phi, of.Q, of.sensors, np.eye(3), P0, 120, landings).deviations
    np.testing.assert_allclose(found[6:12], found[:6], rtol=1e-9)
    other = along(of.Phi, of.Q, of.sensors, np.eye(3), np.eye(3), 120, landings).deviations
    np.testing.assert_allclose(found[108:114], found[:6], rtol=1e-9)
    np.testing.assert_allclose(other[108:114], found[:6], rtol=1e-5)


def test_what_is_never_seen_does_not_settle() -> None:
    of = sensors_model(np.eye(2), np.eye(2), {"gps": ([[1, 0]], [[1]])})
    with pytest.raises(ValueError, match="does not settle"):
        settled(of, {"gps": [0]}, 3)


def test_all_sensors_as_one() -> None:
    of = sensors_model(np.eye(2), np.eye(2), {"gps": ([1, 0], 4), "radio": (np.eye(2), np.diag([1, 2]))})
    assert of.stacked.H.tolist() == [[1, 0], [1, 0], [0, 1]]
    assert of.stacked.R.tolist() == [[4, 0, 0], [0, 1, 0], [0, 0, 2]]


GPS = ([[1, 0]], [[1]])


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"Phi": [[1, np.nan], [0, 1]]}, r"^Phi holds a value that is not finite, at \[0, 1\]"),
        ({"Q": [[1, 2], [2, 1]]}, "^Q"),
        ({"sensors": {}}, "^sensors must give the H and R of each by its name"),
        ({"sensors": {"gps": [[1, 0]]}}, "^sensor 'gps': give its H and its R"),
        ({"sensors": {"gps": ([[1, 0, 0]], [[1]])}}, r"^sensor 'gps': H has shape \(1, 3\), needed is \(1, 2\)"),
        ({"sensors": {"gps": GPS, "radio": ([[1, 0], [1, 0]], np.ones((2, 2)))}}, "^sensor 'radio': R .* definite"),
        ({"names": ["east"]}, "^names="),
    ],
)
def test_models_that_cannot_be(change: dict[str, Any], said: str) -> None:
    given = {"Phi": np.eye(2), "Q": np.eye(2), "sensors": {"gps": GPS}} | change
    with pytest.raises(ValueError, match=said):
        sensors_model(**given)


def test_it_is_what_it_was_made_of() -> None:
    of = sensors_model(np.eye(2), np.eye(2), {"gps": GPS}, ["east", "north"])
    assert isinstance(of, SensorsModel)
    assert (of.states, of.names, of.stacked.names) == (2, ("east", "north"), ("east", "north"))
