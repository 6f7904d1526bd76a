"""Filters composed of one predictor and a corrector for each sensor: linear, extended and unscented, freely mixed."""

from filters.modular.composition import ModularFilter, Sensor
from filters.modular.correctors import extended_corrector, linear_corrector, unscented_corrector
from filters.modular.history import ModularHistory
from filters.modular.late import run
from filters.modular.measurements import Measurement, observe
from filters.modular.predictors import extended_predictor, linear_predictor, unscented_predictor
from filters.modular.sigma_points import maccormack, merwe
from filters.modular.space import space

ALLOCATION_FREE = True


__all__ = [
    "Measurement",
    "ModularFilter",
    "ModularHistory",
    "Sensor",
    "extended_corrector",
    "extended_predictor",
    "linear_corrector",
    "linear_predictor",
    "maccormack",
    "merwe",
    "observe",
    "run",
    "space",
    "unscented_corrector",
    "unscented_predictor",
]
