"""Which filter is to be written."""

from __future__ import annotations

from typing import NamedTuple

from filters.arrays import FloatArray
from filters.covariance_forms import CovarianceFormName
from filters.system import System
from filters.translation.library import Precision
from studies.board.steps import Steps


class Filter(NamedTuple):
    """What is to be written. x0 (n,): a typical state. steps: of the dual rate filter. said: the command that asks."""

    method: str
    system: System
    x0: FloatArray
    update: CovarianceFormName
    precision: Precision
    steps: Steps | None
    said: str
