"""The correction of an estimate by one measurement: the part of a filter that is done, and costed, as a whole."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

from filters.arrays import Flags, FloatArray
from filters.modular.composition import ModularFilter
from filters.modular.correctors import Corrector, estimate_error, observe_numeric
from filters.modular.space import Space, plus
from filters.modular.u_d import u_d_correction_by
from filters.modular.updates import Covariance, covariance_of
from filters.modular.workspace import Workspace
from filters.records import Estimate

Correction = Callable[[Any, Space, Space, Estimate, FloatArray, Flags, Estimate, Workspace], None]
"""correct(view, observed, space, before, y, lost, after, work): `after` is `before`, corrected by the measurement y.

view, observed: see `correctors.Corrector`; lost: see `correctors.estimate_error`.
"""


def correction(composed: ModularFilter, corrector: Corrector) -> Correction:
    """The job of this corrector of the filter."""
    if composed.update == "u-d":
        assert corrector.observe is not None  # none of the parts is unscented, see `ModularFilter`
        return u_d_correction_by(corrector.observe, corrector.observe is observe_numeric)
    return _correction_by(corrector.expect, covariance_of(composed.update, corrector.kind))


@cache
def _correction_by(expect: Callable[..., None], covariance: Covariance) -> Correction:
    """Functions that a job names are inlined by numba, but not its arguments.

    Same functions in, same function out, so that it is compiled once.
    """

    def correct(
        view: Any,
        observed: Space,
        space: Space,
        before: Estimate,
        y: FloatArray,
        lost: Flags,
        after: Estimate,
        work: Workspace,
    ) -> None:
        expect(view, observed, space, before, work)
        estimate_error(observed, space, y, lost, work)
        plus(space, before.x, work.n1, after.x)
        covariance(view, before.P, after.P, work)

    return correct
