"""Which composed filter is to be written."""

from __future__ import annotations

import re
from typing import NamedTuple

from filters.arrays import FloatArray
from filters.modular.composition import ModularFilter
from filters.translation.library import Precision
from filters.translation.names import c_name


class Composed(NamedTuple):
    """What is to be written. name: of the function that makes it; x0, P0, u: a typical start."""

    name: str
    composed: ModularFilter
    x0: FloatArray
    P0: FloatArray
    u: FloatArray
    precision: Precision
    said: str

    @property
    def depth(self) -> int:
        """How many steps back a measurement may be."""
        return max((sensor.longest_delay for sensor in self.composed.sensors), default=0)

    @property
    def identifiers(self) -> dict[str, str]:
        """Of its sensors, in C."""
        found: dict[str, str] = {}
        for sensor in self.composed.sensors:
            wanted = c_name(re.sub(r"\W", "_", sensor.name, flags=re.ASCII))
            while wanted in found.values():
                wanted += "_"
            found[sensor.name] = wanted
        return found
