"""A measurement that was lost, or a number of one: the filter is the one whose H and R have only the other rows."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from filters import multirate_gain
from filters.arrays import FloatArray
from filters.covariance_forms import COVARIANCE_FORMS
from filters.delayed import standard
from filters.factored import FACTORED_FORMS
from filters.robust.run import run as run_robust
from filters.robust.step import WAYS, step
from filters.systems.example import example_system
from filters.systems.navigation import simulate_drive
from tests.filters.cases import CASES, Case, each_case, relative_difference
from tests.filters.oracle import textbook_kalman_filter
from tests.filters.robust.cases import random_model, start
from tests.strategies import Problem, problem

RELATIVE = 1e-10
EVERY_CASE = [Case("standard", {}, "at-arrival"), *CASES]


def record(measurements: FloatArray, present: FloatArray) -> list[Any]:
    """None for what did not come."""
    return [
        [float(y) if came else None for y, came in zip(row, given, strict=True)] if given.any() else None
        for row, given in zip(measurements, present, strict=True)
    ]


def losses(count: int, p: int, seed: int) -> FloatArray:
    """About a third of the numbers, and of the rows."""
    random = np.random.default_rng(seed)
    return (random.random((count, p)) > 0.3) & (random.random((count, 1)) > 0.3)


@pytest.mark.parametrize("case", EVERY_CASE, ids=str)
@pytest.mark.parametrize("form", COVARIANCE_FORMS)
@settings(max_examples=4)
@given(data=st.data())
def test_every_method_is_the_filter_with_the_remaining_rows(case: Case, form: str, data: st.DataObject) -> None:
    whole = data.draw(case.problems())
    present = losses(*whole.measurements.shape, data.draw(st.integers(0, 99)))
    found = case.run(whole._replace(measurements=record(whole.measurements, present)), update=form)
    states, references = textbook_kalman_filter(whole, present)
    assert relative_difference(found.P_reference, references) <= RELATIVE
    for j, x in enumerate(found.x):
        if case.method == "standard" or j % whole.N >= whole.L:
            assert np.abs(x - states[j]).max() <= RELATIVE * np.abs(states).max()
    used = present[: len(found.innovations)]
    np.testing.assert_array_equal(np.isnan(found.innovations), ~used)
    assert not found.gains.transpose(0, 2, 1)[~used].any()


@pytest.mark.parametrize("form", FACTORED_FORMS)
@pytest.mark.parametrize("seed", range(4))
def test_a_gain_in_every_step(form: str, seed: int) -> None:
    data = problem(example_system(4, 2, 3, seed), 1, 0, 0, 20, seed)
    present = losses(21, 3, seed)
    lost = record(data.measurements, present)
    found = multirate_gain.run(data.system, 1, data.x0, data.P0, data.inputs, lost, form=form)
    states, references = textbook_kalman_filter(data, present)
    assert relative_difference(found.P_reference, references) <= RELATIVE
    assert relative_difference(found.x, states) <= RELATIVE


def test_gains_of_several_steps() -> None:
    """What came in none of the n steps is no part of the covariance; a single loss leaves its step uncorrected."""
    matrices = {name: value[:1] for name, value in example_system(3, 1, 2).parameters._asdict().items()}
    system = example_system(3, 1, 2)._replace(parameters=type(example_system(3, 1, 2).parameters)(**matrices))
    data = problem(system, 1, 0, 0, 17, seed=1)
    start = data.system, 3, data.x0, data.P0, data.inputs

    one = data.measurements.copy().tolist()
    one[4] = None
    whole, found = multirate_gain.run(*start, data.measurements), multirate_gain.run(*start, one)
    np.testing.assert_array_equal(found.P_reference, whole.P_reference)
    np.testing.assert_array_equal(found.x[:4], whole.x[:4])
    Phi, B = matrices["Phi"][0], matrices["B"][0]
    np.testing.assert_allclose(found.x[4], Phi @ found.x[3] + B @ data.inputs[3], rtol=1e-12, atol=1e-12)

    outage = [None if 6 <= j < 9 else row for j, row in enumerate(data.measurements)]
    found = multirate_gain.run(*start, outage)
    P, Q = found.P_reference[2], matrices["Q"][0]
    for _ in range(3):
        P = Phi @ P @ Phi.T + Q
    np.testing.assert_allclose(found.P_reference[3], P, rtol=1e-12, atol=1e-12)


@each_case
def test_nothing_lost_is_nothing_changed(case: Case) -> None:
    data = problem(example_system(4, 2, 2, seed=5), 5, 2, 2 if case.landing == "at-arrival" else 4, 17, seed=2)
    masked = np.ma.MaskedArray(data.measurements, mask=False)
    for same in (data.measurements.tolist(), list(data.measurements), masked):
        for found, expected in zip(case.run(data._replace(measurements=same)), case.run(data), strict=True):
            np.testing.assert_array_equal(found, expected)


def test_a_masked_array_says_what_was_lost() -> None:
    data = problem(example_system(4, 2, 2, seed=5), 5, 2, 2, 17, seed=2)
    present = losses(4, 2, 0)
    assert not present.all()
    unseen = np.where(present, data.measurements, np.nan)
    found = standard.run(*data._replace(measurements=np.ma.masked_invalid(unseen)))
    expected = standard.run(*data._replace(measurements=record(data.measurements, present)))
    for one, other in zip(found, expected, strict=True):
        np.testing.assert_array_equal(one, other)


def test_fixes_of_a_vehicle_in_a_tunnel() -> None:
    """A nonlinear model: without its fixes it is predicted, as if the record had ended before them."""
    drive = simulate_drive(steps=60, N=10, seed=0)
    fixes = drive.truth.measurements
    start = drive.system, 10, 4, 8, drive.x0, drive.P0, drive.inputs
    for case in CASES:
        tunnel = [*fixes[:3], None, None, None, None]
        found, expected = (
            case.run(Problem(*start[:3], case_L(case), *start[4:], record)) for record in (tunnel, fixes[:3])
        )
        np.testing.assert_array_equal(found.x, expected.x)
        np.testing.assert_array_equal(found.P_reference, expected.P_reference)


def case_L(case: Case) -> int:
    return 4 if case.landing == "at-arrival" else 8


@pytest.mark.exhaust
def test_compiled() -> None:
    data = problem(example_system(4, 2, 2, seed=5), 5, 2, 2, 17, seed=2)
    lost = data._replace(measurements=record(data.measurements, losses(4, 2, 0)))
    for found, expected in zip(standard.run(*lost, backend="compiled"), standard.run(*lost), strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-11, atol=1e-12)


@pytest.mark.parametrize("way", WAYS)
def test_the_robust_filter(way: str) -> None:
    model = random_model(7, 3, 2, 2, 1, 1)
    model = model._replace(F=model.F / np.abs(np.linalg.eigvals(model.F)).max())
    before = start(3)
    y = np.random.default_rng(0).normal(size=(3, 2))
    found = run_robust(model, before.x, before.P, [y[0], [None, y[1, 1]], None], mu=4.0, way=way)
    nothing = model._replace(
        H=np.zeros((0, 3)), D=np.zeros((0, 0)), R=np.zeros((0, 0)), E_H=np.zeros((0, 3)), E_D=np.zeros((0, 0)),
        M2=np.zeros((0, 0)),
    )  # fmt: skip
    second = model._replace(H=model.H[1:], D=model.D[1:], M2=model.M2[1:])
    for i, (of, measured) in enumerate([(model, y[0]), (second, y[1, 1:]), (nothing, [])]):
        before = step(of, before, measured, np.zeros(3), mu=4.0, way=way)
        np.testing.assert_allclose(found.x[i + 1], before.x, rtol=1e-12)
        np.testing.assert_allclose(found.P[i + 1], before.P, rtol=1e-12)


def test_a_masked_row_in_a_list_is_lost_too() -> None:
    data = problem(example_system(3, 2, 2), 5, 2, 4, 17, seed=0)
    y = data.measurements
    masks = [[True, False], [True, True], [False, False], [False, True]]
    gaps = [[None, y[0, 1]], None, y[2], [y[3, 0], None]]
    rows = [np.ma.array(row, mask=mask) for row, mask in zip(y, masks, strict=True)]
    scalars = [[np.ma.masked, y[0, 1]], np.ma.masked, y[2], [y[3, 0], np.ma.masked]]
    expected = standard.run(*data._replace(measurements=gaps))
    for masked in (rows, scalars, np.ma.array(y, mask=masks)):
        found = standard.run(*data._replace(measurements=masked))
        np.testing.assert_array_equal(found.x, expected.x)
        np.testing.assert_array_equal(found.innovations, expected.innovations)
