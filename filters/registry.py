"""All methods and their jobs: whoever tests or measures them walks this and needs to know nothing else.

for method in ALL_METHODS.values():
    for job in method.jobs(example_system(), "textbook", seed=0).values():
        count(job.function, *job.arguments(0))
        function_for("numpy", job.function)(*arguments_for("numpy", job.arguments(0)))
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple, TypeAlias, TypeVar

import numpy as np

from filters import multirate_gain
from filters.arrays import FloatArray
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.covariance_forms.form import CovarianceForm
from filters.delayed import dual_rate, larsen, recalculate, standard
from filters.delayed.high_rate import hr_propagate, hr_restart, hr_update
from filters.delayed.low_rate import lr_correct, lr_gain, lr_propagate, lr_update
from filters.delayed.low_rate_noise import HalvedTransition, hr_propagate_euler, hr_propagate_sum, lr_propagate_euler
from filters.factored import FactoredFormName, factored_form
from filters.factored.form import FactoredForm
from filters.factored.workspace import new_factored_workspace
from filters.history import History
from filters.problem import check_system
from filters.records import (
    Transition,
    new_correction,
    new_estimate,
    new_transition,
    new_workspace,
)
from filters.samples import Sample, sample
from filters.system import System


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
    """A filter.

    run(system, N, M, L, x0, P0, inputs, measurements, *, update, backend): see `standard.run`; of the methods with a
        multirate gain, run(system, n, x0, P0, inputs, measurements, *, ...): see `multirate_gain.run`.
    jobs(system, update, seed, x0): its jobs by kind; x0 (n,) is a typical state, zero if not given.
        update: the name of a covariance form, of no use to methods that keep factors of the covariance.
    """

    name: str
    run: Callable[..., History]
    jobs: Callable[..., dict[str, Job]]


Form = TypeVar("Form", CovarianceForm, FactoredForm)
Described: TypeAlias = tuple[str, Callable[..., Any], Callable[[System, Form, Sample], tuple[Any, ...]]]


def _jobs(
    form_named: Callable[[CovarianceFormName], Form], *described: Described[Form]
) -> Callable[..., dict[str, Job]]:
    """`Method.jobs` of a method, given the kind, the function and the arguments of each job."""

    def jobs(
        system: System, update: CovarianceFormName = "textbook", seed: int = 0, x0: FloatArray | None = None
    ) -> dict[str, Job]:
        check_system("system", system)
        form = form_named(update)

        def arguments_of(make: Callable[[System, Form, Sample], tuple[Any, ...]]) -> Callable[[int], tuple[Any, ...]]:
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


def _state_update(system: System, _form: FactoredForm, at: Sample) -> tuple[Any, ...]:
    correction = new_correction(system)._replace(K=at.correction.K)
    return system, at.m + 1, at.now.x, at.u, at.y, correction, np.empty_like(at.now.x)


def _covariance_gain(system: System, form: FactoredForm, at: Sample) -> tuple[Any, ...]:
    """From k to m, with the system itself in place of the coarse one, for that has the same shapes."""
    P = at.P_posterior
    factors, predicted, posterior, K = (
        np.empty_like(P),
        np.empty_like(P),
        np.empty_like(P),
        np.empty_like(at.correction.K),
    )
    form.factor(P, factors)
    x_last = at.reference.x + at.correction.delta_x
    work = new_factored_workspace(system)
    return system, form, at.m, at.m - at.k, x_last, at.u, at.now.x, factors, predicted, K, posterior, work


def _multirate(name: str, form: FactoredFormName) -> Method:
    jobs = _jobs(
        partial(factored_form, form),
        ("state_update", multirate_gain.state_update, _state_update),
        ("covariance_gain", multirate_gain.covariance_gain, _covariance_gain),
    )
    return Method(name, partial(multirate_gain.run, form=form), jobs)


_PROPAGATE = ("propagate", standard.propagate, _propagate)
_UPDATE = ("update", standard.update, _update)

DELAYED_METHODS: dict[str, Method] = {
    method.name: method
    for method in (
        Method("standard", standard.run, _jobs(covariance_form, _PROPAGATE, _UPDATE)),
        Method(
            "recalculate",
            recalculate.run,
            _jobs(covariance_form, _PROPAGATE, _UPDATE, ("replay", standard.propagate, _propagate)),
        ),
        Method(
            "larsen",
            larsen.run,
            _jobs(
                covariance_form,
                _PROPAGATE,
                ("propagate_accumulate", larsen.propagate_accumulate, _propagate_accumulate),
                ("update", larsen.extrapolated_update, _extrapolated_update),
            ),
        ),
        Method(
            "dual-rate",
            dual_rate.run,
            _jobs(
                covariance_form,
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
"""One measurement every N steps, which comes M steps late; and the standard filter, for which it is never late."""

MULTIRATE_METHODS: dict[str, Method] = {
    method.name: method
    for method in (
        _multirate("multirate", "conventional"),
        _multirate("multirate-square-root", "square-root"),
        _multirate("multirate-ud", "u-d"),
    )
}
"""A measurement in every step, covariance and gain in every n-th."""

ALL_METHODS: dict[str, Method] = {**DELAYED_METHODS, **MULTIRATE_METHODS}
