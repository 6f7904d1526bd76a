"""The carried gain with any number of measurements on their way, held to the joint Gaussian of all that is random."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from filters.arrays import FloatArray
from filters.covariance_forms import COVARIANCE_FORMS
from filters.delayed import carried_gain, clone, clone_split, larsen
from filters.systems.example import example_system
from filters.systems.linear import linear_system
from tests.filters.cases import relative_difference, standard_run
from tests.filters.test_lost import losses, record
from tests.strategies import Problem, problem, seeds, systems

RELATIVE = 1e-10


def conditioned(of: Problem, landed: int, j: int, present: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Mean and covariance of x_j given the first so many measurements: x_0 and all noises stacked into one vector."""
    system, n = of.system, of.system.states
    steps = len(of.inputs)
    means, roots = [of.x0], [np.hstack([np.eye(n), np.zeros((n, n * steps))])]
    variance = np.zeros((n * (steps + 1),) * 2)
    variance[:n, :n] = of.P0
    for i in range(steps):
        mean = np.empty(n)
        system.f(i, means[i], of.inputs[i], system.parameters, mean)
        root = system.F(i, means[i], of.inputs[i], system.parameters) @ roots[i]
        noise = slice(n * (i + 1), n * (i + 2))
        root[:, noise] += np.eye(n)
        variance[noise, noise] = system.Q(i, system.parameters)
        means.append(mean)
        roots.append(root)
    rows, R, z = [np.empty((0, n * (steps + 1)))], [], [np.empty(0)]
    for c in range(landed):
        k, came = c * of.N, present[c]
        H = system.H(k, means[k], system.parameters)[came]
        rows.append(H @ roots[k])
        R.append(system.R(k, system.parameters)[np.ix_(came, came)])
        z.append(of.measurements[c][came] - H @ means[k])
    seen = np.vstack(rows)
    S, crossed = seen @ variance @ seen.T, roots[j] @ variance @ seen.T
    at = 0
    for block in R:
        S[at : at + len(block), at : at + len(block)] += block
        at += len(block)
    mean = means[j] + crossed @ np.linalg.solve(S, np.concatenate(z))
    return mean, roots[j] @ variance @ roots[j].T - crossed @ np.linalg.solve(S, crossed.T)


def check_against_conditioning(of: Problem, present: FloatArray, form: str) -> None:
    given_data = of._replace(measurements=record(of.measurements, present))
    found = carried_gain.run(*given_data, update=form, backend="numpy")
    system, N, M, _, *data = given_data
    covariances = carried_gain.error_covariances(system, N, M, *data, update=form, backend="numpy")
    for j, (x, P) in enumerate(zip(found.x, covariances, strict=True)):
        landed = min((j - M) // N + 1, len(of.measurements)) if j >= M else 0
        mean, covariance = conditioned(of, landed, j, present)
        assert np.abs(x - mean).max() <= RELATIVE * (1 + np.abs(found.x).max())
        assert relative_difference(P, covariance) <= RELATIVE


@st.composite
def problems_in_flight(draw: st.DrawFn) -> Problem:
    """M up to several N, and past the end."""
    N, M = draw(st.integers(1, 4)), draw(st.integers(0, 14))
    return problem(draw(systems()), N, M, M, draw(st.integers(0, 16)), draw(seeds))


@pytest.mark.parametrize("form", COVARIANCE_FORMS)
@settings(max_examples=25)
@given(of=problems_in_flight())
def test_the_estimate_is_the_mean_given_what_has_landed(form: str, of: Problem) -> None:
    check_against_conditioning(of, np.full(of.measurements.shape, True), form)


@settings(max_examples=25)
@given(of=problems_in_flight(), seed=st.integers(0, 99))
def test_so_it_is_where_some_were_lost(of: Problem, seed: int) -> None:
    check_against_conditioning(of, losses(*of.measurements.shape, seed), "short")


@settings(max_examples=25)
@given(of=problems_in_flight())
def test_innovations_gains_and_covariances_are_those_without_delay(of: Problem) -> None:
    found, undelayed = carried_gain.run(*of, backend="numpy"), standard_run(of._replace(M=0, L=0))
    used = len(found.innovations)
    assert used == sum(1 for c in range(len(of.measurements)) if c * of.N + of.M <= len(of.inputs))
    known = len(found.P_reference)
    assert known == (len(undelayed.P_reference) if used == len(of.measurements) else used + 1)
    assert relative_difference(found.P_reference, undelayed.P_reference[:known]) <= RELATIVE
    assert relative_difference(found.gains, undelayed.gains[:used]) <= RELATIVE
    scale = 1 + np.abs(undelayed.x).max()
    assert np.abs(found.innovations - undelayed.innovations[:used]).max(initial=0.0) <= 10 * RELATIVE * scale


@settings(max_examples=25)
@given(data=st.data())
def test_larsen_clone_and_carried_gain_are_one_filter(data: st.DataObject) -> None:
    N = data.draw(st.integers(1, 20))
    M = data.draw(st.sampled_from([0, N]) | st.integers(0, N))
    of = problem(data.draw(systems()), N, M, M, data.draw(st.integers(0, 3 * N)), data.draw(seeds))
    expected = larsen.run(*of, backend="numpy")
    for found in (clone.run(*of, backend="numpy"), carried_gain.run(*of, backend="numpy")):
        for array, other in zip(found, expected, strict=True):
            assert np.abs(array - other).max(initial=0.0) <= RELATIVE * (1 + np.abs(other).max(initial=0.0))


def test_a_track_at_constant_velocity_with_two_on_their_way() -> None:
    """N=10, M=14: the worst standard deviation of the position in a cycle, printed in the project's specification."""
    Q, H = 0.01 * np.array([[1 / 3, 1 / 2], [1 / 2, 1]]), [[1, 0]]
    track = linear_system([[1, 1], [0, 1]], np.zeros((2, 0)), H, Q, [[1]])
    steps = 1000
    P = carried_gain.error_covariances(
        track, 10, 14, np.zeros(2), np.eye(2), np.zeros((steps, 0)), np.zeros((steps // 10 + 1, 1)), backend="numpy"
    )
    assert np.sqrt(P[-20:, 0, 0].max()) == pytest.approx(8.5345602732, abs=5e-11)


@pytest.mark.exhaust
def test_compiled_it_is_the_same() -> None:
    of = problem(example_system(4, 2, 2, seed=5), 2, 5, 5, 17, seed=2)
    for found, value in zip(carried_gain.run(*of, backend="compiled"), carried_gain.run(*of), strict=True):
        np.testing.assert_allclose(found, value, rtol=1e-11, atol=1e-12)


def test_where_measurements_cannot_arrive() -> None:
    of = problem(example_system(2, 1, 1), 2, 5, 5, 9, seed=2)
    with pytest.raises(ValueError, match=r"M=5, L=4, N=2 must satisfy 0 <= M <= L$"):
        carried_gain.run(*of._replace(L=4))
    with pytest.raises(ValueError, match="M=5, L=5, N=2 must satisfy 0 <= M <= L <= N"):
        clone_split.run(*of)
