"""What a person gives to a scenario's records, as they write it, made into what the records hold."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from fractions import Fraction
from functools import partial
from typing import Any, TypeVar

from sched_sim.bounds import MOST_DIGITS, MOST_STEPS, short, whole
from sched_sim.costs.sample_text import of_each
from sched_sim.errors import InputError
from sched_sim.scenario.instants import Spread, Steps
from sched_sim.ticks import exact, positive

Held = TypeVar("Held")
Number = TypeVar("Number", int, Steps)
Made = Callable[[Any, str], Held]
"""What a field holds, of what was given and the field's name; raises InputError."""


def settle(record: object, fields: Mapping[str, Made[object]]) -> dict[str, str]:
    """Each field as it is to be; what cannot be stays, and is told of, by the name of its field."""
    wrong = {}
    for name, made in fields.items():
        try:
            object.__setattr__(record, name, made(getattr(record, name), name))
        except InputError as error:
            wrong[name] = str(error)
    return wrong


def text(why: str) -> Made[str]:
    def made(value: Any, name: str) -> str:
        if not isinstance(value, str):
            raise InputError(f"{name} is {short(repr(value))}: give text")
        if not value.strip():
            raise InputError(f"the {name} is empty: give one, {why}")
        return value

    return made


def any_whole(value: Any, name: str) -> int:
    return whole(value, name, 10**MOST_DIGITS)


def steps(value: Any, name: str) -> Steps:
    """So many HR steps, whole or not."""
    if hasattr(value, "__index__"):
        return any_whole(value, name)
    number = exact(value, name)
    return number.numerator if number.denominator == 1 else number


def steps_at_least(least: int, why: str) -> Made[Steps]:
    return _at_least(steps, least, why)


def at_least(least: int, why: str) -> Made[int]:
    return _at_least(any_whole, least, why)


def _at_least(read: Made[Number], least: int, why: str) -> Made[Number]:
    bound = f"at least {least}" if least else "0 or more"

    def made(value: Any, name: str) -> Number:
        number = read(value, name)
        if number < least:
            raise InputError(f"{name} {number} must be {bound}: it is {why}")
        return number

    return made


def one_of(*known: object) -> Made[object]:
    def made(value: Any, name: str) -> object:
        for choice in known:
            if isinstance(value, type(choice)) and value == choice:
                return choice
        raise InputError(f"{name} is {short(repr(value))}: choose from {', '.join(map(repr, known))}")

    return made


def cpu_count(value: Any, name: str) -> object:
    return one_of(1, 2)(any_whole(value, name), name)


def work(value: Any, name: str) -> Fraction:
    number = exact(value, name)
    if number < 0:
        raise InputError(f"{name} {float(number):g} must be 0 or more cost units")
    return number


def rate(value: Any, name: str) -> Fraction | None:
    return None if value is None else positive(value, name)


def probability(value: Any, name: str) -> float:
    number = float(exact(value, name))
    if not 0 <= number <= 1:
        raise InputError(f"{name} {number:g} must be from 0 to 1: it is a probability, 10 % is 0.1")
    return number


def several(value: Any) -> Sequence[Any]:
    """One value, or as many as there are, also an iterator's or NumPy's; what may be long and is no list stays."""
    value = value.tolist() if hasattr(value, "tolist") else value
    if isinstance(value, range | Spread):
        return value
    return (value,) if isinstance(value, str) or not isinstance(value, Iterable) else tuple(value)


def steps_drawn(value: Any, name: str) -> Sequence[Steps]:
    """Delays; a file calls them `delay`."""
    if isinstance(value, Mapping):
        raise InputError(f"{name} is {short(repr(value))}: give a number of steps, a list, or range(least, most + 1)")
    delays = several(value)
    if not delays:
        raise InputError(
            "delay has nothing to draw from: give a number of steps, a list, or { least = ..., most = ... }"
        )
    if not isinstance(delays, range | Spread):
        delays = tuple(steps(delay, name) for delay in delays)
    least, longest = ends(delays)
    if least < 0:
        raise InputError(f"delay {least} must be 0 or more: no measurement arrives before it is taken")
    if longest > MOST_STEPS:
        raise InputError(f"delay {short(longest)} is above {MOST_STEPS:,} HR steps: give fewer")
    return delays


def ends(delays: Sequence[Steps]) -> tuple[Steps, Steps]:
    """The least and the greatest, at once of a long range too."""
    candidates = (delays[0], delays[-1]) if isinstance(delays, range | Spread) else delays
    return min(candidates), max(candidates)


def samples(value: Any, name: str) -> Mapping[str, Sequence[Fraction]]:
    """Execution times by part, of one or several numbers each."""
    if not isinstance(value, Mapping):
        raise InputError(f'{name} is {short(repr(value))}: give execution times by part, such as {{"predict": [0.1]}}')
    return {part: of_each(partial(positive, what=f"{name} of {part}"), several(times)) for part, times in value.items()}


def all_of(kind: type, *, least: int = 0) -> Made[tuple[Any, ...]]:
    """Several records of a kind."""

    def made(value: Any, name: str) -> tuple[Any, ...]:
        items = several(value)
        if len(items) < least:
            raise InputError(f"{name} is empty: give at least one {kind.__name__}")
        for item in items:
            if not isinstance(item, kind):
                raise InputError(f"{name} holds {short(repr(item))}: give a list of {kind.__name__}")
        return tuple(items)

    return made
