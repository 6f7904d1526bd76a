"""When the dual-rate filter needs less than other methods: the tables, and what is said of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from reports.charts.panels import METHOD_NAMES
from reports.pages.stored import Rows
from reports.steffes.rows import number
from studies.steffes.advantage import NAMED, Heavier, Needed

OWN = "dual-rate"


def needed_rows(found: Sequence[Needed]) -> Rows:
    rows: Rows = [["Method", "least speed", "over dual-rate's", "lands at L", "named in Sec. I"]]
    own = _speed(found, OWN)
    for one in found:
        named = "" if one.method == OWN else "yes" if one.method in NAMED else "no"
        rows.append([METHOD_NAMES[one.method], number(one.speed), number(one.speed / own, 2), str(one.lands), named])
    return rows


def heavier_rows(found: Sequence[Heavier]) -> Rows:
    waits = list(found[0].dual_rate)
    rows: Rows = [
        ["added work", "Larsen", *(f"dual-rate, L = {L}" for L in waits), *(f"share, L = {L}" for L in waits)]
    ]
    for one in found:
        speeds = [one.dual_rate[L] for L in waits]
        rows.append(
            [
                *(number(one.added, 1), number(one.larsen, 2)),
                *(number(speed, 2) for speed in speeds),
                *(f"{100 * float(speed / one.larsen):.0f} %" for speed in speeds),
            ]
        )
    return rows


def about_advantage(
    found: Sequence[Needed], updates: Sequence[Heavier], rates: Mapping[int, tuple[Fraction, Fraction]], L: int
) -> dict[str, Any]:
    """L: that of the paper's Fig. 3. Raises ValueError if a method that Sec. I names needs less, or N matters."""
    own = _speed(found, OWN)
    less = [one for one in found if one.speed < own]
    if any(one.method in NAMED for one in less) or len(set(rates.values())) > 1:
        raise ValueError("the prose says that each method named in Sec. I needs more, and that N does not matter")
    return {
        "own": number(own),
        "named": [f"{METHOD_NAMES[one.method]} {number(one.speed)}" for one in found if one.method in NAMED],
        "less": [f"{METHOD_NAMES[one.method]} {number(one.speed)}, L = {one.lands}" for one in less],
        "others": len(found) - 1,
        "more": len(found) - 1 - len(less),
        "rates": list(rates),
        "heaviest": number(updates[-1].added, 0),
        "shares": [f"{100 * float(one.dual_rate[L] / one.larsen):.0f} %" for one in (updates[0], updates[-1])],
        "at_once": [
            f"{100 * float(one.dual_rate[min(one.dual_rate)] / one.larsen):.0f} %" for one in (updates[0], updates[-1])
        ],
    }


def _speed(found: Sequence[Needed], method: str) -> Fraction:
    return next(one.speed for one in found if one.method == method)
