"""Command lines and files with slips in them: the contract holds."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import HealthCheck, Phase, given, seed, settings

from tests.exhaust import share_of
from tests.fuzz.cases import Case, cases
from tests.fuzz.contract import check

PARTS, IN_A_PART, DRAWN_IN_A_PART = 200, 495, 5
"""100,000 cases."""


@settings(max_examples=15)
@given(cases())
def test_the_contract_holds(case: Case) -> None:
    check(case)


@pytest.mark.exhaust
@settings(max_examples=3)
@given(cases(drawn=True))
def test_the_contract_holds_for_pictures(case: Case) -> None:
    check(case)


@pytest.mark.exhaust
@pytest.mark.parametrize("part", range(PARTS))
def test_the_contract_holds_in_a_hundred_thousand_cases(
    part: int, record_property: Callable[[str, object], None]
) -> None:
    for drawn, whole in ((False, IN_A_PART), (True, DRAWN_IN_A_PART)):
        _many(part, share_of(whole), drawn=drawn)
        record_property("cases", share_of(whole))


def _many(part: int, count: int, *, drawn: bool) -> None:
    @seed(part)
    @settings(
        max_examples=count,
        derandomize=False,
        database=None,
        phases=[Phase.generate, Phase.shrink],
        suppress_health_check=list(HealthCheck),
    )
    @given(cases(drawn=drawn))
    def holds(case: Case) -> None:
        check(case)

    holds()
