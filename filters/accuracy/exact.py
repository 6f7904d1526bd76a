"""The accuracy of a method that loses nothing: that of the age of its outputs, whatever the method."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, sqrt

from numpy.typing import ArrayLike

from filters.accuracy.model import LinearModel, output_rows
from filters.accuracy.outcome import Accuracy, check_steps, of_cycle
from filters.accuracy.pattern import Interval, check_interval
from filters.accuracy.regime import in_steps, mean_of, regime, worst_of


def lossless(model: LinearModel, outputs: ArrayLike, N: Interval, L: int) -> Accuracy:
    """A measurement every N steps that is in the output L steps later, L = 0, 1, ..., also beyond N.

    N: a whole number of steps or a quotient, see `pattern`. outputs: rows C (o, n), or the numbers of the states that
    are the outputs.
    Raises ValueError, naming it: N, L or the outputs are wrong; outputs whose variance has no bound (`visible`,
    `unseen`); an N at which the covariance is not found.
    """
    return lossless_each(model, outputs, N, [L])[0]


def lossless_each(model: LinearModel, outputs: ArrayLike, N: Interval, landings: Sequence[int]) -> list[Accuracy]:
    """`lossless` for several L, at little more than the cost of one."""
    N = check_interval("N", N)
    for L in landings:
        check_steps("L", L, 0)
    C = output_rows(outputs, model.states)
    found = regime(model, C, N, ceil(N) + max(landings, default=0))
    no_delay = float(worst_of(found, 0))
    each = [of_cycle(N, int(L), in_steps(found, L), no_delay, float(found.jumps[:, L].max())) for L in landings]
    if not found.bound:
        return each
    means = mean_of(found, landings)
    return [of._replace(rms=sqrt(mean), verdict="bound") for of, mean in zip(each, means, strict=True)]
