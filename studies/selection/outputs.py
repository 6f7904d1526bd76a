"""The outputs whose accuracy is asked for: some states of the model, or rows of numbers, with a name and a unit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from filters.accuracy.model import LinearModel, output_rows
from filters.accuracy.shipped import Output
from filters.accuracy.visible import visible
from filters.arrays import FloatArray
from sched_sim.bounds import MOST_STATES, short
from sched_sim.errors import InputError, option
from studies.selection.model import Model

HOW = "give states as position=0:3 (from 0 to before 3) or 0,2,5"


class Outputs(NamedTuple):
    """name: of all of them together. rows (o, n): C. unit: of their standard deviation, "" where it is not known."""

    name: str
    rows: FloatArray
    unit: str


def outputs_of(model: Model, asked: Any = None, unit: str | None = None) -> Outputs:
    """asked: text as the command line has it, the name of an output of a shipped model, the numbers of states, or rows;
    None: the first of a shipped model.

    Raises InputError for what the model does not have, and for outputs whose variance has no bound.
    """
    found = _outputs(model, asked)
    said = option("output") if asked is None else f"{option('output')} {short(asked)}"
    try:
        visible(model.linear, found.rows)
    except ValueError as error:
        remedy = "" if model.system is None else f"; where it is seen in motion, give {option('trajectory')}"
        raise InputError(f"{said}: {error}{remedy}") from None
    return _in_unit(found, unit)


def rows_of(model: Model, asked: Any, unit: str | None = None) -> Outputs:
    """`outputs_of` without a look at whether their variance has a bound."""
    found = _outputs(model, asked)
    return _in_unit(found, unit)


def _in_unit(found: Outputs, unit: str | None) -> Outputs:
    """Raises InputError for another unit than the one that is known."""
    if unit is None:
        return found
    if found.unit and unit != found.unit:
        raise InputError(f"{option('unit')} {short(unit)}: {found.name} is in {found.unit}; leave {option('unit')} out")
    return found._replace(unit=unit)


def _outputs(model: Model, asked: Any) -> Outputs:
    named = {} if model.shipped is None else dict(model.shipped.outputs)
    n = model.linear.states
    if asked is None:
        if model.shipped is None:
            raise InputError(f"{option('output')} is missing: {HOW}; the model has the states 0 to {n - 1}")
        asked = model.shipped.output
    if not isinstance(asked, str):
        return Outputs("output", _rows(asked, f"{option('output')} of shape {np.shape(asked)}", model.linear), "")
    if asked in named:
        return Outputs(asked, output_rows(named[asked].states, n), named[asked].unit)
    said = f"{option('output')} {short(asked)}"
    name, equals, states = asked.rpartition("=")
    if equals and not name.strip():
        raise InputError(f"{said} has no name before the = sign: {HOW}")
    numbers = _states(states, said, tuple(named))
    rows = _rows(numbers, said, model.linear)
    return Outputs(name.strip() or f"states {states}", rows, _unit_of(numbers, said, named))


def _unit_of(states: Sequence[int], said: str, named: Mapping[str, Output]) -> str:
    """Of these states of a shipped model; "" of another. Raises InputError for states of different units, for the
    squares of these have no sum."""
    units = list(dict.fromkeys(output.unit for output in named.values() if set(states) & set(output.states)))
    if len(units) > 1:
        raise InputError(
            f"{said} holds states in {', '.join(units)}, which have no standard deviation together: ask for one of "
            f"{', '.join(named)}, or for states of one unit"
        )
    return units[0] if units else ""


def _states(text: str, said: str, named: tuple[str, ...]) -> list[int]:
    known = f", or one of {', '.join(named)}" if named else ""
    numbers: list[int] = []
    for part in text.split(","):
        first, colon, end = part.partition(":")
        try:
            start, stop = int(first), int(end) if colon else int(first) + 1
        except ValueError:
            raise InputError(f"{said}: {short(text)!r} are no states: {HOW}{known}") from None
        if stop <= start:
            raise InputError(f"{said}: {short(part)!r} holds no state, its end is not above its start: {HOW}")
        if stop - start > MOST_STATES:
            raise InputError(f"{said}: {short(part)!r} holds {stop - start:,} states: at most {MOST_STATES}")
        numbers += range(start, stop)
    return numbers


def _rows(asked: Any, said: str, model: LinearModel) -> FloatArray:
    states = model.states
    _refuse_repeats(asked, said, model)
    try:
        rows = output_rows(asked, states)
    except (ValueError, TypeError):
        raise InputError(
            f"{said} is not of this model, which has the states 0 to {states - 1}: {HOW}, or rows of {states} finite "
            f"numbers"
        ) from None
    if not np.any(rows, axis=1).all():
        raise InputError(f"{said}: a row of zeros is no output: give rows with a number in them")
    return rows


def _refuse_repeats(asked: Any, said: str, model: LinearModel) -> None:
    """Raises InputError for a row that is there twice: it would count twice in the standard deviation of all."""
    try:
        rows = np.atleast_1d(np.asarray(asked, dtype=float)).tolist()
    except (ValueError, TypeError):
        return
    for at, row in enumerate(rows):
        first = rows.index(row)
        if first == at:
            continue
        if isinstance(row, list):
            raise InputError(f"{said}: rows {first} and {at} are the same and would count twice: give each row once")
        state = int(row) if np.isfinite(row) else 0
        named = f" ({model.names[state]})" if 0 <= state < len(model.names) else ""
        raise InputError(f"{said}: state {row:g}{named} is there twice and would count twice: give each state once")
