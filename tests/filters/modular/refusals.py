"""A filter, and what is refused of it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from filters.modular import Sensor, linear_corrector
from tests.filters.modular import cases
from tests.filters.modular.cases import linear_case

POSITION = linear_corrector(cases.H_POSITION, cases.R_POSITION)
GPS = linear_case(Sensor("gps", POSITION, every=2, delay=3), Sensor("other", POSITION))
Y = np.zeros(1)


def refused(message: str, action: Callable[[], Any]) -> None:
    with pytest.raises(ValueError, match=message):
        action()
