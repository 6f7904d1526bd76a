"""What a filter has in memory at some moment: realistic arguments for the jobs that are measured."""

from __future__ import annotations

import numpy as np

from filters.arrays import FloatArray, as_array
from filters.backends.choose import arguments_for, function_for
from filters.covariance_forms import COVARIANCE_FORMS
from filters.delayed import standard
from filters.delayed.high_rate import hr_propagate, hr_restart
from filters.delayed.update import update_covariance, update_error
from filters.records import (
    Estimate,
    Sample,
    new_correction,
    new_estimate,
    new_transition,
    new_workspace,
)
from filters.simulation import simulate_truth
from filters.system import System

WARM_UP = 12  # steps with a measurement each, after which the covariance is far from its start
DELAY = 4  # steps from k to m


def sample(system: System, seed: int, index: int, x0: FloatArray | None = None) -> Sample:
    """The sample of this number, independent of those with other numbers: k and all values differ.

    The standard filter is run on simulated data from x0 (zero if not given) with unit covariance and normal inputs.
    """
    k = WARM_UP + index
    m = k + DELAY
    random = np.random.default_rng([seed, index])
    start = np.zeros(system.states) if x0 is None else as_array("x0", x0)
    P0 = np.eye(system.states)
    inputs = random.normal(size=(m + 1, system.inputs))
    truth = simulate_truth(system, 1, start, P0, inputs, int(random.integers(2**31)))
    used = truth.measurements[:k]
    before = standard.run(system, 1, 0, 0, start, P0, inputs[:k], used, update="joseph", backend="numpy")
    reference = Estimate(before.x[k], before.P_reference[k])

    work = new_workspace(system)
    correction, P_posterior = new_correction(system), np.empty_like(P0)
    bound = arguments_for("numpy", system)
    form = arguments_for("numpy", COVARIANCE_FORMS["joseph"])
    function_for("numpy", update_covariance)(bound, form, k, reference, correction.K, P_posterior, work)
    function_for("numpy", update_error)(bound, k, truth.measurements[k], reference.x, correction)

    now, x = reference, np.empty_like(start)
    transition = function_for("numpy", hr_restart)(bound, k, reference.x, inputs[k], x)
    for j in range(k, m):
        after = new_estimate(system)
        if j > k:
            args = (bound, form, j, now.x, transition, inputs[j], x, new_transition(system), work)
            transition = function_for("numpy", hr_propagate)(*args)
        function_for("numpy", standard.propagate)(bound, form, j, now, inputs[j], after, work)
        now = after
    return Sample(k, m, reference, truth.measurements[k], correction, P_posterior, now, transition, inputs[m])
