"""What Eqs. (4) to (6) of the patent tend to, as tables; the first row of each is its heading."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import ceil
from typing import Any, NamedTuple

from reports.multirate.costs import every
from reports.multirate.results import N
from reports.multirate.words import EACH_GAIN, VEHICLES, ratio_text, reading_text
from reports.pages.numbers import significant
from sched_sim.design.load import utilization
from sched_sim.design.pieces import MultirateCosts
from studies.multirate.accuracy import ACCELERATION_NOISES, GOOD, Reading
from studies.multirate.limit import Tending, tending

BETWEEN_S = 5
"""Between gains, as in the patent's example."""
MEASUREMENTS = (1, 2, 5, 10, 20, 50, 100)
"""In that time."""
RATES_HZ = (Fraction(1, 2), *map(Fraction, (1, 2, 5, 10, 20, 50, 100)))
TENTHS = 10
"""Rates are told in so many parts of a Hz."""

DIVIDED: Sequence[Reading] = ("averaged", "sampled")

Rows = list[list[Any]]


class Limits(NamedTuple):
    """By vehicle. more: with more measurements in the time between gains; faster: with a gain every N-th, at higher
    rates; least_hz: the least rate, in tenths, from which on that is good."""

    more: Mapping[str, Sequence[Tending]]
    faster: Mapping[str, Sequence[Tending]]
    least_hz: Mapping[str, Fraction]


def limits() -> Limits:
    noises = dict(zip(VEHICLES, ACCELERATION_NOISES, strict=True))
    return Limits(
        {name: [tending(noise, BETWEEN_S / n, n) for n in MEASUREMENTS] for name, noise in noises.items()},
        {name: [tending(noise, 1 / float(hz), N) for hz in RATES_HZ] for name, noise in noises.items()},
        {name: _least_hz(noise) for name, noise in noises.items()},
    )


def _least_hz(noise: float) -> Fraction:
    """By halving: the loss falls as the rate rises."""
    low, high = 0.1, float(RATES_HZ[-1])
    while high - low > 1e-3:
        middle = (low + high) / 2
        low, high = (low, middle) if tending(noise, 1 / middle, N).averaged_ratio <= GOOD else (middle, high)
    return Fraction(ceil(TENTHS * high), TENTHS)


def more_rows(found: Limits) -> Rows:
    """Ratios of variances with one time between gains."""
    last = VEHICLES[-1]
    rows: Rows = [["n", *VEHICLES, f"{last}, with R"]]
    for number, n in enumerate(MEASUREMENTS):
        ratios = [found.more[name][number].averaged_ratio for name in VEHICLES]
        rows.append([n, *map(ratio_text, [*ratios, found.more[last][number].sampled_ratio])])
    return rows


def faster_rows(found: Limits, costs: MultirateCosts[Fraction]) -> Rows:
    """Ratios of variances with one n, and the load. costs: the patent's, in seconds."""
    last = VEHICLES[-1]
    rows: Rows = [["Measurements a second", "load, %", *VEHICLES, f"{last}, with R"]]
    for number, hz in enumerate(RATES_HZ):
        ratios = [found.faster[name][number].averaged_ratio for name in VEHICLES]
        load = significant(100 * utilization(costs, every(N), 1 / hz))
        rows.append([f"{float(hz):g}", load, *map(ratio_text, [*ratios, found.faster[last][number].sampled_ratio])])
    return rows


def all_rows(found: Limits) -> Rows:
    """What the figure shows, under the names of its curves, and both ratios, for a spreadsheet."""
    divided: dict[str, str] = {reading: reading_text(reading) for reading in DIVIDED}
    ratios = {f"{reading}_ratio": f"variance ratio, {name}" for reading, name in divided.items()}
    names = {"optimal": EACH_GAIN, **divided, **ratios}
    rows: Rows = [["receiver", "n", "measurements a second", *names.values()]]
    for of in (found.more, found.faster):
        for name, tendings in of.items():
            for row in tendings:
                values = (getattr(row, name) for name in names)
                rows.append([name, row.n, f"{1 / row.period_s:g}", *(f"{value:.5g}" for value in values)])
    return rows
