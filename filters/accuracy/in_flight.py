"""Late corrections whose innovations do not take those in flight into account: unstable for good models."""

from __future__ import annotations

from numpy.typing import ArrayLike

from filters.accuracy.cyclic.engine import regime
from filters.accuracy.cyclic.methods import carried
from filters.accuracy.exact import lossless
from filters.accuracy.model import LinearModel, output_rows
from filters.accuracy.outcome import Accuracy, check_steps, of_cycle
from filters.accuracy.periodic import steady
from filters.accuracy.riccati import gain
from filters.accuracy.visible import visible


def uncompensated(model: LinearModel, outputs: ArrayLike, N: int, L: int) -> Accuracy:
    """The dual rate filter beyond its assumption 2, L > N, as it stands: corrections computed from an output that lacks
    those before them. Up to L = N it is exact. Arguments and errors as `lossless`."""
    check_steps("L", L, 0)
    exact = lossless(model, outputs, N, L)
    if L <= N:
        return exact
    left, C = visible(model, output_rows(outputs, model.states))
    K = gain(steady(left, C, [N], 0).before[0], left.H, left.R)
    found = regime(carried(left, C, N, L, K, compensated=False))
    return of_cycle(
        N,
        L,
        found.variances,
        exact.no_delay**2,
        float(found.moves.max()),
        believed=exact.worst**2,
        radius=found.radius,
        verdict="approximate",
    )
