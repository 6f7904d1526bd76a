"""Choosing a filter whose corrections may land beyond N: against a search of every landing, by simulation."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
import pytest

from filters.accuracy import LinearModel, with_low_rate_noise
from sched_sim import Options, Timing, select
from sched_sim.design.least_speed import least_speed
from sched_sim.design.methods import METHODS as SCHEDULED
from sched_sim.design.search import least_speed_by_simulation, search_resolution
from studies import choose_filter
from studies.selection.costs import tables_for
from studies.selection.methods import METHODS
from studies.selection.model import load_model
from studies.selection.variants import Variant, variants

Phi = np.array([[1.0, 1.0], [0.0, 1.0]])
Q = 0.01 * np.array([[1 / 3, 1 / 2], [1 / 2, 1.0]])
CV = LinearModel(Phi, Q, np.array([[1.0, 0.0]]), np.eye(1))

LATE = ("recalculate", "larsen", "carried-gain", "dual-rate")
"""Methods that can have others on their way."""


class Found(NamedTuple):
    latest: int
    speed: Fraction


def key(way: Variant) -> tuple[str, str, int, Options]:
    return way.table.name, way.method, way.every, way.options


def searched(way: Variant, N: int, M: int, within: float, metric: str) -> Found | None:
    """The latest landing that keeps it of those up to three measurements after arrival, and what the cheapest of these
    landings asks for; each by simulation."""
    options = way.options
    costs = select(way.table, way.method, options)
    later = METHODS[way.method].landing == "later"
    found = None
    for L in range(M + 1, M + 3 * N + 1) if later else [M]:
        accuracy = with_low_rate_noise(CV, [0], N, L, options.low_rate_noise)
        if getattr(accuracy, metric) > within:
            break
        timing = Timing(N, M, max(L, M))
        speed = least_speed_by_simulation(costs, timing, options, ())[0] if later else least_speed(costs, timing).speed
        found = Found(L, speed if found is None else min(speed, found.speed))
    return found


def asked_for(N: int, M: int, within: float, metric: str = "worst") -> Any:
    return choose_filter(within, CV, [0], N=N, M=M, every=(1, 2), metric=metric, methods=LATE)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("N", "M", "within", "metric"),
    [
        pytest.param(3, 1, 2.4, "worst", marks=pytest.mark.exhaust),
        (2, 5, 3.0, "worst"),
        *(
            pytest.param(N, M, within, metric, marks=pytest.mark.exhaust)
            for N, M in ((1, 0), (1, 3), (2, 1), (3, 3), (4, 6))
            for within in (2.5, 4.0, 8.0)
            for metric in ("worst", "rms")
        ),
    ],
)
def test_it_is_what_a_search_of_every_landing_finds(N: int, M: int, within: float, metric: str) -> None:
    """The cheapest, though later landings than it looks at are searched too; a least speed to one tick."""
    tables = tables_for(load_model(CV, None), None)
    kept = {key(of.variant): of for of in asked_for(N, M, within, metric).keeping}
    for way in variants(LATE, (1, 2), tables, Options()):
        if way.is_beside(Options()):
            continue
        using = N * way.every
        found = searched(way, using, M, within, metric)
        assert (found is None) == (key(way) not in kept)
        if found is None:
            continue
        of, law = kept[key(way)], SCHEDULED[way.method].law("next-step")
        assert max(min(found.latest, law.last_of_use(using, M)), M) == of.L
        tick = Fraction(1, search_resolution(select(way.table, way.method, way.options), way.options, ()))
        assert of.least is not None
        assert abs(of.least.speed - found.speed) <= tick
        assert of.landed is not None
        assert of.landed <= of.L


@pytest.mark.exhaust
def test_a_looser_bound_never_asks_for_more() -> None:
    """Of each way, over bounds from what the first landing keeps to what every landing does."""
    least: dict[Any, Fraction] = {}
    for within in (2.1, 2.8, 6.0):
        for of in asked_for(2, 3, within).keeping:
            assert of.least.speed <= least.get(key(of.variant), of.least.speed)
            least[key(of.variant)] = of.least.speed
    assert least


def test_a_bound_that_every_landing_keeps_is_said_to_allow_more() -> None:
    """CV at N=3, M=1: L=4 by the arrival of the next, and a later one makes no difference."""
    found = asked_for(3, 1, 9.0)
    of = next(
        of
        for of in found.keeping
        if (of.variant.method, of.variant.options, of.variant.every) == ("dual-rate", Options(), 1)
    )
    assert (of.L, of.allowed) == (4, 5)
