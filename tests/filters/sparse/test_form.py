"""Filters without the zeros of their models: the same runs, for less; and what happens where a zero is none."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from filters.backends.counted import count
from filters.covariance_forms import COVARIANCE_FORMS, CovarianceFormName
from filters.history import History
from filters.registry import DELAYED_METHODS
from filters.sparse.structure import ANY, Structure
from filters.systems.gps import STRUCTURE as GPS
from filters.systems.gps import gps, simulate_flight
from filters.systems.navigation import STRUCTURE as VEHICLE
from filters.systems.navigation import simulate_drive
from tests.filters.translation.cases import needs_compiler

DRIVE = simulate_drive(45, 10, seed=0)
LOST = [*DRIVE.truth.measurements[:2], None, [None, DRIVE.truth.measurements[3, 1]], *DRIVE.truth.measurements[4:]]
forms = pytest.mark.parametrize("form", COVARIANCE_FORMS)
methods = pytest.mark.parametrize("method", DELAYED_METHODS)


def drive(method: str, structure: Structure | None, measurements: Any = None, **options: Any) -> History:
    system = DRIVE.system._replace(structure=structure)
    given = DRIVE.truth.measurements if measurements is None else measurements
    return DELAYED_METHODS[method].run(system, 10, 4, 8, DRIVE.x0, DRIVE.P0, DRIVE.inputs, given, **options)


@forms
@methods
@pytest.mark.parametrize("measurements", [None, LOST], ids=["all", "lost"])
def test_a_run_has_the_same_bits(method: str, form: CovarianceFormName, measurements: Any) -> None:
    dense, sparse = (drive(method, structure, measurements, update=form) for structure in (None, VEHICLE))
    for found, expected in zip(sparse, dense, strict=True):
        np.testing.assert_array_equal(found, expected)


@needs_compiler
@pytest.mark.parametrize(
    "method",
    [pytest.param(name, marks=() if name == "dual-rate" else pytest.mark.exhaust) for name in DELAYED_METHODS],
)
def test_in_c_too(method: str) -> None:
    dense, sparse = (drive(method, structure, update="short", backend="c") for structure in (None, VEHICLE))
    for found, expected in zip(sparse, dense, strict=True):
        np.testing.assert_array_equal(found, expected)


def test_a_system_that_changes_with_time_has_a_structure_too() -> None:
    flight = simulate_flight(gps(steps=30), 30, seed=0)
    given = flight.x0, flight.P0, flight.inputs, flight.truth.measurements[::10]
    for method in ("standard", "dual-rate"):
        dense, sparse = (
            DELAYED_METHODS[method].run(flight.system._replace(structure=structure), 10, 4, 8, *given)
            for structure in (None, GPS)
        )
        np.testing.assert_array_equal(sparse.x, dense.x)
        np.testing.assert_array_equal(sparse.P_reference, dense.P_reference)


@methods
def test_each_job_gives_the_same_bits(method: str) -> None:
    jobs = (
        DELAYED_METHODS[method].jobs(DRIVE.system._replace(structure=structure), "short")
        for structure in (None, VEHICLE)
    )
    for dense, sparse in zip(*(each.values() for each in jobs), strict=True):
        expected, found = dense.arguments(0), sparse.arguments(0)
        dense.function(*expected)
        sparse.function(*found)
        for a, b in zip(expected, found, strict=True):
            if isinstance(a, np.ndarray):
                np.testing.assert_array_equal(b, a, err_msg=dense.kind)


@forms
@methods
def test_no_job_does_more(method: str, form: CovarianceFormName) -> None:
    x0 = np.array([0.0, 0.0, 0.5, 15.0, 0.0, 0.0])
    dense, sparse = (
        DELAYED_METHODS[method].jobs(DRIVE.system._replace(structure=structure), form, 0, x0)
        for structure in (None, VEHICLE)
    )
    for kind in dense:
        less, more = (count(job.function, *job.arguments(0)).total for job in (sparse[kind], dense[kind]))
        assert less <= more, kind


def test_most_of_a_propagation_is_zeros() -> None:
    """6 x 6: two products of 396 operations and a sum of 36, of which these are left."""
    jobs = DELAYED_METHODS["standard"].jobs(DRIVE.system._replace(structure=VEHICLE), "textbook")
    dense = DELAYED_METHODS["standard"].jobs(DRIVE.system, "textbook")
    found, before = (count(each["propagate"].function, *each["propagate"].arguments(0)).total for each in (jobs, dense))
    assert (found, before) == (128, 850)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (
            VEHICLE._replace(F=("100*00", *VEHICLE.F[1:])),
            r"step 0: F\(j, x, u, p\) .* \[0, 2\].*says 0; write \*",
        ),
        (
            VEHICLE._replace(H=("110000", "010000")),
            r"step 0: H\(k, x, p\) has 0.0 at \[0, 1\].*says 1",
        ),
        (VEHICLE._replace(Q=("000000",) * 6), "step 0: Q\\(j, p\\) has .* at \\[2, 2\\]"),
        (VEHICLE._replace(R=("00", "0*")), "step 0: R\\(k, p\\) has 1.0 at \\[0, 0\\]"),
        (VEHICLE._replace(R=("0", "0")), "R of the structure of the system, row 0, is '0'"),
    ],
)
def test_a_zero_that_is_none_ends_the_run(wrong: Structure, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        drive("dual-rate", wrong)


@needs_compiler
def test_a_zero_that_is_none_ends_the_run_in_c_too() -> None:
    with pytest.raises(ValueError, match="a matrix is not of the structure"):
        drive("dual-rate", VEHICLE._replace(Q=("000000",) * 6), backend="c")


def test_nothing_known_is_the_dense_filter() -> None:
    nothing = Structure((ANY * 6,) * 6, (ANY * 6,) * 2, (ANY * 6,) * 6, (ANY * 2,) * 2)
    np.testing.assert_array_equal(drive("larsen", nothing).x, drive("larsen", None).x)
