"""All methods on one scale: the power that each needs, where its corrections land, what the output is worth then."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from typing import NamedTuple

from filters.accuracy import Accuracy, fused_as_fresh, lossless_each, with_low_rate_noise
from filters.delayed.low_rate_noise import LowRateNoise
from filters.systems.example import example_system
from sched_sim.costs.methods import DELAYED_METHODS
from sched_sim.costs.table import CostTable
from sched_sim.design.least_speed import least_speed, staircase
from sched_sim.design.methods import METHODS, select
from sched_sim.design.options import Options
from sched_sim.design.timing import Timing
from studies.accuracy.given import Given
from studies.measurement.methods import measure
from studies.selection.unbeaten import unbeaten

EVERY = (1, 2, 3)
"""Every n-th measurement is used."""
SUMMED = "dual-rate, Q'"
"""The dual rate filter with Steffes' Eq. 23."""
EXACT = tuple(name for name in DELAYED_METHODS if name not in ("standard", "px4-predictor", "fuse-as-fresh"))


class Placed(NamedTuple):
    """One design. method: a name of `DELAYED_METHODS`, or `SUMMED`. every: each n-th measurement is used. asked: by the
    end of which step a correction must be in the output; lands: where it is at the least speed. speed: operations in an
    HR period. on_front: no other design is as accurate with less."""

    method: str
    every: int
    asked: int
    lands: int
    speed: Fraction
    accuracy: Accuracy
    on_front: bool = False


def counted(of: Given) -> CostTable:
    """Operations of all methods at the sizes of this model, dense, with the `short` covariance update."""
    name = "-".join(["counted", *map(str, of.sizes), "short"])
    return measure(example_system(*of.sizes), "counted", "short", name=name, methods=DELAYED_METHODS)


def scale(of: Given, table: CostTable, px4: Accuracy, every: Sequence[int] = EVERY) -> list[Placed]:
    """Every method wherever it can land, and the filter without delay; every n-th measurement with exact methods.

    px4: what its predictor is worth, landing at M.
    """
    placed = [place for n in every for method in (*EXACT, SUMMED) for place in _exact(of, table, method, n)]
    standard = _least(of, table, "standard")
    fresh = fused_as_fresh(of.model, of.states, of.N, of.M, of.displacement)
    undelayed = lossless_each(of.model, of.states, of.N, [0])[0]
    placed += [
        Placed("px4-predictor", 1, of.M, of.M, _least(of, table, "px4-predictor"), px4),
        Placed("fuse-as-fresh", 1, of.M, of.M, _least(of, table, "fuse-as-fresh"), fresh),
    ]
    best = unbeaten([(place.speed, place.accuracy.total) for place in placed])
    rated = [place._replace(on_front=on_front) for place, on_front in zip(placed, best, strict=True)]
    return [Placed("standard", 1, 0, 0, standard, undelayed), *rated]


def cheapest(placed: Sequence[Placed]) -> Mapping[str, Placed]:
    """By method, with every measurement: the design of least power, and of these the one that lands first."""
    found: dict[str, Placed] = {}
    for place in placed:
        if place.every == 1:
            other = found.setdefault(place.method, place)
            if (place.speed, place.lands) < (other.speed, other.lands):
                found[place.method] = place
    return found


def earliest(placed: Sequence[Placed]) -> Mapping[str, Placed]:
    """By method, with every measurement: the design that lands first, at the least power for that."""
    found: dict[str, Placed] = {}
    for place in placed:
        if place.every == 1:
            other = found.setdefault(place.method, place)
            if (place.lands, place.speed) < (other.lands, other.speed):
                found[place.method] = place
    return found


def _exact(of: Given, table: CostTable, method: str, n: int) -> Iterator[Placed]:
    noise: LowRateNoise = "sum" if method == SUMMED else "exact"
    name, N = method.removesuffix(", Q'"), n * of.N
    options = Options(low_rate_noise=noise)
    costs = select(table, name, options)
    stairs = {(stair.speed, stair.achieved): stair for stair in reversed(staircase(costs, N, of.M, options))}
    exact = lossless_each(of.model, of.states, N, range(of.M, N + 1))
    for stair in reversed(stairs.values()):
        accuracy = exact[stair.achieved - of.M]
        if noise == "sum":
            accuracy = with_low_rate_noise(of.model, of.states, N, stair.achieved, noise)
        yield Placed(method, n, stair.L, stair.achieved, stair.speed, accuracy)


def _least(of: Given, table: CostTable, method: str) -> Fraction:
    options = Options()
    first = of.M + METHODS[method].law(options.feedback).after
    return least_speed(select(table, method, options), Timing(of.N, of.M, first), options).speed
