"""How late a correction may land for the output to stay within an accuracy: a deadline from an error bound."""

from __future__ import annotations

from typing import Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from filters.accuracy.model import LinearModel, output_rows
from filters.accuracy.outcome import check_steps
from filters.accuracy.periodic import mean, steady, worst
from filters.choice import check_choice

Metric: TypeAlias = Literal["worst", "rms"]


class Latest(NamedTuple):
    """L: the latest landing; None where even the earliest is not within the bound.

    reached: the standard deviation with that L. best: with the earliest, L = M; the least that can be asked for.
    bounded: whether a later landing is out of the bound; if not, the search ended there.
    """

    L: int | None
    reached: float | None
    best: float
    bounded: bool


def latest_landing(
    model: LinearModel,
    outputs: ArrayLike,
    N: int,
    within: float,
    M: int,
    *,
    metric: Metric = "worst",
    most: int | None = None,
) -> Latest:
    """The largest L such that all landings from M to it keep the output within a standard deviation.

    M: the earliest landing. metric: "worst" of a cycle, or "rms". most: where the search ends, M + 8 N if not given.
    Other arguments and errors as `lossless`; ValueError too if `within` is no positive number, or most < M.
    """
    check_steps("N", N, 1)
    check_steps("M", M, 0)
    end = M + 8 * N if most is None else most
    check_steps("most", end, M)
    check_choice("metric", metric, ("worst", "rms"))
    if isinstance(within, bool) or not isinstance(within, int | float | np.number) or not 0.0 < within < np.inf:
        raise ValueError(f"within={within!r} must be a positive standard deviation, in the unit of the outputs")
    C = output_rows(outputs, model.states)
    figure = worst if metric == "worst" else mean
    reach = min(M + N, end)
    while True:
        landings = np.arange(M, reach + 1)
        variances = steady(model, C, [N], N + reach).variances[0]
        deviations = np.sqrt(figure(variances, N, landings))
        late = np.flatnonzero(deviations > within)
        if len(late) or reach == end:
            break
        reach = min(2 * reach, end)
    kept = int(late[0]) if len(late) else len(landings)
    best = float(deviations[0])
    if kept == 0:
        return Latest(None, None, best, bounded=True)
    return Latest(M + kept - 1, float(deviations[kept - 1]), best, bounded=bool(len(late)))


def landing_within(
    model: LinearModel, outputs: ArrayLike, N: int, within: float, M: int, *, metric: Metric = "worst"
) -> int:
    """The L of `latest_landing`. Raises ValueError, saying the best that there is, where no landing keeps the bound."""
    latest = latest_landing(model, outputs, N, within, M, metric=metric)
    if latest.L is None:
        raise ValueError(
            f"within={within:g}: no landing reaches it; the best there is, landing at M={M} with a measurement every "
            f"N={N} steps, is {metric} {latest.best:.6g}; allow that, measure more often, or take a better sensor"
        )
    return latest.L
