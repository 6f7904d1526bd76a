"""The user's own composed filter, named on the command line as package.module:function."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from filters.arrays import FloatArray, as_array
from filters.jobs import Job
from filters.modular.composition import ModularFilter
from filters.modular.jobs import modular_jobs
from filters.modular.typical import origin, typical_moment
from sched_sim.errors import InputError
from studies.measurement.user_function import explained, returned_by

HOW = (
    "name a function without arguments that returns a filters.modular.ModularFilter, or with it a typical state, "
    "covariance and input: (filter, x0), (filter, x0, P0), (filter, x0, P0, u); as in "
)
EXAMPLE = "--filter mymodule:my_filter for a file mymodule.py in this folder"


class UserFilter(NamedTuple):
    """A filter and its jobs, by part; made by `studies.measurement.user_filter.load_filter`."""

    composed: ModularFilter
    jobs: Mapping[str, Job]


class Composed(NamedTuple):
    """A filter, and of x0, P0 and u, a typical start, as many as its function returned."""

    composed: ModularFilter
    typical: list[Any]


def composed_by(name: str, option: str, example: str) -> Composed:
    """What the function `package.module:function` returns; the current folder is searched first.

    option: how the user named it; example: of how to.
    Raises InputError that says what is wrong with the name, the module or what the function returned.
    """
    returned = returned_by(name, option, f"{HOW}{example}")
    composed, *typical = returned.value if isinstance(returned.value, tuple) else (returned.value,)
    if not isinstance(composed, ModularFilter) or len(typical) > 3:
        said = f"{option} {name!r}: {returned.function}() returned {_shown(returned.value)}"
        raise InputError(f"{said}; {HOW}{example}")
    return Composed(composed, typical)


def load_start(name: str) -> tuple[ModularFilter, FloatArray, FloatArray, FloatArray]:
    """The filter that the function returns, and x0, P0 and u of its typical start, or else the usual ones.

    Raises InputError as `load_filter`.
    """
    composed, typical = composed_by(name, "--filter", EXAMPLE)
    with explained(f"--filter {name!r}", f"; it was tried with {_tried(typical)}"):
        x0, P0, u = (*typical, None, None, None)[:3]
        moment = typical_moment(composed, x0, P0, u)
        x = origin(composed.of) if x0 is None else as_array("x0", x0)
        return composed, x, np.eye(composed.of.errors) if P0 is None else as_array("P0", P0), moment.u


def load_filter(name: str, seed: int = 0) -> UserFilter:
    """The filter that the function `package.module:function` returns; the current folder is searched first.

    Its functions are tried at the typical state that is returned with it, or else at zero.
    Raises InputError that says what is wrong with the name, the module or what the function returned, or which part of
    the filter does what.
    """
    composed, typical = composed_by(name, "--filter", EXAMPLE)
    with explained(f"--filter {name!r}", f"; it was tried with {_tried(typical)}"):
        x0, P0, u = (*typical, None, None, None)[:3]
        return UserFilter(composed, modular_jobs(composed, x0, P0, u, seed))


def _shown(value: Any) -> str:
    if not isinstance(value, tuple):
        return f"a {type(value).__name__}"
    return f"({', '.join(type(item).__name__ for item in value)})"


def _tried(typical: list[Any]) -> str:
    values = ("your x0", "your P0", "your u")[: len(typical)]
    usual = ("x0 zero", "P0 the unit matrix", "no input")[len(typical) :]
    return ", ".join([*values, *usual]) + (": return (filter, x0, P0, u) with others" if usual else "")
