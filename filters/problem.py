"""Checks of what is given to a filter run."""

from __future__ import annotations

from typing import NamedTuple, cast

import numpy as np
from numpy.typing import ArrayLike

from filters.arrays import FloatArray, as_array
from filters.covariances import check_covariance, check_noise
from filters.kind import check_kind
from filters.measured import Measured, Measurements, measured
from filters.records import Estimate
from filters.sparse.structure import Structure, check_structure, with_losses
from filters.system import System
from filters.systems.lossy import lossy
from filters.systems.shaped import shaped
from filters.systems.structured import checked
from filters.systems.trial import first_input, try_functions
from filters.systems.turns import check_turns


class Problem(NamedTuple):
    """What a run is given, once it is checked: as arrays of floats, P0 exactly symmetric.

    system: that of the run; where measurements were lost, `lossy`. without_losses: the same where they were not.
    start: x0 and P0. inputs (steps, m); measured: rows (any, p). structure: of the matrices that `system` gives.
    """

    system: System
    without_losses: System
    start: Estimate
    inputs: FloatArray
    measured: Measured
    structure: Structure | None


def check_problem(
    system: System,
    N: int,
    M: int,
    L: int,
    x0: ArrayLike,
    P0: ArrayLike,
    inputs: ArrayLike,
    measurements: Measurements,
    *,
    several: bool = False,
) -> Problem:
    """Raises ValueError, naming the argument, unless 0 <= M <= L <= N, N >= 1, all shapes fit and all is finite.

    several: measurements may be taken before one arrives, so that M and L may be more than N.
    """
    for name, value in (("N", N), ("M", M), ("L", L)):
        if not isinstance(value, int | np.integer):
            raise ValueError(f"{name}={value!r} must be a whole number of steps")
    if N < 1:
        raise ValueError(f"N={N} must be at least 1: it is the number of steps between measurements")
    if not 0 <= M <= L or (L > N and not several):
        rule = "0 <= M <= L" if several else "0 <= M <= L <= N"
        other = "; with more than N, use recalculate, larsen, clone, carried_gain or dual_rate" if 0 <= M <= L else ""
        raise ValueError(f"M={M}, L={L}, N={N} must satisfy {rule}{other}")
    start, moves = _start_and_inputs(system, x0, P0, inputs)
    readings = measured(system.measurements, N, measurements)
    if len(readings.y) > (most := len(moves) // N + 1):
        raise ValueError(
            f"measurements has {len(readings.y)} rows, and in {len(moves)} steps {most} are taken with N={N}: row c is "
            f"of step c N; leave out those after the end"
        )
    return _problem(system, N, start, moves, readings)


def check_multirate_problem(
    system: System, n: int, L: int, x0: ArrayLike, P0: ArrayLike, inputs: ArrayLike, measurements: Measurements
) -> Problem:
    """`check_problem` for a measurement in every step. Raises ValueError unless 0 <= L <= n, n >= 1, and so on."""
    if not isinstance(n, int | np.integer) or n < 1:
        raise ValueError(f"n={n!r} must be a whole number, at least 1: it is the number of steps between gains")
    if not isinstance(L, int | np.integer) or not 0 <= L <= n:
        raise ValueError(f"L={L}, n={n} must satisfy 0 <= L <= n: a gain is in use before the next one is computed")
    start, moves = _start_and_inputs(system, x0, P0, inputs)
    readings = measured(system.measurements, 1, measurements)
    if len(readings.y) != len(moves) + 1:
        needed = len(moves) + 1, system.measurements
        raise ValueError(f"measurements has shape {readings.y.shape}, the system needs {needed}")
    return Problem(looked_at := shaped(system), looked_at, start, moves, readings, None)


def _problem(system: System, every: int, start: Estimate, moves: FloatArray, readings: Measured) -> Problem:
    structure, looked_at = checked_structure(system), shaped(system)
    if structure is not None:
        looked_at = checked(looked_at, structure)
        structure = structure if readings.present.all() else with_losses(structure)
    return Problem(lossy(looked_at, every, readings.present), looked_at, start, moves, readings, structure)


def _start_and_inputs(system: System, x0: ArrayLike, P0: ArrayLike, inputs: ArrayLike) -> tuple[Estimate, FloatArray]:
    """The system is tried too, at x0."""
    check_system("system", system)
    n = system.states
    x, P = _numbers("x0", x0, (n,)), _numbers("P0", P0, (n, n))
    check_covariance("P0", P)
    moves = as_array("inputs", inputs)
    if moves.ndim != 2:
        without = "" if system.inputs else ", np.empty((steps, 0)) for a system without inputs"
        problem = "is None" if inputs is None else f"has shape {moves.shape}"
        raise ValueError(f"inputs {problem}; give a row of {system.inputs} numbers for each step{without}")
    moves = _numbers("inputs", moves, (len(moves), system.inputs))
    _check_system(system, x, moves)
    return Estimate(x, 0.5 * (P + P.T)), moves


def check_system(name: str, system: object) -> None:
    """Raises ValueError, naming the argument, unless it is a `System` of whole sizes, made of functions."""
    check_kind(name, system, System, "a filters.system.System, as linear_system(...) returns one")
    for function in ("f", "F", "Q", "h", "H", "R"):
        value = getattr(system, function)
        if not callable(value):
            raise ValueError(f"{function} of the {name} is {value!r:.60}; give a function, see System")
    for size_name, least in (("states", 1), ("inputs", 0), ("measurements", 1)):
        size = getattr(system, size_name)
        if isinstance(size, bool) or not isinstance(size, int | np.integer) or size < least:
            raise ValueError(f"{size_name}={size!r} of the {name} must be a whole number, at least {least}")
    checked_structure(cast(System, system), name)


def checked_structure(system: System, name: str = "system") -> Structure | None:
    """What the system states. Raises ValueError, naming it, if it does not fit."""
    if system.structure is None:
        return None
    return check_structure(f"the structure of the {name}", system.structure, system.states, system.measurements)


def _check_system(system: System, x: FloatArray, inputs: FloatArray) -> None:
    """Raises ValueError unless its functions give what they must, in step 0 at x (n,) with the first of the inputs.

    Numbers that are not finite and depend on the estimate are left to the run, which says in which step they come.
    """
    try_functions(system, x, first_input(inputs))
    check_turns(system, x, first_input(inputs))
    for name, covariance in (("Q", system.Q(0, system.parameters)), ("R", system.R(0, system.parameters))):
        check_noise(name, covariance, 0)


def _numbers(name: str, value: ArrayLike, needed: tuple[int, ...]) -> FloatArray:
    """A contiguous copy of finite numbers."""
    array = as_array(name, value)
    if array.shape != needed:
        raise ValueError(f"{name} has shape {array.shape}, the system needs {needed}")
    if not np.isfinite(array).all():
        at = ", ".join(map(str, np.argwhere(~np.isfinite(array))[0]))
        raise ValueError(f"{name} holds a value that is not finite, at [{at}]; give numbers")
    return array
