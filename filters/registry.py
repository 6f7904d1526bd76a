"""All methods and their jobs: whoever tests or measures them walks this and needs to know nothing else.

for method in ALL_METHODS.values():
    for job in method.jobs(example_system(), "textbook", seed=0).values():
        count(job.function, *job.arguments(0))
        function_for("numpy", job.function)(*arguments_for("numpy", job.arguments(0)))
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from filters import dual_rate, larsen, recalculate, standard
from filters.arrays import FloatArray
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.covariance_forms.form import CovarianceForm
from filters.high_rate import hr_propagate, hr_restart, hr_update
from filters.history import History
from filters.low_rate import lr_correct, lr_gain, lr_propagate, lr_update
from filters.low_rate_noise import (
    HalvedTransition,
    hr_propagate_euler,
    hr_propagate_sum,
    lr_propagate_euler,
)
from filters.records import (
    Transition,
    new_correction,
    new_estimate,
    new_transition,
    new_workspace,
)
from filters.samples import Sample, sample
from filters.systems.system import System


class Job(NamedTuple):
    """A piece of work that a method releases as a whole, so that its cost can be scheduled.

    function: plain Python loops; it reads its inputs, which it leaves as they are, and fills its outputs.
    arguments(index): a new set of arguments, with realistic values and its own memory; another index, other values.
        All sets of a job have the same types and shapes.
    """

    kind: str
    function: Callable[..., Any]
    arguments: Callable[[int], tuple[Any, ...]]


class Method(NamedTuple):
    """A filter for delayed measurements.

    run(system, N, M, L, x0, P0, inputs, measurements, *, update, backend): see `standard.run`.
    jobs(system, update, seed, x0): its jobs by kind; x0 (n,) is a typical state, zero if not given.
        update: the name of a covariance form.
    """

    name: str
    run: Callable[..., History]
    jobs: Callable[..., dict[str, Job]]


Arguments = Callable[[System, CovarianceForm, Sample], tuple[Any, ...]]


def _jobs(*described: tuple[str, Callable[..., Any], Arguments]) -> Callable[..., dict[str, Job]]:
    """`Method.jobs` of a method, given the kind, the function and the arguments of each job."""

    def jobs(
        system: System, update: CovarianceFormName = "textbook", seed: int = 0, x0: FloatArray | None = None
    ) -> dict[str, Job]:
        form = covariance_form(update)

        def arguments_of(make: Arguments) -> Callable[[int], tuple[Any, ...]]:
            return lambda index: make(system, form, sample(system, seed, index, x0))

        return {kind: Job(kind, function, arguments_of(make)) for kind, function, make in described}

    return jobs


def _propagate(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    return system, form, at.m, at.now, at.u, new_estimate(system), new_workspace(system)


def _update(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    after, correction = new_estimate(system), new_correction(system)
    return system, form, at.k, at.y, at.reference, after, correction, new_workspace(system)


def _propagate_accumulate(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    after, Phi_next = new_estimate(system), np.empty_like(at.transition.Phi)
    return system, form, at.m, at.now, at.transition.Phi, at.u, after, Phi_next, new_workspace(system)


def _extrapolated_update(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    after, correction, work = new_estimate(system), new_correction(system), new_workspace(system)
    return system, form, at.k, at.y, at.reference, at.transition.Phi, at.now, after, correction, work


def _hr_restart(system: System, _form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    return system, at.m, at.now.x, at.u, np.empty_like(at.now.x)


def _hr_propagate(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    x_next, following = np.empty_like(at.now.x), new_transition(system)
    return system, form, at.m, at.now.x, at.transition, at.u, x_next, following, new_workspace(system)


def _hr_propagate_euler(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    x_next, following = np.empty_like(at.now.x), _halved(new_transition(system), at)
    return system, form, at.m, at.now.x, _halved(at.transition, at), at.u, x_next, following, new_workspace(system)


def _hr_update(system: System, _form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    return at.now.x, at.transition.Phi, at.correction.delta_x, np.empty_like(at.now.x), new_workspace(system)


def _lr_propagate(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    return form, at.P_posterior, at.transition, np.empty_like(at.P_posterior), new_workspace(system)


def _lr_propagate_euler(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    P_next = np.empty_like(at.P_posterior)
    return form, at.P_posterior, _halved(at.transition, at), P_next, new_workspace(system)


def _lr_update(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    P_posterior, correction = np.empty_like(at.P_posterior), new_correction(system)
    return system, form, at.k, at.y, at.reference, P_posterior, correction, new_workspace(system)


def _lr_gain(system: System, form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    P_posterior, correction = np.empty_like(at.P_posterior), new_correction(system)
    return system, form, at.k, at.reference, P_posterior, correction, new_workspace(system)


def _lr_correct(system: System, _form: CovarianceForm, at: Sample) -> tuple[Any, ...]:
    correction = new_correction(system)
    correction.K[:] = at.correction.K
    return system, at.k, at.y, at.reference, correction


def _halved(transition: Transition, at: Sample) -> HalvedTransition:
    return HalvedTransition(transition.Phi, transition.Q.copy(), transition.Q.copy(), at.m)


_PROPAGATE = ("propagate", standard.propagate, _propagate)
_UPDATE = ("update", standard.update, _update)

ALL_METHODS: dict[str, Method] = {
    method.name: method
    for method in (
        Method("standard", standard.run, _jobs(_PROPAGATE, _UPDATE)),
        Method("recalculate", recalculate.run, _jobs(_PROPAGATE, _UPDATE, ("replay", standard.propagate, _propagate))),
        Method(
            "larsen",
            larsen.run,
            _jobs(
                _PROPAGATE,
                ("propagate_accumulate", larsen.propagate_accumulate, _propagate_accumulate),
                ("update", larsen.extrapolated_update, _extrapolated_update),
            ),
        ),
        Method(
            "dual-rate",
            dual_rate.run,
            _jobs(
                ("hr_restart", hr_restart, _hr_restart),
                ("hr_propagate", hr_propagate, _hr_propagate),
                ("hr_propagate_sum", hr_propagate_sum, _hr_propagate),
                ("hr_propagate_euler", hr_propagate_euler, _hr_propagate_euler),
                ("hr_update", hr_update, _hr_update),
                ("lr_propagate", lr_propagate, _lr_propagate),
                ("lr_propagate_euler", lr_propagate_euler, _lr_propagate_euler),
                ("lr_update", lr_update, _lr_update),
                ("lr_gain", lr_gain, _lr_gain),
                ("lr_correct", lr_correct, _lr_correct),
            ),
        ),
    )
}
