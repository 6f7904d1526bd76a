"""What a sample says: its quantiles, and the probability of an event that was seen so often."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, sqrt

Z95 = 1.959963984540054
"""97.5 % of a normal distribution lie below."""

PERCENTS = (50, 95, 99)


@dataclass(frozen=True, slots=True)
class Distribution:
    """Figures of values, in their unit. median, p95, p99: the least value that so large a share does not exceed."""

    minimum: float
    mean: float
    median: float
    p95: float
    p99: float
    maximum: float

    @classmethod
    def of(cls, values: Sequence[float]) -> Distribution:
        ordered = sorted(values)
        count = len(ordered)
        median, p95, p99 = (ordered[ceil(count * percent / 100) - 1] for percent in PERCENTS)
        return cls(ordered[0], sum(ordered) / count, median, p95, p99, ordered[-1])


def finished_or_not(values: Sequence[float], unfinished: int) -> dict[str, float | None]:
    """`Distribution.of` where so many more values are not known yet and any of them may be long.

    minimum, mean, maximum: of the known values. median, p95, p99: of all; None where the unknown ones decide. At least
    one value is known.
    """
    known = Distribution.of(values)
    ordered, count = sorted(values), len(values) + unfinished
    ranks = (ceil(count * percent / 100) for percent in PERCENTS)
    median, p95, p99 = (ordered[rank - 1] if rank <= len(ordered) else None for rank in ranks)
    quantiles = {"median": median, "p95": p95, "p99": p99}
    return {"minimum": known.minimum, "mean": known.mean, **quantiles, "maximum": known.maximum}


def below_which_unresolved(trials: float) -> float:
    """A probability, at most 1, which so many independent trials without the event do not tell from less: from 3/n on,
    the event would have been seen with 95 %, for (1 - 3/n)^n < 5 %."""
    return min(3 / trials, 1.0)


def wilson(events: float, trials: int) -> tuple[float, float]:
    """The 95 % interval of a probability by Wilson's score, for `events` in `trials` independent ones, at least one.

    Misses of a schedule come in a row, which makes them less than independent: the true interval is then wider.
    """
    share, z2 = events / trials, Z95**2
    centre = share + z2 / (2 * trials)
    half = Z95 * sqrt(share * (1 - share) / trials + z2 / (4 * trials**2))
    scale = 1 + z2 / trials
    least = (centre - half) / scale if events else 0.0
    most = (centre + half) / scale if events < trials else 1.0
    return least, most
