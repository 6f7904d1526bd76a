"""How much a method needs, and how it fits a processor, as a row for scripts and in words."""

from __future__ import annotations

from collections.abc import Callable
from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sched_sim.design.fit import Fit
    from sched_sim.design.least_speed import LeastSpeed
    from sched_sim.design.timing import Timing
    from sched_sim.processors.part import Part


def least_row(method: str, timing: Timing, least: LeastSpeed | None) -> dict[str, Any]:
    """least: None if the costs are not known."""
    speed = None if least is None else least.speed
    return {
        "method": method,
        "N": timing.N,
        "M": timing.M,
        "L": timing.L,
        "min_speed": None if speed is None else float(speed),
        "min_speed_exact": None if speed is None else str(speed),
        "binding": None if least is None else least.binding,
    }


def fixed_by(binding: str | None) -> str | None:
    """What fixes the least speed, in words."""
    from sched_sim.design.analysis import BINDING_WORDS

    return None if binding is None else BINDING_WORDS.get(binding, binding)


def fit_row(part: Part, hr_hz: Fraction, found: Fit | None) -> dict[str, Any]:
    """needed_share, load and slack: of the part's speed, its time, its speed. None: not known, or it does not land.

    found: None if the part's time for some operation is not known.
    """
    row: dict[str, Any] = dict.fromkeys(KEYS) | {"processor": part.name, "hr_hz": float(hr_hz)}
    if found is None:
        return row
    row |= {
        "needed_share": float(found.needed),
        "load": float(found.load),
        "slack": float(found.slack),
        "fits": found.fits,
        "highest_hr_hz": float(hr_hz / found.needed),
    }
    if part.clock_hz is not None:
        row["needed_mhz"] = float(found.needed * part.clock_hz / 10**6)
    if found.landed is not None:
        row |= {"achieved_l": found.landed, "correction_ms": float(1000 * found.landed / hr_hz)}
    return row


KEYS = ("processor", "hr_hz", "needed_mhz", "needed_share", "load", "slack", "fits", "achieved_l", "correction_ms",
        "highest_hr_hz")  # fmt: skip


def _up(digits: int) -> Callable[[float], str]:
    return lambda value: _rounded(value, digits, ROUND_CEILING)


def _down(digits: int) -> Callable[[float], str]:
    return lambda value: _rounded(value, digits, ROUND_FLOOR)


def _rounded(value: float, digits: int, way: str) -> str:
    """To so many digits, whole numbers in full: a need never looks smaller than it is, nor a limit larger."""
    number = Decimal(value)
    places = max(digits - 1 - number.adjusted(), 0)
    return f"{number.quantize(Decimal(1).scaleb(-places), way):f}"


def _percent(rounded: Callable[[float], str]) -> Callable[[float], str]:
    return lambda value: f"{rounded(100 * value)} %"


WORDS: dict[str, tuple[str, Callable[[float], str]]] = {
    "needs, MHz": ("needed_mhz", _up(4)),
    "of its speed": ("needed_share", _percent(_up(3))),
    "slack": ("slack", _percent(_down(3))),
    "load": ("load", _percent(_up(3))),
    "lands after, ms": ("correction_ms", "{:.6g}".format),
    "highest HR Hz": ("highest_hr_hz", _down(4)),
}

MEANING = (
    "of its speed: what the tightest deadline takes of the part; slack: the rest; load: the share of time it is busy"
)


TASKS_ON_PARTS = "the tasks of --tasks take the same seconds on every processor"


def fit_words(row: dict[str, Any]) -> dict[str, str | None]:
    """Of a `fit_row`."""
    words = {heading: None if row[key] is None else shown(row[key]) for heading, (key, shown) in WORDS.items()}
    if row["fits"] is False:
        words["slack"] = "none"
    return {"fits": {True: "yes", False: "no", None: None}[row["fits"]], **words}
