"""The user's own system, named on the command line as package.module:function."""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray, as_array
from filters.covariances import check_covariance, check_measurement_noise
from filters.system import System
from filters.systems.scratch import restored
from filters.systems.trial import check_result, trials
from filters.systems.turns import check_turns
from sched_sim.bounds import MOST_STATES, short
from sched_sim.errors import InputError
from studies.measurement.user_function import Returned, explained, returned_by

HOW = (
    "name a function without arguments that returns a filters.system.System, as in --system mymodule:my_system "
    "for a file mymodule.py in this folder"
)


def load_system(name: str) -> tuple[System, FloatArray]:
    """The system that the function `package.module:function` returns, and a typical state of it (n,).

    The function may return the system alone; then the state is zero. The current folder is searched first. All model
    functions are tried at that state.
    Raises InputError that says what is wrong with the name, the module, what the function returned, or which model
    function fails or gives what.
    """
    return checked_system(returned_by(name, "--system", HOW), f"--system {name!r}", HOW)


def checked_system(returned_value: Returned, said: str, how: str) -> tuple[System, FloatArray]:
    """`load_system` of what a function returned. said: the option and its value, for messages; how: what to give."""
    function_name, returned = returned_value
    system, x0 = returned if type(returned) is tuple and len(returned) == 2 else (returned, None)
    if not isinstance(system, System):
        raise InputError(f"{said}: {function_name}() returned a {type(system).__name__}; {how}")
    sizes = {"states": system.states, "inputs": system.inputs, "measurements": system.measurements}
    for what, size in sizes.items():
        least = 0 if what == "inputs" else 1
        if isinstance(size, bool) or not isinstance(size, int | np.integer) or not least <= size <= MOST_STATES:
            raise InputError(f"{said}: {what}={short(repr(size))} must be a whole number from {least} to {MOST_STATES}")
    with explained(said):
        state = np.zeros(system.states) if x0 is None else as_array("the typical state", x0)
    with restored(system):
        _try_model(said, system, state)
    return system, state


def _try_model(said: str, system: System, x: FloatArray) -> None:
    """Call each model function once and look at what it gives; R must be one that every filter can use."""
    if x.shape != (system.states,):
        raise InputError(f"{said}: the typical state has shape {x.shape}; needed is {(system.states,)}")
    if not np.isfinite(x).all():
        raise InputError(f"{said}: the typical state is not finite; return (system, x0) with numbers that are")
    values = {}
    for trial in trials(system, x, np.zeros(system.inputs)):
        failed = f"{said}: {trial.signature} failed"
        with explained(failed, " (p is the system's `parameters`)"), np.errstate(all="ignore"):
            value = trial.call()
        try:
            check_result(trial, value)
        except ValueError as error:
            raise InputError(f"{said}: {error}") from error
        _check_finite(said, trial.signature, value)
        values[trial.signature] = value
    with explained(said):
        check_turns(system, x, np.zeros(system.inputs))
    try:
        check_covariance("Q(j, p)", values["Q(j, p)"])
        check_measurement_noise(values["R(k, p)"], None, "R(k, p)")
    except ValueError as error:
        raise InputError(f"{said}: {error}") from error


def _check_finite(said: str, what: str, value: FloatArray) -> None:
    if not np.isfinite(value).all():
        raise InputError(
            f"{said}: {what} is not finite at the typical state; return (system, x0) with a state where it "
            f"is (without x0, it is tried at zero)"
        )
