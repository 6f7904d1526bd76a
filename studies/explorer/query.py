"""A design as the query of a link, and back."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import fields
from fractions import Fraction
from typing import Any
from urllib.parse import parse_qsl, quote

from sched_sim.bounds import short
from sched_sim.design.options import Options, choices
from sched_sim.errors import InputError, option
from sched_sim.text import did_you_mean
from sched_sim.ticks import exact
from studies.explorer.design import Design
from studies.explorer.given import Given

OF_OPTIONS = tuple(choice.name for choice in fields(Options))
OF_DESIGN = tuple(field.name for field in fields(Design) if field.name != "options")
KEYS = (*OF_DESIGN, *OF_OPTIONS)
"""Of a query, in the order in which `query_of` has them."""

WHOLE = ("N", "M", "L", "cycles", "cpus")
LONGEST = 4000
"""Letters of a query."""

_DIGITS = re.compile(r"[+-]?[0-9]{1,50}")


def design_of(query: str, given: Given = Given()) -> Design:
    """What a link says; what it leaves out is as by default, and no query at all is the design that the explorer starts
    with.

    Raises InputError for a key that is unknown or there twice, and for a value that cannot be.
    """
    text = query.removeprefix("?")
    if not text:
        return given.start
    values = pairs_of(text, KEYS)
    said = {name: _value(name, values[name]) for name in values}
    chosen = {name: said.pop(name) for name in OF_OPTIONS if name in said}
    return Design(**said, options=Options(**chosen))


def query_of(design: Design) -> str:
    """The query that `design_of` makes this design of: only what is not as by default, always in the same order."""
    return Queries(design).but()


class Queries:
    """Those of a design, and of others that differ from it in a few keys."""

    def __init__(self, design: Design) -> None:
        self._pairs = _pairs(_said(design))

    def but(self, **changes: Any) -> str:
        """The query of the design with these in place of its own."""
        return "&".join(filter(None, (self._pairs | _pairs(changes)).values()))


def _pairs(values: Mapping[str, Any]) -> dict[str, str]:
    """By key, what stands in a query; empty for what is as by default."""
    return {
        name: "" if value is None or value == DEFAULTS[name] else f"{name}={quote(_text(value), safe='/,:')}"
        for name, value in values.items()
    }


def texts(design: Design) -> Mapping[str, str | None]:
    """Every key of a query, with what the design has: numbers as exact text, None for what was not said."""
    return {name: None if value is None else _text(value) for name, value in _said(design).items()}


def _said(design: Design) -> dict[str, Any]:
    values = {name: getattr(design, name) for name in OF_DESIGN}
    return values | {name: getattr(design.options, name) for name in OF_OPTIONS}


def number_text(value: Fraction) -> str:
    """A decimal where it is one, else a quotient: "0.77", "100/3"."""
    rest = value.denominator
    for prime in (2, 5):
        while rest % prime == 0:
            rest //= prime
    if rest != 1:
        return str(value)
    places = 0
    while value.denominator != 1:
        value, places = 10 * value, places + 1
    digits = f"{abs(value.numerator):0{places + 1}d}"
    text = f"{digits[:-places]}.{digits[-places:]}" if places else digits
    return f"-{text}" if value < 0 else text


def _text(value: Any) -> str:
    return number_text(value) if isinstance(value, Fraction) else str(value)


def pairs_of(text: str, keys: Sequence[str]) -> dict[str, str]:
    """Of a query that may have these keys. Raises InputError for another, and for one that is there twice."""
    if not text:
        return {}
    if len(text) > LONGEST:
        raise InputError(f"the query has {len(text):,} letters: at most {LONGEST:,} are read")
    try:
        pairs = parse_qsl(text, keep_blank_values=True, strict_parsing=True, errors="strict")
    except ValueError:
        raise InputError(f"the query is {short(repr(text))}: give key=value pairs with & between them") from None
    values: dict[str, str] = {}
    for key, value in pairs:
        if key not in keys:
            raise InputError(
                f"the query's key {short(repr(key))} is unknown: {did_you_mean(key, keys)}choose from {', '.join(keys)}"
            )
        if key in values:
            raise InputError(
                f"the query has {option(key)} twice, {short(repr(values[key]))} and {short(repr(value))}: leave one out"
            )
        values[key] = value
    return values


def _value(key: str, text: str) -> Any:
    if key in WHOLE:
        return whole_number(key, text)
    if key == "context_switch":
        return exact(text, option(key))
    if known := choices().get(key):
        if text not in known:
            raise InputError(f"{option(key)} is {short(repr(text))}: choose from {', '.join(map(str, known))}")
        return text
    return text


def whole_number(key: str, text: str) -> int:
    """Raises InputError for a text that is none."""
    if not _DIGITS.fullmatch(text):
        raise InputError(f"{option(key)} is {short(repr(text))}: give a whole number")
    return int(text)


DEFAULTS = _said(Design())
