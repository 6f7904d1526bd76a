"""The correction of an estimate by one measurement: the part of a filter that is done, and costed, as a whole."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

from filters.arrays import Flags, FloatArray
from filters.modular.correctors import apply
from filters.modular.space import Space
from filters.modular.workspace import Workspace
from filters.records import Estimate


def correct_with(
    expect: Callable[..., None],
    view: Any,
    observed: Space,
    of: Space,
    before: Estimate,
    y: FloatArray,
    lost: Flags,
    after: Estimate,
    work: Workspace,
) -> None:
    """Job: `after` is `before`, corrected by the measurement y, of which what is lost is left out, see `apply`.

    expect, view, observed: see `correctors.Corrector`.
    """
    expect(view, observed, of, before, work)
    apply(observed, of, before, y, lost, after, work)


@cache
def correction_by(expect: Callable[..., None]) -> Callable[..., None]:
    """`correct_with` of these correctors: numba inlines a function that a job names, but not one of its arguments.

    Same function in, same function out, so that it is compiled once.
    """

    def correct(
        view: Any,
        observed: Space,
        of: Space,
        before: Estimate,
        y: FloatArray,
        lost: Flags,
        after: Estimate,
        work: Workspace,
    ) -> None:
        correct_with(expect, view, observed, of, before, y, lost, after, work)

    return correct
