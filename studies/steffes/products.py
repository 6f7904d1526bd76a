"""Steffes (2014), Sec. III.C: one more n x n x n product in each HR step than the standard filter, by counts."""

from __future__ import annotations

from typing import NamedTuple

from filters.backends.counted import count
from filters.registry import ALL_METHODS
from filters.systems.example import example_system

STATES = (3, 6, 9, 12)
INPUTS = MEASUREMENTS = 3
STANDARD = ("standard", "propagate")
STEPS = {
    STANDARD: "Standard (no delay)",
    ("larsen", "propagate_accumulate"): "Larsen",
    ("dual-rate", "hr_propagate"): "Dual-rate",
    ("dual-rate", "hr_propagate_sum"): "Dual-rate, Q′",
    ("dual-rate", "hr_propagate_euler"): "Dual-rate, Q″",
}
"""What each method does in an HR step, from k + 2 on, by method and job."""


class Multiplies(NamedTuple):
    """Of one HR step, by method and job; n states."""

    n: int
    by_job: dict[tuple[str, str], int]

    def more(self, job: tuple[str, str]) -> int:
        """Than the standard filter's; less than 0 if fewer."""
        return self.by_job[job] - self.by_job[STANDARD]


def multiplies() -> list[Multiplies]:
    """Counted by running the jobs on numbers that count."""
    return [Multiplies(n, {job: _count(n, *job) for job in STEPS}) for n in STATES]


def _count(n: int, method: str, kind: str) -> int:
    job = ALL_METHODS[method].jobs(example_system(n, INPUTS, MEASUREMENTS), "textbook", 0)[kind]
    return count(job.function, *job.arguments(0)).multiply
