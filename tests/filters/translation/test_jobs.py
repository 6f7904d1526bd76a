"""Every job of every method, robust step and part of a modular filter: C gives the bits that Python gives."""

from __future__ import annotations

from typing import Any

import pytest

from filters.covariance_forms import COVARIANCE_FORMS
from filters.jobs import Job
from filters.modular.jobs import modular_jobs
from filters.registry import ALL_METHODS
from filters.robust.jobs import robust_jobs
from filters.systems.example import example_system
from filters.systems.navigation import vehicle
from studies.robust.costs import SYSTEMS, robust_case
from tests.filters.modular.cases import CASES, Case
from tests.filters.translation.cases import check_same, needs_compiler

SYSTEM_OF = {"linear": example_system(4, 2, 3), "vehicle": vehicle()}
FEW = ("short", "vehicle")


def jobs_of_methods() -> list[Any]:
    return [
        pytest.param(job, id=f"{name}-{kind}-{form}-{of}", marks=() if (form, of) == FEW else pytest.mark.exhaust)
        for form in COVARIANCE_FORMS
        for of, system in SYSTEM_OF.items()
        for name, method in ALL_METHODS.items()
        for kind, job in method.jobs(system, form).items()
    ]


def jobs_of_robust_filters() -> list[Any]:
    return [
        pytest.param(job, id="-".join((system, *key)), marks=() if system == "attitude" else pytest.mark.exhaust)
        for system in SYSTEMS
        for key, job in robust_jobs(robust_case(system)).items()
    ]


def parts_of(name: str, case: Case) -> list[Any]:
    return [
        pytest.param(job, id=f"{name}-{part}", marks=() if name == "extended" else pytest.mark.exhaust)
        for part, job in modular_jobs(case.composed, case.x0, case.P0, case.u).items()
    ]


@needs_compiler
@pytest.mark.parametrize("job", jobs_of_methods())
def test_methods(job: Job) -> None:
    check_same(job.function, *job.arguments(1))


@needs_compiler
@pytest.mark.parametrize("job", jobs_of_robust_filters())
def test_robust_filters(job: Job) -> None:
    check_same(job.function, *job.arguments(1))


@needs_compiler
@pytest.mark.parametrize("job", [part for name, case in CASES.items() for part in parts_of(name, case)])
def test_parts_of_modular_filters(job: Job) -> None:
    """Sines of the C library may differ from NumPy's in the last bit."""
    check_same(job.function, *job.arguments(1), rtol=1e-15)
