"""The values of one axis of a sweep: "5", "1,2,5", "10:100:10", or lists of those."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from decimal import Decimal
from fractions import Fraction
from typing import Any, TypeVar

from sched_sim.bounds import short, whole
from sched_sim.errors import InputError
from sched_sim.text import did_you_mean
from sched_sim.ticks import exact

LONGEST_RANGE = 1_000_000

Scalar = int | float | str | Decimal | Fraction
Value = TypeVar("Value", int, Fraction)


def whole_numbers(entry: Scalar | Sequence[Scalar], what: str, at_least: int) -> tuple[int, ...]:
    """The values of an axis of HR steps, sorted, each once. `what` names the option or the key, for messages.

    Raises InputError for text that is no whole number or range of them, and for values below `at_least`.
    """

    def step(text: str) -> int:
        number = exact(text, what)
        if number.denominator != 1 or number < at_least:
            raise InputError(f"{what} {short(text)!r} must be a whole number, at least {at_least}")
        return whole(number.numerator, what)

    return _values(entry, what, step)


def numbers(entry: Scalar | Sequence[Scalar], what: str, *, zero: bool = False) -> tuple[Fraction, ...]:
    """The values of an axis of exact decimals or fractions, sorted, each once: 0.6:1.6:0.05 are 21 values.

    Raises InputError for text that is no finite number or range, and for values that are not positive (`zero`: may
    be 0).
    """

    def number(text: str) -> Fraction:
        value = exact(text, what)
        if value < 0 or (value == 0 and not zero):
            raise InputError(f"{what} {short(text)!r} must be {'0 or more' if zero else 'greater than 0'}")
        return value

    return _values(entry, what, number)


def words(entry: Scalar | Sequence[Scalar], what: str, known: Sequence[str]) -> tuple[str, ...]:
    """The values of an axis of names, in the order of `known`, each once; commas separate.

    Raises InputError for a name that is not `known`, and where there is none.
    """
    items = entry if isinstance(entry, list | tuple) else [entry]
    if any(isinstance(item, dict | list) for item in items):
        raise InputError(f"{what} must be text, or a list of it: choose from {', '.join(known)}")
    names = {part.strip() for item in items for part in str(item).split(",")}
    if not names:
        raise InputError(f"{what} is empty: give at least one of {', '.join(known)}")
    for word in sorted(names.difference(known)):
        meant = did_you_mean(word, known)
        raise InputError(f"{what} {short(word)!r} is unknown: {meant}choose from {', '.join(known)}")
    return tuple(word for word in known if word in names)


def _values(entry: Scalar | Sequence[Scalar], what: str, value: Callable[[str], Value]) -> tuple[Value, ...]:
    items: Sequence[Any] = entry if isinstance(entry, Sequence) and not isinstance(entry, str) else [entry]
    values: set[Value] = set()
    for item in items:
        if isinstance(item, dict | list):
            raise InputError(f"{what} must be a number or a list of them, such as 5, 1,2,5 or 10:100:10")
        if isinstance(item, bool):
            raise InputError(f"{what} {item!r}: give numbers, such as 5, 1,2,5 or 10:100:10")
        if isinstance(item, Decimal):
            exact(item, what)
        for part in str(item).split(","):
            values.update(_range(part.strip(), what, value))
            if len(values) > LONGEST_RANGE:
                raise InputError(f"{what} holds more than {LONGEST_RANGE:,} values: give fewer")
    if not values:
        raise InputError(f"{what} is empty: give at least one value, such as 5, 1,2,5 or 10:100:10")
    return tuple(sorted(values))


def _range(text: str, what: str, value: Callable[[str], Value]) -> list[Value]:
    """The values of one part: a single one, or "first:last" or "first:last:step" with its end in it."""
    ends = text.split(":")
    if len(ends) == 1:
        return [value(text)]
    if len(ends) > 3:
        raise InputError(f"{what} {short(text)!r} is no range: give first:last or first:last:step")
    first, last = value(ends[0]), value(ends[1])
    step = value(ends[2]) if len(ends) == 3 else value("1")
    if step <= 0:
        raise InputError(f"{what} {short(text)!r}: the step must be greater than 0")
    if last < first:
        raise InputError(f"{what} {short(text)!r} is an empty range: its end is below its start")
    count = (last - first) // step + 1
    if count > LONGEST_RANGE:
        raise InputError(
            f"{what} {short(text)!r} holds {short(count)} values: at most {LONGEST_RANGE:,}; give a larger step"
        )
    return [first + i * step for i in range(count)]
