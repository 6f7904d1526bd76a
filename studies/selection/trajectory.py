"""A trajectory of the user's: states and inputs, step by step, along which their System is linearised."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from filters.arrays import FloatArray
from filters.system import System
from sched_sim.bounds import short
from sched_sim.errors import InputError, option
from sched_sim.files.toml_reader import read_text
from studies.measurement.user_function import explained
from studies.selection.model import Model

MOST_STEPS = 200_000
"""Some ten seconds for each design."""


class Trajectory(NamedTuple):
    """x (steps + 1, n), u (steps + 1, m)."""

    x: FloatArray
    u: FloatArray

    @property
    def steps(self) -> int:
        return len(self.x) - 1


class Linearised(NamedTuple):
    """One of each for every step: Phi, Q (steps, n, n), H (steps, p, n), R (steps, p, p)."""

    Phi: FloatArray
    Q: FloatArray
    H: FloatArray
    R: FloatArray


def read_trajectory(path: Path, model: Model) -> Trajectory:
    """A row for each step: the n states, then the inputs if there are any; a first line of names is passed over.

    Raises InputError that names the line, for what is no number and for rows of another length.
    """
    said = f"{option('trajectory')} {str(path)!r}"
    if model.system is None:
        raise InputError(
            f"{said} is for a System, which changes along it, and {option('model')} {short(model.name)} is constant: "
            f"leave it out"
        )
    n, m = model.system.states, model.system.inputs
    text = read_text(path, said, "give a CSV file, a row for each step: the states, then the inputs")
    lines = [(number, line) for number, line in enumerate(text.splitlines(), 1) if line.strip()]
    rows: list[list[float]] = []
    for place, (number, line) in enumerate(lines):
        cells = [cell.strip() for cell in line.split(",")]
        try:
            values = [float(cell) for cell in cells]
        except ValueError:
            if place == 0:
                continue  # names
            raise InputError(f"{said}, line {number}: {short(line)!r} are no numbers between commas") from None
        if len(values) not in (n, n + m):
            raise InputError(
                f"{said}, line {number}: {len(values)} numbers; needed are the {n} states"
                f"{f', or these and the {m} inputs' if m else ''}"
            )
        if not np.isfinite(values).all():
            raise InputError(f"{said}, line {number}: a value is not finite; give numbers")
        if rows and len(values) != len(rows[0]):
            raise InputError(f"{said}, line {number}: {len(values)} numbers, and {len(rows[0])} in the rows before")
        rows.append(values)
    if not 2 <= len(rows) <= MOST_STEPS:
        raise InputError(f"{said} has {len(rows):,} rows of numbers: give 2 to {MOST_STEPS:,}, one for each step")
    table = np.array(rows)
    inputs = table[:, n:] if table.shape[1] == n + m else np.zeros((len(table), m))
    return Trajectory(np.ascontiguousarray(table[:, :n]), np.ascontiguousarray(inputs))


def linearised_along(system: System, path: Trajectory) -> Linearised:
    """Raises InputError where a function of the system fails."""
    parameters = system.parameters
    with explained(f"{option('trajectory')}: the model"):
        steps = [(j, path.x[j].copy(), path.u[j].copy()) for j in range(path.steps + 1)]
        return Linearised(
            np.array([np.array(system.F(j, x, u, parameters)) for j, x, u in steps]),
            np.array([np.array(system.Q(j, parameters)) for j, _, _ in steps]),
            np.array([np.array(system.H(j, x, parameters)) for j, x, _ in steps]),
            np.array([np.array(system.R(j, parameters)) for j, _, _ in steps]),
        )
