"""Measurements at a rate that does not divide that of the loop: the figures are those of the steps in which they are
taken, as a recursion along these steps has them."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import ceil, floor

import numpy as np
import pytest

from filters.accuracy import (
    LinearModel,
    along,
    fused_as_fresh,
    lossless,
    lossless_each,
    px4_predictor,
    shipped_model,
    with_low_rate_noise,
)
from filters.accuracy.gains import halved_noise, summed_noise
from filters.accuracy.pattern import MOST_MEASUREMENTS, check_interval, taken
from filters.accuracy.periodic import steady
from filters.accuracy.regime import mean_of, regime, worst_of
from filters.arrays import FloatArray
from tests.filters.accuracy.cases import CV, SCALAR, random_model

CASES = [
    ("camera", Fraction(100, 30), 3),
    ("ins-gps", Fraction(400, 7), 44),
    ("ins-gps", Fraction(8, 5), 1),
    ("ins-gps", Fraction(12, 5), 2),
    ("camera", Fraction(20, 3), 15),
]
SLOW = 5e-6
"""So near is a recursion of hundreds of cycles to what the inertial models settle to."""
RATES = {Fraction(100, 30): 100.0, Fraction(400, 7): 400.0, Fraction(8, 5): 8.0, Fraction(12, 5): 12.0}


def steps_of(N: Fraction, count: int) -> list[int]:
    return [ceil(number * N) for number in range(count)]


def model_of(name: str, N: Fraction) -> tuple[LinearModel, list[int]]:
    shipped = shipped_model(name)
    return shipped.model(RATES.get(N, shipped.hr_hz)), shipped.outputs[shipped.output].states


def start(model: LinearModel, N: Fraction) -> FloatArray:
    """Near what it settles to, for that takes minutes of some."""
    return steady(model, np.eye(model.states), [ceil(N)], 0).before[0]


class Recursion:
    """A filter that believes Q over each interval, or its own; truth and belief, measurement by measurement, long after
    the start."""

    def __init__(self, model: LinearModel, N: Fraction, noise: object = None, cycles: int = 400) -> None:
        self.model, repetition = model, N.denominator
        steps = steps_of(N, (cycles // repetition + 2) * repetition + 1)
        believed = truth = start(model, N)
        found = []
        for first, then in pairwise(steps):
            K = believed @ model.H.T @ np.linalg.inv(model.H @ believed @ model.H.T + model.R)
            keep = np.eye(model.states) - K @ model.H
            moved = K @ (model.H @ truth @ model.H.T + model.R) @ K.T
            believed, truth = (keep @ P @ keep.T + K @ model.R @ K.T for P in (believed, truth))
            found.append((then - first, believed, truth, moved, K))
            over = then - first
            Phi, Q = np.linalg.matrix_power(model.Phi, over), self.noise(over)
            assumed = Q if noise is None else noise(model, over)  # type: ignore[operator]
            believed, truth = Phi @ believed @ Phi.T + assumed, Phi @ truth @ Phi.T + Q
        self.cycles = found[-repetition:]

    def noise(self, steps: int) -> FloatArray:
        total = np.zeros_like(self.model.Q)
        for _ in range(steps):
            total = self.model.Phi @ total @ self.model.Phi.T + self.model.Q
        return total

    def outputs(self, states: list[int], L: int, of: int = 2) -> FloatArray:
        """Variances in all steps of a repetition. of: 1 as believed, 2 as true."""
        variances = []
        for cycle in self.cycles:
            for age in range(L, L + cycle[0]):
                Phi = np.linalg.matrix_power(self.model.Phi, age)
                P = Phi @ cycle[of] @ Phi.T + self.noise(age)
                variances.append(sum(P[i, i] for i in states))
        return np.array(variances)

    def jump(self, states: list[int], L: int) -> float:
        Phi = np.linalg.matrix_power(self.model.Phi, L)
        return float(max(sum((Phi @ cycle[3] @ Phi.T)[i, i] for i in states) for cycle in self.cycles)) ** 0.5


@pytest.mark.parametrize(("name", "N", "L"), CASES)
def test_the_figures_are_those_of_a_recursion_along_the_steps(name: str, N: Fraction, L: int) -> None:
    model, states = model_of(name, N)
    found, known = lossless(model, states, N, L), Recursion(model, N)
    variances = known.outputs(states, L)
    assert found.verdict == "exact"
    assert found.worst**2 == pytest.approx(variances.max(), rel=SLOW)
    assert found.rms**2 == pytest.approx(variances.mean(), rel=SLOW)
    assert found.jump == pytest.approx(known.jump(states, L), rel=SLOW)
    assert found.no_delay**2 == pytest.approx(known.outputs(states, 0).max(), rel=SLOW)


@pytest.mark.parametrize(("name", "N", "L"), CASES)
def test_the_figures_are_those_along_the_landings_of_a_record(name: str, N: Fraction, L: int) -> None:
    """What the accuracy of a scenario is computed by."""
    model, states = model_of(name, N)
    cycle = N.numerator
    settling = ceil(200 * N / cycle) * cycle if name == "ins-gps" else 60 * cycle
    steps = settling + L + 2 * cycle
    landings = [("sensor", k, k + L) for k in steps_of(N, floor(steps / N) + 1)]
    run = along(model.Phi, model.Q, {"sensor": (model.H, model.R)}, states, start(model, N), steps, landings)
    last = slice(settling + L, settling + L + cycle)
    found = lossless(model, states, N, L)
    assert found.worst == pytest.approx(run.deviations[last].max(), rel=SLOW)
    assert found.rms**2 == pytest.approx(np.square(run.deviations[last]).mean(), rel=SLOW)
    ages = run.ages["sensor"][last]
    assert (found.oldest, found.mean_age) == (ages.max(), pytest.approx(ages.mean()))


@pytest.mark.parametrize("noise", ["sum", "euler"])
@pytest.mark.parametrize(("name", "N", "L"), CASES)
def test_with_approximate_noise_too(name: str, N: Fraction, L: int, noise: str) -> None:
    model, states = model_of(name, N)
    known = Recursion(model, N, summed_noise if noise == "sum" else halved_noise)
    found = with_low_rate_noise(model, states, N, L, noise)  # type: ignore[arg-type]
    variances, believed = known.outputs(states, L), known.outputs(states, L, 1)
    assert found.worst**2 == pytest.approx(variances.max(), rel=SLOW)
    assert found.rms**2 == pytest.approx(variances.mean(), rel=SLOW)
    assert found.jump == pytest.approx(known.jump(states, L), rel=SLOW)
    assert found.believed is not None
    assert found.believed**2 == pytest.approx(believed.max(), rel=SLOW)


def test_fused_as_fresh_the_mean_error_is_that_of_a_recursion() -> None:
    N, moved = Fraction(7, 2), np.array([2.0])
    mean, largest = np.zeros(2), 0.0
    for over, _, _, _, K in Recursion(CV, N, cycles=200).cycles * 200:
        mean = mean - K @ (CV.H @ mean + moved)
        worst = 0.0
        for _ in range(over):
            worst = max(worst, abs(mean[0]))
            mean = CV.Phi @ mean
        largest = max(worst, largest) if over == 4 else worst
    found = fused_as_fresh(CV, [0], N, 3, moved)
    assert found.bias == pytest.approx(largest, rel=SLOW)
    assert found.worst == lossless(CV, [0], N, 0).worst


def test_the_predictor_adds_what_each_innovation_leaves() -> None:
    """Of its output by simulation: o, what is kept of it, and the sum of err, driven by one innovation at a time."""
    N, D, g = Fraction(7, 2), 3, 0.2
    known, expected = Recursion(CV, N), np.zeros(7)
    for first, cycle in zip(steps_of(N, 2), known.cycles, strict=True):
        K = cycle[4]
        prior = np.linalg.inv(np.eye(2) - K @ CV.H) @ cycle[2]  # P^+ = (I - K H) P^-
        effect = (K @ np.linalg.cholesky(CV.H @ prior @ CV.H.T + CV.R))[:, 0]
        exact, total = effect, np.zeros(2)
        kept = [np.zeros(2)] * (D + 1)  # o_{j-D} .. o_j less what it would be without the innovation
        for j in range(4_000):
            if j:
                exact = CV.Phi @ exact
                kept = [*kept[1:], CV.Phi @ kept[-1]]
            err = exact - kept[0]
            total = total + err
            kept = [each + g * err + 0.1 * g**2 * total for each in kept]
            replay = np.linalg.matrix_power(CV.Phi, D) @ exact
            expected[(first + j) % 7] += (kept[-1] - replay)[0] ** 2
    variances = known.outputs([0], D) + expected
    found = px4_predictor(CV, [0], N, D, g)
    assert found.worst**2 == pytest.approx(variances.max(), rel=1e-6)
    assert found.rms**2 == pytest.approx(variances.mean(), rel=1e-6)


def test_a_whole_interval_is_the_same_however_it_is_written() -> None:
    assert lossless(CV, [0], Fraction(10), 4) == lossless(CV, [0], 10, 4)
    assert isinstance(check_interval("N", Fraction(10)), int)
    assert taken(Fraction(10, 3)).tolist() == [0, 4, 7, 10]


@pytest.mark.parametrize("seed", [0, 2, 3, 5])
def test_where_the_pattern_repeats_too_late_the_figures_are_a_bound(seed: int) -> None:
    """No less than those of patterns near it, whose intervals are as these."""
    model, N = random_model(seed, 1.02, 3, 1), Fraction(7, 2) + Fraction(1, 100_003)
    assert N.denominator > MOST_MEASUREMENTS
    bound = lossless(model, [0, 2], N, 2)
    assert bound.verdict == "bound"
    for near in (3, 4, Fraction(7, 2), Fraction(10, 3), Fraction(11, 3), Fraction(351, 100)):
        exact = lossless(model, [0, 2], near, 2)
        for figure in ("worst", "rms", "jump", "no_delay", "oldest"):
            assert getattr(exact, figure) <= getattr(bound, figure) * (1 + 1e-9)


def test_where_no_bound_is_found_it_is_said() -> None:
    with pytest.raises(ValueError, match=r"repeat their pattern after 200,006 of them.*no bound.*repeats sooner"):
        lossless(random_model(1, 1.02, 3, 1), [0, 2], Fraction(7, 2) + Fraction(1, 100_003), 2)


def test_a_bound_is_near_where_a_longer_interval_is_worse() -> None:
    bound, longer = lossless(SCALAR, [0], Fraction(100_001, 10_000), 4), lossless(SCALAR, [0], 11, 4)
    assert bound.worst == pytest.approx(longer.worst)


def test_a_method_without_a_bound_says_so() -> None:
    with pytest.raises(ValueError, match=r"repeat their pattern after 10,000 of them.*take an interval that"):
        with_low_rate_noise(SCALAR, [0], Fraction(100_001, 10_000), 4, "sum")
    with pytest.raises(ValueError, match=r"repeat their pattern after 51 of them.*at most 50"):
        px4_predictor(SCALAR, [0], Fraction(511, 51), 4, 0.1)


def test_all_landings_at_once_are_as_each_alone() -> None:
    N, landings = Fraction(7, 3), range(9)
    found = regime(CV, np.eye(2)[:1], N, 3 + 8)
    worst, mean = worst_of(found, landings), mean_of(found, landings)
    each = lossless_each(CV, [0], N, landings)
    np.testing.assert_allclose(np.sqrt(worst), [of.worst for of in each], rtol=1e-12)
    np.testing.assert_allclose(np.sqrt(mean), [of.rms for of in each], rtol=1e-12)


@pytest.mark.parametrize("N", [Fraction(1, 2), 0, 1.5])
def test_an_interval_below_a_step_is_refused(N: Fraction) -> None:
    with pytest.raises(ValueError, match="N="):
        lossless(CV, [0], N, 4)
