"""Many samples as they stand in a file: a text of numbers in the order in which they were measured.

A list of as many numbers takes sixteen times as long to read: TOML makes an object of each, and few of them differ.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from fractions import Fraction
from typing import TypeVar

from sched_sim.costs.table import positive_cost
from sched_sim.files.toml_writer import toml_number

LONG = 100
"""More samples than these are written as text."""
A_LINE = 25

Sample = TypeVar("Sample")
Made = TypeVar("Made")


def samples_in(text: str) -> tuple[Fraction, ...]:
    """The samples of a text, exact; equal ones are one object.

    Raises ValueError that names the first number which is none, or not greater than 0.
    """
    words = text.split()
    known: dict[str, Fraction] = {}
    for word in set(words):
        try:
            known[word] = positive_cost(word, "cost")
        except ValueError as error:
            raise ValueError(f"number {words.index(word) + 1} of the text: {error}") from None
    return tuple(map(known.__getitem__, words))


def samples_value(samples: Sequence[Fraction]) -> str:
    """The TOML value: a list of few samples, a text of many."""
    words = of_each(toml_number, samples)
    if len(words) <= LONG:
        return f"[{', '.join(words)}]"
    lines = [" ".join(words[first : first + A_LINE]) for first in range(0, len(words), A_LINE)]
    return "\n".join(["'''", *lines, "'''"])


def of_each(function: Callable[[Sample], Made], samples: Collection[Sample]) -> tuple[Made, ...]:
    """The function of each sample, computed once for those that are one object, as in what `samples_in` returns."""
    known = {id(sample): function(sample) for sample in {id(sample): sample for sample in samples}.values()}
    return tuple([known[id(sample)] for sample in samples])
