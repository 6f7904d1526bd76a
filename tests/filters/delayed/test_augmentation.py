"""What augmentation costs: exact polynomials in the number of delayed states, of which the registry has the first."""

from __future__ import annotations

from functools import partial

import pytest

from filters.backends.counted import count
from filters.covariance_forms import COVARIANCE_FORMS, covariance_form
from filters.delayed.augmentation import predict_kind, update_kind
from filters.jobs import JobKind
from filters.samples import sample
from filters.systems.example import example_system

PROTOTYPE = {1: 3530, 2: 6635, 5: 21_782}
"""Operations of the update at 9 states, 3 measurements, by D; with all blocks of P where here half of them do."""


def operations(kind: JobKind, n: int = 9, p: int = 3, form: str = "short") -> int:
    system = example_system(n, 3, p)
    _, function, arguments = kind
    return count(function, *arguments(system, covariance_form(form), sample(system, 0, 0))).total


@pytest.mark.parametrize("form", COVARIANCE_FORMS)
def test_a_delayed_state_more_costs_one_product_in_each_step(form: str) -> None:
    assert [operations(predict_kind(D), form=form) for D in (0, 1, 5, 10)] == [3042 + 1377 * D for D in (0, 1, 5, 10)]


@pytest.mark.parametrize(("n", "p"), [(9, 3), (4, 2), (5, 1)])
def test_the_update_is_quadratic(n: int, p: int) -> None:
    at = [operations(update_kind(D), n, p) for D in (0, 1, 2)]
    first, second = at[1] - at[0], at[2] - 2 * at[1] + at[0]
    for D in (3, 5, 10):
        assert operations(update_kind(D), n, p) == at[0] + first * D + second * D * (D - 1) // 2


def test_the_update_needs_no_more_than_the_prototype() -> None:
    of = partial(operations, n=9, p=3)
    assert all(of(update_kind(D)) <= needed for D, needed in PROTOTYPE.items())
