"""All methods and their jobs: whoever tests or measures them walks this and needs to know nothing else.

for method in ALL_METHODS.values():
    for job in method.jobs(example_system(), "textbook", seed=0).values():
        count(job.function, *job.arguments(0))
        function_for("numpy", job.function)(*arguments_for("numpy", job.arguments(0)))
"""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from functools import cache, partial
from typing import Any, NamedTuple

from filters import multirate_gain
from filters.arrays import FloatArray
from filters.covariance_forms import CovarianceFormName, covariance_form
from filters.delayed import (
    augmentation,
    carried_gain,
    clone,
    clone_split,
    delayed_horizon,
    dual_rate,
    fuse_as_fresh,
    larsen,
    px4_predictor,
    recalculate,
    standard,
)
from filters.factored import FactoredFormName, factored_form
from filters.factored.form import FactoredForm
from filters.history import History
from filters.jobs import Form, Job, JobKind
from filters.problem import check_system, checked_structure
from filters.records import Sample
from filters.samples import sample
from filters.sparse.structure import Structure
from filters.system import System


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


def _jobs(form_named: Callable[..., Form], *kinds: JobKind[Form]) -> Callable[..., dict[str, Job]]:
    """`Method.jobs` of a method that has such kinds, from a form by its name and the structure of the system."""

    def jobs(
        system: System, update: CovarianceFormName = "textbook", seed: int = 0, x0: FloatArray | None = None
    ) -> dict[str, Job]:
        check_system("system", system)
        form = form_named(update, checked_structure(system))
        system = system._replace(structure=None)

        @cache
        def drawn(index: int) -> Sample:
            return sample(system, seed, index, x0)

        def arguments_of(make: Callable[[System, Form, Sample], tuple[Any, ...]]) -> Callable[[int], tuple[Any, ...]]:
            return lambda index: make(system, form, deepcopy(drawn(index)))

        return {kind: Job(kind, function, arguments_of(make)) for kind, function, make in kinds}

    return jobs


MULTIRATE_FORMS: dict[str, FactoredFormName] = {
    "multirate": "conventional",
    "multirate-square-root": "square-root",
    "multirate-ud": "u-d",
}


def _multirate(form: FactoredFormName) -> tuple[Callable[..., History], Callable[..., dict[str, Job]]]:
    def kept(update: CovarianceFormName, _structure: Structure | None) -> FactoredForm:
        return factored_form(form, update)

    return partial(multirate_gain.run, form=form), _jobs(kept, *multirate_gain.JOBS)


DELAYED_METHODS = {
    name: Method(name, run, jobs)
    for name, run, jobs in (
        ("standard", standard.run, _jobs(covariance_form, *standard.JOBS)),
        ("recalculate", recalculate.run, _jobs(covariance_form, *recalculate.JOBS)),
        ("larsen", larsen.run, _jobs(covariance_form, *larsen.JOBS)),
        ("dual-rate", dual_rate.run, _jobs(covariance_form, *dual_rate.JOBS)),
        ("clone", clone.run, _jobs(covariance_form, *clone.JOBS)),
        ("clone-split", clone_split.run, _jobs(clone_split.split_form, *clone_split.JOBS)),
        ("carried-gain", carried_gain.run, _jobs(covariance_form, *carried_gain.JOBS)),
        ("delayed-horizon", delayed_horizon.run, _jobs(covariance_form, *delayed_horizon.JOBS)),
        ("px4-predictor", px4_predictor.run, _jobs(covariance_form, *px4_predictor.JOBS)),
        ("augmentation", augmentation.run, _jobs(covariance_form, *augmentation.JOBS)),
        ("fuse-as-fresh", fuse_as_fresh.run, _jobs(covariance_form, *fuse_as_fresh.JOBS)),
    )
}
"""One measurement every N steps, which comes M steps late; and the standard filter, for which it is never late."""

SPARSE_METHODS = tuple(name for name in DELAYED_METHODS if name != "augmentation")
"""Those whose jobs leave out what is zero or one in the structure of a system; augmentation does so in its propagation
only."""

MULTIRATE_METHODS = {name: Method(name, *_multirate(form)) for name, form in MULTIRATE_FORMS.items()}
"""A measurement in every step, covariance and gain in every n-th."""

ALL_METHODS = {**DELAYED_METHODS, **MULTIRATE_METHODS}
