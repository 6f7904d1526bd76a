"""`make exhaust`: tests that take minutes, marked `exhaust`.

Such a test takes its size from `share_of` and tells its figures with pytest's `record_property`; they are printed at
the end. What is long is parametrised into parts of under a minute, which two workers share:

    @pytest.mark.exhaust
    @pytest.mark.parametrize("seed", range(100))
    def test_analysis_is_the_simulation(seed, record_property):
        designs = share_of(10_000)
        ...
        record_property("designs", designs)
"""

from __future__ import annotations

import os
from collections import defaultdict
from collections.abc import Iterable

import pytest


def share_of(whole: int) -> int:
    """How many of `whole` cases to try: all, or the share that EXHAUST_SHARE says, at least one."""
    return max(1, round(whole * float(os.environ.get("EXHAUST_SHARE", "1"))))


def figures(reports: Iterable[pytest.TestReport]) -> list[str]:
    """One line for each test function: seconds, and each recorded property, summed over its parameters."""
    sums: dict[str, defaultdict[str, float]] = {}
    for report in reports:
        total = sums.setdefault(report.nodeid.split("[")[0], defaultdict(float))
        total["s"] += report.duration
        for name, value in report.user_properties:
            total[name] += float(str(value))
    return [f"{test}: {', '.join(f'{value:,.0f} {name}' for name, value in of.items())}" for test, of in sums.items()]
