"""What a delayed measurement is worth at the output: exact covariances, by age. No schedule, only where it lands."""

from __future__ import annotations

from typing import TYPE_CHECKING

from filters.lazy import lazily

if TYPE_CHECKING:
    from filters.accuracy.approximate import discarded, with_divided_gain, with_low_rate_noise, with_wrong_noise
    from filters.accuracy.compose import Cycles, applied, composed, one_cycle, repeated
    from filters.accuracy.designs import Deviations, lossless_designs
    from filters.accuracy.exact import lossless, lossless_each
    from filters.accuracy.fresh import fused_as_fresh
    from filters.accuracy.in_flight import uncompensated
    from filters.accuracy.landing import Latest, landing_within, latest_landing
    from filters.accuracy.model import LinearModel, linear_model, linearised, output_rows
    from filters.accuracy.outcome import Accuracy
    from filters.accuracy.predictor import px4_predictor
    from filters.accuracy.sensors import SensorsModel, sensors_model, settled
    from filters.accuracy.shipped import SHIPPED_MODELS, Output, ShippedModel, shipped_model
    from filters.accuracy.stated_time import AtTime, after_cycles
    from filters.accuracy.trace import Along, Landing, Spread, along, spread

__all__ = [
    "SHIPPED_MODELS",
    "Accuracy",
    "Along",
    "AtTime",
    "Cycles",
    "Deviations",
    "Landing",
    "Latest",
    "LinearModel",
    "Output",
    "SensorsModel",
    "ShippedModel",
    "Spread",
    "after_cycles",
    "along",
    "applied",
    "composed",
    "discarded",
    "fused_as_fresh",
    "landing_within",
    "latest_landing",
    "linear_model",
    "linearised",
    "lossless",
    "lossless_designs",
    "lossless_each",
    "one_cycle",
    "output_rows",
    "px4_predictor",
    "repeated",
    "sensors_model",
    "settled",
    "shipped_model",
    "spread",
    "uncompensated",
    "with_divided_gain",
    "with_low_rate_noise",
    "with_wrong_noise",
]

__getattr__, __dir__ = lazily(
    __name__,
    {
        "filters.accuracy.approximate": "discarded with_divided_gain with_low_rate_noise with_wrong_noise",
        "filters.accuracy.compose": "Cycles applied composed one_cycle repeated",
        "filters.accuracy.designs": "Deviations lossless_designs",
        "filters.accuracy.exact": "lossless lossless_each",
        "filters.accuracy.fresh": "fused_as_fresh",
        "filters.accuracy.in_flight": "uncompensated",
        "filters.accuracy.landing": "Latest landing_within latest_landing",
        "filters.accuracy.model": "LinearModel linear_model linearised output_rows",
        "filters.accuracy.outcome": "Accuracy",
        "filters.accuracy.predictor": "px4_predictor",
        "filters.accuracy.sensors": "SensorsModel sensors_model settled",
        "filters.accuracy.shipped": "SHIPPED_MODELS Output ShippedModel shipped_model",
        "filters.accuracy.stated_time": "AtTime after_cycles",
        "filters.accuracy.trace": "Along Landing Spread along spread",
    },
)
