"""Try the functions of a system once: what is wrong with one is best said by its name, before it is compiled.

Neither compiled code nor loops over what there is notice a matrix of another size: they go on with a part of it, or
with whatever lies behind it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray, check_unmasked
from filters.system import System

UNWRITTEN = np.finfo(np.float64).max
"""What out holds before the call: no model gives it."""


class Trial(NamedTuple):
    """One function of a system, to be called once.

    signature: its name and arguments; shape: of what it must give. given: what it must leave as it is; kept: as it was.
    """

    signature: str
    call: Callable[[], Any]
    shape: tuple[int, ...]
    given: dict[str, Any]
    kept: dict[str, list[Any]]


def trials(system: System, x: FloatArray, u: FloatArray) -> tuple[Trial, ...]:
    """All functions, in step 0, at the state x (n,) with the input u (m,)."""
    n, p, parameters = system.states, system.measurements, system.parameters
    arguments = {"x": x, "u": u, "p": parameters}
    kept = {name: _leaves(value) for name, value in arguments.items()}
    wanted: tuple[tuple[str, Callable[[], Any], tuple[int, ...]], ...] = (
        ("f(j, x, u, p, out)", lambda: _filled(n, lambda out: system.f(0, x, u, parameters, out)), (n,)),
        ("F(j, x, u, p)", lambda: system.F(0, x, u, parameters), (n, n)),
        ("Q(j, p)", lambda: system.Q(0, parameters), (n, n)),
        ("h(k, x, p, out)", lambda: _filled(p, lambda out: system.h(0, x, parameters, out)), (p,)),
        ("H(k, x, p)", lambda: system.H(0, x, parameters), (p, n)),
        ("R(k, p)", lambda: system.R(0, parameters), (p, p)),
    )
    return tuple(Trial(*each, arguments, kept) for each in wanted)


def check_result(trial: Trial, value: Any) -> None:
    """Raises ValueError, naming the function, unless it gave an array of real numbers of its shape, all written, and
    left what it was given as it was."""
    said = trial.signature
    for name, now in trial.given.items():
        if _leaves(now) != trial.kept[name]:
            instead = "a copy, or on memory in a field of p named scratch" if name == "p" else f"a copy, {name}.copy()"
            raise ValueError(f"{said} changes {name}, which is not its own; let it work on {instead}")
    if not isinstance(value, np.ndarray) or value.dtype.kind not in "fiu":
        kind = f"an array of {value.dtype}" if isinstance(value, np.ndarray) else f"a {type(value).__name__}"
        raise ValueError(f"{said} returns {kind}; needed is an array of numbers of shape {trial.shape}")
    check_unmasked(said, value)
    if value.shape != trial.shape:
        raise ValueError(f"{said} has shape {value.shape}; needed is {trial.shape}")
    if (value == UNWRITTEN).any():
        i = int((value == UNWRITTEN).argmax())
        raise ValueError(f"{said} does not write out[{i}]; it must write all of out, shape {trial.shape}")


def try_functions(system: System, x: FloatArray, u: FloatArray) -> None:
    """Call each function once, as `trials` do. What one raises comes through.

    Raises:
        ValueError: one gives no array of real numbers of its shape, does not write it, or changes what it is given.
    """
    for trial in trials(system, x, u):
        check_result(trial, trial.call())


def first_input(inputs: FloatArray) -> FloatArray:
    """The first of inputs (steps, m); zeros if there are no steps."""
    return inputs[0] if len(inputs) else np.zeros(inputs.shape[1])


def _filled(length: int, fill: Callable[[FloatArray], None]) -> FloatArray:
    out = np.full(length, UNWRITTEN)
    fill(out)
    return out


def _leaves(value: Any) -> list[Any]:
    """The arrays in it as bytes, and all else in it but fields named scratch."""
    if isinstance(value, np.ndarray):
        return [value.tobytes()]
    if isinstance(value, tuple | list):
        names = getattr(value, "_fields", range(len(value)))
        return [leaf for name, item in zip(names, value, strict=True) if name != "scratch" for leaf in _leaves(item)]
    return [value]
