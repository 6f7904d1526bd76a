"""The model that is asked about: a shipped one by its name, or what the user's own function returns."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from filters.accuracy.model import LinearModel, linear_model, linearised
from filters.accuracy.shipped import SHIPPED_MODELS, ShippedModel
from filters.arrays import FloatArray
from filters.system import System
from sched_sim.bounds import short
from sched_sim.errors import InputError, option
from studies.measurement.user_function import Returned, explained, returned_by
from studies.measurement.user_system import checked_system

HOW = (
    f"give one of {', '.join(SHIPPED_MODELS)}, or package.module:function, a function without arguments that returns a "
    f"filters.System, (System, typical state) or a filters.accuracy.LinearModel"
)

INPUTS = {"ins-gps": 3, "ins-rtk": 3, "star-tracker": 1}
"""Of the shipped models that have some, which are no part of a `LinearModel`: specific force, turn rate."""


@dataclass(frozen=True)
class Model:
    """name: as it was asked for. linear: at `hr_hz` where that matters. inputs: as many as the costs are of.

    shipped: one that comes with the project, with its rate, interval, delay and outputs. system, x0: of the user's own
    System, and the state (n,) at which it is linearised.
    """

    name: str
    linear: LinearModel
    inputs: int
    shipped: ShippedModel | None = None
    system: System | None = None
    x0: FloatArray | None = None

    @property
    def sizes(self) -> tuple[int, int, int]:
        """States, inputs, measurements."""
        return self.linear.states, self.inputs, len(self.linear.H)


def shipped_defaults(asked: Any) -> ShippedModel | None:
    """The shipped model of this name, None for what is the user's own. Raises InputError for a name that is neither."""
    if not isinstance(asked, str):
        return None
    if asked not in SHIPPED_MODELS and ":" not in asked:
        raise InputError(f"{option('model')} {short(asked)!r} is unknown: {HOW}")
    return SHIPPED_MODELS.get(asked)


def load_model(asked: Any, hr_hz: Fraction | None) -> Model:
    """asked: a name, a LinearModel, a System or (System, x0). hr_hz: at which a shipped one is discretised, by default
    its own.

    Raises InputError that names the model and what is wrong with it.
    """
    shipped = shipped_defaults(asked)
    if shipped is not None:
        rate = shipped.hr_hz if hr_hz is None else float(hr_hz)
        return Model(shipped.name, shipped.model(rate), INPUTS.get(shipped.name, 0), shipped)
    returned = returned_by(asked, option("model"), HOW) if isinstance(asked, str) else Returned("model", asked)
    return model_of(returned, asked)


def model_of(returned: Returned, asked: Any) -> Model:
    """Of a LinearModel, a System or (System, x0); asked: as it was named. Raises InputError for what is none."""
    said = f"{option('model')} {short(asked)!r}" if isinstance(asked, str) else option("model")
    value = returned.value
    if isinstance(value, LinearModel):
        with explained(said):
            return Model(_shown(asked), linear_model(*value), 0)
    system, x0 = checked_system(returned, said, HOW)
    with explained(said):
        return Model(_shown(asked), linearised(system, x0), system.inputs, None, system, x0)


def _shown(asked: Any) -> str:
    return asked if isinstance(asked, str) else "model"
