"""The accuracy of a method that loses nothing: that of the age of its outputs, whatever the method."""

from __future__ import annotations

from collections.abc import Sequence

from numpy.typing import ArrayLike

from filters.accuracy.model import LinearModel, output_rows
from filters.accuracy.outcome import Accuracy, check_steps, of_cycle
from filters.accuracy.periodic import steady


def lossless(model: LinearModel, outputs: ArrayLike, N: int, L: int) -> Accuracy:
    """A measurement every N steps that is in the output L steps later, L = 0, 1, ..., also beyond N.

    outputs: rows C (o, n), or the numbers of the states that are the outputs.
    Raises ValueError, naming it: N, L or the outputs are wrong; outputs whose variance has no bound (`visible`); an N
    that a mode of the model goes unseen at.
    """
    return lossless_each(model, outputs, N, [L])[0]


def lossless_each(model: LinearModel, outputs: ArrayLike, N: int, landings: Sequence[int]) -> list[Accuracy]:
    """`lossless` for several L, at little more than the cost of one."""
    check_steps("N", N, 1)
    for L in landings:
        check_steps("L", L, 0)
    C = output_rows(outputs, model.states)
    regime = steady(model, C, [N], N + max(landings, default=0))
    variances, jumps = regime.variances[0], regime.jumps[0]
    no_delay = float(variances[:N].max())
    return [of_cycle(N, int(L), variances[L : L + N], no_delay, float(jumps[L])) for L in landings]
