"""Results of the study of the rocket's biases as a table to be stored."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from reports.pages.stored import Rows, digits
from studies.modular.biases import Row
from studies.modular.rocket import QUANTITIES
from studies.modular.typical import quantile

READINGS = {"position": "position / distance from the pad", "orientation": "orientation / all turned"}
"""The reading of the claim by which each quantity keeps to it without biases."""
ENDS = ("", " low", " high")


def bias_rows(found: Iterable[Row]) -> Rows:
    """A row for each case: errors of a typical flight in m and degrees, how many flights keep to the claim from a
    second after ignition on, from when on all do, and the worst share in percent from a second on."""
    heads = [f"{name}{what}" for name in READINGS for what in (*ENDS, " holds", " from s", " worst")]
    rows: Rows = [["biased", "size", "runs", *heads]]
    quantities = [quantity.split(",")[0] for quantity in QUANTITIES]
    for row in found:
        residuals = {each.reading: each for each in row.residuals}
        cells: list[str] = []
        for name, reading in READINGS.items():
            residual, error = residuals[reading], quantile(row.errors.rms[:, quantities.index(name)])
            cells += [*map(digits, error), str(residual.hold), *map(_digits, (residual.holds_from_s, residual.worst))]
        biased = " and ".join(row.biases.sensors)
        rows.append([biased, f"{row.biases.size:g}", str(len(row.errors.rms)), *cells])
    return rows


def _digits(value: float) -> str:
    return digits(value) if np.isfinite(value) else "inf"
