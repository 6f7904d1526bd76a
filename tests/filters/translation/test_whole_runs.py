"""Whole runs of every method: backend="c" leaves the bits that the reference leaves."""

from __future__ import annotations

import numpy as np
import pytest

from filters import multirate_gain
from filters.covariance_forms import COVARIANCE_FORMS
from filters.factored import FACTORED_FORMS, FactoredFormName
from filters.registry import DELAYED_METHODS
from filters.systems.navigation import simulate_drive
from tests.filters.cases import Case, each_case
from tests.filters.translation.cases import needs_compiler
from tests.strategies import unstable_system

DRIVE = simulate_drive(120, 10, seed=1)
each_form = pytest.mark.parametrize(
    "form", [pytest.param(form, marks=() if form == "short" else pytest.mark.exhaust) for form in COVARIANCE_FORMS]
)


@needs_compiler
@each_case
@each_form
def test_every_method(case: Case, form: str) -> None:
    M, L = (4, 4) if case.landing == "at-arrival" else (4, 8)
    data = DRIVE.x0, DRIVE.P0, DRIVE.inputs, DRIVE.truth.measurements
    run = DELAYED_METHODS[case.method].run
    found, expected = (
        run(DRIVE.system, 10, M, L, *data, **case.options, update=form, backend=backend)
        for backend in ("c", "reference")
    )
    for one, other in zip(found, expected, strict=True):
        np.testing.assert_array_equal(one, other)


@needs_compiler
@pytest.mark.parametrize("form", FACTORED_FORMS)
def test_multirate_gains(form: FactoredFormName) -> None:
    system, steps, random = unstable_system(0), 100, np.random.default_rng(1)
    n, m, p = system.states, system.inputs, system.measurements
    data = np.zeros(n), np.eye(n), random.normal(size=(steps, m)), random.normal(size=(steps + 1, p))
    found, expected = (
        multirate_gain.run(system, 5, *data, form=form, backend=backend) for backend in ("c", "reference")
    )
    for one, other in zip(found, expected, strict=True):
        np.testing.assert_array_equal(one, other)
