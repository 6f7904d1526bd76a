"""All methods on one scale: powers against the simulation, accuracies against the exact ones."""

from __future__ import annotations

from fractions import Fraction
from functools import cache

import pytest

from filters.accuracy import Accuracy, lossless
from sched_sim.design.methods import METHODS, select
from sched_sim.design.options import Options
from sched_sim.design.simulate import simulate
from sched_sim.design.timing import Timing
from studies.accuracy.given import MODELS, Given, given
from studies.accuracy.scale import EXACT, SUMMED, Placed, cheapest, counted, earliest, scale


def px4(of: Given) -> Accuracy:
    """Any will do here."""
    return lossless(of.model, of.states, of.N, of.M)


SMALL = ("camera", "ins-gps")
each_model = pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in SMALL else pytest.mark.exhaust) for name in MODELS]
)
"""The report of accuracies, rebuilt byte for byte in each run of the tests, is of all."""


@cache
def placed(name: str) -> list[Placed]:
    of = given(name)
    return scale(of, counted(of), px4(of))


def test_the_prototypes_powers_are_reached_or_beaten() -> None:
    """ACCURACY, section 4: peak HR work at N=80, M=44, 9 states, short; where it lands."""
    found = cheapest(placed("ins-gps"))
    prototype = {
        "recalculate": (138_287, 44),
        "larsen": (6_887, 44),
        "dual-rate": (4_581, 53),
        "delayed-horizon": (3_184, 48),
        SUMMED: (1_827, 53),
    }
    assert {name: (round(found[name].speed), found[name].lands) for name in prototype} == prototype
    assert found["clone"].speed <= 4_212
    assert found["clone-split"].speed <= 3_728
    assert found["carried-gain"].speed <= found["standard"].speed
    assert {found[name].lands for name in ("clone", "clone-split", "carried-gain")} == {44}


@pytest.mark.parametrize("method", [*EXACT, SUMMED])
@pytest.mark.parametrize("name", ["camera", pytest.param("star-tracker", marks=pytest.mark.exhaust)])
def test_at_its_power_it_lands_there_and_misses_nothing(name: str, method: str) -> None:
    of = given(name)
    table = counted(of)
    options = Options(low_rate_noise="sum" if method == SUMMED else "exact")
    costs = select(table, method.removesuffix(", Q'"), options)
    for place in (cheapest(placed(name))[method], earliest(placed(name))[method]):
        timing = Timing(of.N, of.M, place.asked)
        schedule = simulate(costs, timing, place.speed, 6, options)
        assert schedule.misses == 0
        assert max(schedule.achieved) == place.lands
        slower = simulate(costs, timing, place.speed * Fraction(999_999, 1_000_000), 6, options)
        assert slower.misses


@each_model
def test_exact_methods_are_as_good_as_their_age(name: str) -> None:
    of = given(name)
    for place in placed(name):
        if place.method in EXACT:
            exact = lossless(of.model, of.states, place.every * of.N, place.lands)
            assert place.accuracy.worst == pytest.approx(exact.worst, rel=1e-12)
            assert place.accuracy.verdict == "exact"


@each_model
def test_the_front_is_beaten_by_none_and_beats_all_others(name: str) -> None:
    designs = [place for place in placed(name) if place.method != "standard"]
    front = [place for place in designs if place.on_front]
    assert front
    for place in designs:
        as_good = [
            other
            for other in front
            if other.speed <= place.speed and other.accuracy.total <= place.accuracy.total * (1 + 1e-9)
        ]
        assert as_good
    assert {place.every for place in front} == {1}


def test_every_method_with_late_measurements_is_on_the_scale() -> None:
    names = {place.method for place in placed("camera")}
    late = {name for name in METHODS if not METHODS[name].law("next-step").undelayed and "robust" not in name}
    assert names == late | {SUMMED}
