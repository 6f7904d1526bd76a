"""Running the kernel of a whole filter, which holds the user's functions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from filters.arrays import FloatArray
from filters.backends.choose import BackendName, arguments_for, function_for
from filters.modular.arrivals import Arrivals
from filters.modular.breakdown import PREDICTOR, SOUND, breakdown, new_failure
from filters.modular.chain import chain
from filters.modular.composition import ModularFilter
from filters.modular.correctors import Corrector
from filters.modular.history import Estimates, new_estimates
from filters.modular.kept import kept_by, restore
from filters.modular.prediction import prediction
from filters.modular.space import NOTHING
from filters.modular.workspace import new_workspace
from filters.running import running


def run_kernel(
    kernel: Callable[..., tuple[int, int]],
    job_of: Callable[[Corrector], Callable[..., None]],
    composed: ModularFilter,
    inputs: FloatArray,
    arrived: Arrivals,
    own: tuple[Any, ...],
    backend: BackendName,
) -> Estimates:
    """What the kernel of a way to use late measurements leaves.

    kernel(predict, use, is_sound, motion, parts, places, space, dt, inputs, arrived, history, failure, work, *own)
    returns which part, and in which step, left an estimate that is none, or SOUND. job_of: its job of one correction,
    see `chain.chain`.

    Raises:
        ValueError: as `running`, or an estimate breaks down; the part is named.
    """
    chained, kept = chain(job_of, composed), kept_by(composed)
    estimates, failure = new_estimates(composed.of, len(inputs)), new_failure(composed.of)
    with running("filter"):
        culprit, step = function_for(backend, kernel)(
            arguments_for(backend, prediction(composed)),
            arguments_for(backend, chained.use),
            arguments_for(backend, kept.is_sound),
            arguments_for(backend, composed.predictor.motion),
            arguments_for(backend, chained.parts),
            chained.places,
            composed.of,
            composed.dt,
            inputs,
            arrived,
            estimates,
            failure,
            new_workspace(composed.of, NOTHING),
            *own,
        )
    if culprit != SOUND:
        raise breakdown(composed, culprit, step, failure, inputs[step - 1] if culprit == PREDICTOR else np.empty(0))
    function_for(backend, restore)(
        arguments_for(backend, kept.covariance), estimates.P, np.empty(estimates.P.shape[1:])
    )
    return estimates
