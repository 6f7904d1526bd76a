"""Landing later against skipping, with other functions of the accuracy."""

from __future__ import annotations

import pytest

from filters.accuracy import lossless
from studies.accuracy.given import MODELS, given
from studies.accuracy.landing import SEARCHED, landing

each_model = pytest.mark.parametrize("name", MODELS)


@each_model
def test_curves_are_the_accuracy_of_each_landing(name: str) -> None:
    of = given(name)
    found = landing(of)
    for n, curve in found.curves.items():
        assert curve.landings[0] == of.M
        for L in (of.M, of.N, curve.landings[-1]):
            assert curve.worst[L - of.M] == pytest.approx(lossless(of.model, of.states, n * of.N, L).worst, rel=1e-12)
    assert found.curves[1].worst[0] == pytest.approx(found.at_arrival.worst, rel=1e-12)


@each_model
def test_so_late_every_measurement_is_as_good_as_every_second_one(name: str) -> None:
    of, found = given(name), landing(given(name))
    last = SEARCHED * of.N if found.as_late is None else found.as_late
    skipping = found.skipping[2].worst
    assert lossless(of.model, of.states, of.N, last).worst <= skipping
    if found.as_late is not None:
        assert lossless(of.model, of.states, of.N, last + 1).worst > skipping


@each_model
def test_outputs_move_by_the_stated_motion_during_the_delay(name: str) -> None:
    of = given(name)
    assert of.displacement.shape == (len(of.model.H),)
    assert of.displacement[0] > 0
    assert not of.displacement[1:].any()


def test_a_model_that_does_not_ship_is_refused() -> None:
    with pytest.raises(ValueError, match="model='radar' is unknown"):
        given("radar")
