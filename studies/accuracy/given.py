"""The shipped models as the study takes them: at their rates, with the motion that a wrong method does not know of."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from filters.accuracy import SHIPPED_MODELS, LinearModel, shipped_model
from filters.arrays import FloatArray

INPUTS = {"ins-gps": 3, "ins-rtk": 3, "star-tracker": 1, "camera": 1}
"""Of each model's filter, which count in its operations: accelerations and turn rates; none are in its accuracy."""


class Motion(NamedTuple):
    """speed: in the unit of the output per second, along its first axis."""

    speed: float
    unit: str
    what: str


MOTIONS: Mapping[str, Motion] = {
    "ins-gps": Motion(15.0, "m/s", "15 m/s, as in the model's turn"),
    "ins-rtk": Motion(15.0, "m/s", "15 m/s, as in the model's turn"),
    "star-tracker": Motion(1.1e-3, "rad/s", "1.1 mrad/s, of a spacecraft that faces the Earth in 95 minutes' orbit"),
    "camera": Motion(1.0, "m/s", "1 m/s"),
}
"""What the vehicle does while a measurement is under way; stated, not estimated."""


class Given(NamedTuple):
    """A model at its high rate. states: the outputs. N, M: in steps of 1 / hr_hz. sizes: states, inputs, measurements.

    displacement (measurements,): by `MOTIONS`, of the measured quantity during the delay.
    """

    name: str
    model: LinearModel
    states: list[int]
    unit: str
    hr_hz: float
    N: int
    M: int
    displacement: FloatArray

    @property
    def sizes(self) -> tuple[int, int, int]:
        return self.model.states, INPUTS[self.name], len(self.model.H)

    def ms(self, steps: float) -> float:
        return 1000.0 * steps / self.hr_hz


def given(name: str) -> Given:
    """Raises ValueError for a model that does not ship."""
    shipped = shipped_model(name)
    model, output = shipped.model(shipped.hr_hz), shipped.outputs[shipped.output]
    displacement = np.zeros(len(model.H))
    displacement[0] = MOTIONS[name].speed * shipped.delay_s
    return Given(name, model, output.states, output.unit, shipped.hr_hz, shipped.N, shipped.M, displacement)


MODELS = tuple(SHIPPED_MODELS)
