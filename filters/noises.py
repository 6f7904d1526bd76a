"""Whether the noises of a system are covariances in every step in which a filter takes them.

Half of one that is not symmetric would go unused, and an infinite one makes nan of some forms of an update and not of
others. They are looked at beside the run, so that no job costs more; they do not depend on the estimate.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.covariances import check_noise
from filters.kernels.definite import is_covariance
from filters.kernels.dense import are_equal, copy
from filters.system import System


def check_noises(system: System, Q: range, R: range, backend: BackendName = "reference") -> None:
    """Raises ValueError, naming function and step, unless Q and R are covariances in these steps."""
    _check("Q", system, Q, backend)
    _check("R", system, R, backend)


def first_unsound(
    noise: Callable[..., FloatArray],
    parameters: Any,
    start: int,
    end: int,
    every: int,
    sound: FloatArray,
    scratch: FloatArray,
) -> int:
    """The first step of range(start, end, every) in which the noise is no covariance, or end.

    sound, of the shape of the noise: one that is known to be a covariance, or nan. scratch has its shape too.

    What is the same as before is not looked at again.
    """
    for step in range(start, end, every):
        matrix = noise(step, parameters)
        if not are_equal(matrix, sound):
            if not is_covariance(matrix, scratch):
                return step
            copy(matrix, sound)
    return end


def _check(name: Literal["Q", "R"], system: System, steps: range, backend: BackendName) -> None:
    noise = getattr(system, name)
    size = system.states if name == "Q" else system.measurements
    bound = arguments_for(backend, noise), arguments_for(backend, system.parameters)
    step = steps.start
    while step < steps.stop:
        sound, scratch = np.full((size, size), np.nan), np.empty((size, size))
        step = function_for(backend, first_unsound)(*bound, step, steps.stop, steps.step, sound, scratch)
        if step < steps.stop:
            check_noise(name, noise(step, system.parameters), step)  # it may be less strict
        step += steps.step
