"""The compiled filter is the one that is tested as it is written."""

from __future__ import annotations

import numpy as np
import pytest

from filters.modular import Sensor, linear_corrector, run
from tests.filters.modular.cases import H_POSITION, R_POSITION, linear_case, measured


@pytest.mark.exhaust
def test_compiled_equals_reference() -> None:
    """A sensor that measures late at times, so that its corrections are also carried over others of its own."""
    case = linear_case(Sensor("position", linear_corrector(H_POSITION, R_POSITION)))
    measurements = [one._replace(arrives=one.taken + 3 * (one.taken % 5 == 0)) for one in measured(case, 40)]
    given = case.composed, case.x0, case.P0, case.inputs(40), measurements
    compiled, reference = (run(*given, late="larsen", backend=backend) for backend in ("compiled", "reference"))
    for found, expected in zip(compiled, reference, strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-14)
