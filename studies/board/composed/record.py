"""A record of data for a composed filter, and its run on it."""

from __future__ import annotations

from math import ceil
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.modular.late import run
from filters.modular.measurements import Measurement, observe
from filters.modular.typical import evolved
from filters.translation.data import Data, Kept
from filters.translation.unit import Unit
from studies.board.composed.wanted import Composed
from studies.board.record import held
from studies.board.template import filled

MOST_STEPS, SEED = 200, 0
"""Of the record, and that of its random numbers."""


class Recorded(NamedTuple):
    """u (steps, m); measurements in the order of their arrival; x (steps + 1, numbers): Python's states."""

    u: FloatArray
    measurements: list[Measurement]
    x: FloatArray

    def of(self, name: str) -> list[Measurement]:
        """Those of a sensor."""
        return [each for each in self.measurements if each.sensor == name]

    def header(self, wanted: Composed) -> str:
        """record.h."""
        data = Data(Unit(wanted.precision))
        arrays = {"x0": held(wanted.x0, wanted.precision), "P0": wanted.P0, "u": self.u, "x": self.x}
        for name, values in arrays.items():
            if values.size:
                data.array(Kept(f"record_{name}"), values)
        for name, own in wanted.identifiers.items():
            if rows := self.of(name):
                for which in ("taken", "arrives"):
                    steps = np.array([getattr(row, which) for row in rows], dtype=np.int64)
                    data.array(Kept(f"record_{own}_{which}", constant=True), steps, "int")
                data.array(Kept(f"record_{own}_y"), np.array([row.y for row in rows]))
        return filled("record.h", {"enum": f"RECORD_STEPS = {len(self.u)}", "data": "\n".join(data.lines)})

    def run(self, wanted: Composed) -> str:
        """The function of test.c that runs the filter on it."""
        lines = []
        for name, own in wanted.identifiers.items():
            if rows := self.of(name):
                lines += [
                    f"        for (int i = 0; i < {len(rows)}; i++) {{",
                    f"            if (record_{own}_arrives[i] == j) {{",
                    f"                filter_measure_{own}(record_{own}_taken[i], record_{own}_y[i]);",
                    "            }",
                    "        }",
                ]
        measured = "".join(f"{line}\n" for line in lines)
        u = "record_u[j - 1]" if len(wanted.u) else ""
        return filled("steps/composed_run.c", {"u": u, "measured": measured})


def recorded(wanted: Composed) -> Recorded:
    """A record along a path without noise, until each sensor has measured twice or more."""
    composed, precision = wanted.composed, wanted.precision
    longest = max((ceil(2 * sensor.every) + sensor.longest_delay for sensor in composed.sensors), default=5)
    steps = min(longest + 2, MOST_STEPS)
    u = held(np.tile(wanted.u, (steps, 1)), precision)
    truth = [held(wanted.x0, precision)]
    for j in range(steps):
        truth.append(evolved(composed, truth[-1], u[j]))
    measurements = [
        each._replace(y=held(np.asarray(each.y), precision))
        for each in observe(composed, np.array(truth), SEED)
        if each.arrives <= steps
    ]
    return Recorded(u, measurements, run(composed, truth[0], wanted.P0, u, measurements).x)
