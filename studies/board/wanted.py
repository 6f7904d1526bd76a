"""Which filter is to be written."""

from __future__ import annotations

from typing import NamedTuple

from filters.arrays import FloatArray
from filters.covariance_forms import CovarianceFormName
from filters.delayed.dual_rate import GainTime
from filters.delayed.low_rate_noise import LowRateNoise
from filters.system import System
from filters.translation.library import Precision
from studies.board.steps import Steps


class Filter(NamedTuple):
    """What is to be written. x0 (n,): a typical state. steps: None for the jobs alone. said: the command that asks.

    gain, low_rate_noise: of the dual rate filter, see `filters.delayed.dual_rate.run`.
    """

    method: str
    system: System
    x0: FloatArray
    update: CovarianceFormName
    precision: Precision
    steps: Steps | None
    said: str
    gain: GainTime = "at-update"
    low_rate_noise: LowRateNoise = "exact"

    @property
    def choices(self) -> dict[str, str]:
        """Of the dual rate filter, those that are not usual, by the name of their argument."""
        usual = Filter._field_defaults
        return {name: getattr(self, name) for name in ("gain", "low_rate_noise") if getattr(self, name) != usual[name]}
