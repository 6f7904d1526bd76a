"""The accuracy at a stated time: in a transient, and where variances have no bound, as a hovering vehicle's yaw."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from filters.accuracy.compose import applied, one_cycle, repeated
from filters.accuracy.model import LinearModel, output_rows
from filters.accuracy.outcome import check_steps
from filters.accuracy.periodic import by_age, noise_by_age
from filters.accuracy.prefix import prefix
from filters.accuracy.riccati import posterior
from filters.arrays import as_array
from filters.covariances import check_covariance


class AtTime(NamedTuple):
    """worst, rms: of the N outputs from the landing of a measurement on, as standard deviations. step: of the first."""

    step: int
    worst: float
    rms: float


def after_cycles(model: LinearModel, outputs: ArrayLike, N: int, L: int, cycles: int, P0: ArrayLike) -> AtTime:
    """Of the outputs whose newest measurement is that of step cycles * N, from its landing L steps later on.

    P0 (n, n): covariance in step 0, before the first measurement. Other arguments and errors as `lossless`, but outputs
    may depend on what no measurement sees.
    """
    check_steps("N", N, 1)
    check_steps("L", L, 0)
    check_steps("cycles", cycles, 0)
    C = output_rows(outputs, model.states)
    start = as_array("P0", P0)
    if start.shape != model.Q.shape:
        raise ValueError(f"P0 has shape {start.shape}, needed is {model.Q.shape}")
    check_covariance("P0", start)
    _, after = posterior(applied(repeated(one_cycle(model, N), cycles), start), model.H, model.R)
    oldest = N + L - 1
    over = prefix(model, oldest)
    variances = (by_age(over, C, after[None], oldest)[0] + noise_by_age(over, C, oldest))[L:].clip(0.0)
    return AtTime(cycles * N + L, float(np.sqrt(variances.max())), float(np.sqrt(variances.mean())))
