"""What can run in real time, and what is refused; speeds through two steps."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import pytest

from sched_sim.errors import InputError
from studies.live.design import check_design
from studies.live.measure import measured
from studies.live.probe import Resolution, check_resolved, check_shortest, resolved
from studies.live.stairs import nearest_step, steps, through_two_steps, two_steps, word_of
from studies.live.taken import NEAR, may_be_taken
from tests.studies.live.recorded import design, judged, perfect, recorded


def test_the_predicted_l() -> None:
    assert [check_design(design(speed)) for speed in ("0.73", "0.77", "0.85", "0.91", "1.2")] == [10, 8, 7, 6, 5]


def test_cpu_times_are_costs_over_speed() -> None:
    assert design("0.5").job_ns == {
        "hr_restart": 800_000,
        "hr_propagate": 12_600_000,
        "hr_update": 600_000,
        "lr_propagate": 8_200_000,
        "lr_update": 11_200_000,
    }
    assert design("0.85").load == Fraction(671, 850)


@pytest.mark.parametrize(
    ("speed", "said"),
    [
        ("0.7", "speed 0.7: both tasks take 95.86 % of the core, .* no more than 95 %: give at least 0.7234$"),
        ("0.71", "speed 0.71: corrections are predicted to land after the next measurement.*: give at least 0.7234$"),
    ],
)
def test_speeds_that_are_too_low(speed: str, said: str) -> None:
    with pytest.raises(InputError, match=said):
        check_design(design(speed))


def test_a_run_of_hours() -> None:
    with pytest.raises(InputError, match=r"cycles 100000 of N 10 take 10000 s: give fewer"):
        check_design(design(cycles=100_000))


def test_a_period_is_refused_by_what_was_measured() -> None:
    found = Resolution(20_000.0, {"hr_update": 1_000.0, "lr_update": 4_000.0})
    check_resolved(found, design(), 7)
    with pytest.raises(InputError, match=r"period_ms 1 is too short.*wake-up here takes 20 us.*give at least 3.4"):
        check_resolved(found, design(period_ns=1_000_000), 7)
    slow = Resolution(1.0, {"hr_update": 100_000.0})
    with pytest.raises(InputError, match=r"hr_update, done once, 100 us of its 353 us: give at least 29"):
        check_resolved(slow, design(), 7)
    with pytest.raises(InputError, match=r"period_ms 0.0005 is too short.*every .* ns: give at least 0.001"):
        check_shortest(design(period_ns=500))


def test_the_resolution_is_what_is_possible() -> None:
    found = resolved(recorded("ordinary"), design())
    assert 10_000 < found.wake <= min(judged("ordinary").wake)
    assert found.once["hr_update"] == pytest.approx(353_000, rel=0.01)


def test_speeds_are_on_both_sides_of_two_steps() -> None:
    found = through_two_steps(design())
    assert [of.predicted for of in found] == [8, 8, 8, 7, 7, 7, 7, 7, 7, 6, 6, 6]
    assert two_steps(design()) == [Fraction(49, 60), Fraction(91, 100)]
    assert two_steps(design("3")) == [Fraction(91, 100), Fraction(119, 100)]
    assert all(low.speed < high.speed for low, high in pairwise(found))
    assert len(steps(design())) == 6


@pytest.mark.parametrize("step", steps(design()))
def test_what_may_be_taken_moves_no_correction(step: Fraction) -> None:
    """2 % above every step, as if LR had so much more to do; and at the step itself it has nothing left."""
    of = design()._replace(speed=step * (1 + NEAR))
    assert of.predicted is not None
    taken = may_be_taken(of, of.predicted) / of.period_ns

    def lands(more: Fraction) -> int | None:
        longer = replace(of.costs, lr_update=of.costs.lr_update + more * of.speed)
        return of._replace(costs=longer).predicted

    assert lands(taken) == of.predicted
    assert lands(taken + Fraction(1, 10**6)) != of.predicted


def test_how_far_a_step_is() -> None:
    assert nearest_step(design("0.9282")) == NEAR
    assert nearest_step(design("0.8918")) == -NEAR


def test_speeds_near_to_a_step_have_no_say() -> None:
    swapped, near = judged("swapped"), design("0.8248")
    agreeing = judged("ordinary")._replace(achieved=[7] * 299, disturbed=[False] * 299)
    wrong_near = measured(swapped.ran, near, 7)
    assert word_of([agreeing, wrong_near]) == "agrees"
    assert word_of([agreeing, swapped]) == "disagrees"
    assert word_of([wrong_near]) == "inconclusive"
    assert perfect(near)


def test_speeds_too_few_alone_may_be_enough_together() -> None:
    far, undisturbed = judged("ordinary"), [False] * 100
    few = far._replace(achieved=[7] * 100, disturbed=undisturbed)
    assert word_of([few, few]) == "inconclusive"
    assert word_of([few, few, few]) == "agrees"
    assert word_of([few, few, few, few._replace(disturbed=[True] * 21 + undisturbed[21:])]) == "inconclusive"
    assert word_of([few] * 9 + [few._replace(achieved=[6] * 4 + [7] * 96)]) == "disagrees"
