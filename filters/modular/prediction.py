"""The prediction of a filter: the part that is done, and costed, in every step."""

from __future__ import annotations

from collections.abc import Callable

from filters.modular.composition import ModularFilter
from filters.modular.predictors import evolve_numeric
from filters.modular.u_d import u_d_prediction_by


def prediction(composed: ModularFilter) -> Callable[..., None]:
    """The job of its predictor, predict(motion, space, before, u, dt, after, work), see `predictors.Predictor`."""
    predictor = composed.predictor
    if composed.update == "u-d":
        assert predictor.evolve is not None  # it is not unscented, see `ModularFilter`
        return u_d_prediction_by(predictor.evolve, predictor.evolve is evolve_numeric)
    return predictor.predict
