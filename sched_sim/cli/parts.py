"""How much a method needs, and how it fits a processor, as a row for scripts and in words."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from sched_sim.rounding import Figure, down, percent_up, up, written

if TYPE_CHECKING:
    from sched_sim.design.fit import Fit
    from sched_sim.design.least_speed import LeastSpeed
    from sched_sim.design.times import Times
    from sched_sim.design.timing import Timing
    from sched_sim.processors.part import Part
    from sched_sim.schedule.tasks import Task


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
    from sched_sim.design.binding import BINDING_WORDS

    return None if binding is None else BINDING_WORDS.get(binding, binding)


def fit_row(
    part: Part | None, hr_hz: Fraction, times: Times, verdict: Fit | None, tasks: bool = False
) -> dict[str, Any]:
    """needed_share, load and slack: of the part's speed, its time, its speed; needed_share_least and needed_share_most:
    by the part's calibration, None if it has none; correction_ms: from when a measurement is taken, at the latest.
    None: not known, or it does not land.

    verdict: None if the part's time for some operation is not known.
    """
    return {
        key: float(figure) if isinstance(figure, Fraction) else figure
        for key, figure in _figures(part, hr_hz, times, verdict, tasks).items()
    }


def _figures(part: Part | None, hr_hz: Fraction, times: Times, verdict: Fit | None, tasks: bool) -> dict[str, Any]:
    """Exactly, by their keys in a row."""
    figures: dict[str, Any] = dict.fromkeys(KEYS) | {"processor": part and part.name, "hr_hz": hr_hz}
    if verdict is None:
        return figures
    figures |= {
        "needed_share": verdict.needed,
        "load": verdict.load,
        "slack": verdict.slack,
        "fits": verdict.fits,
        "highest_hr_hz": verdict.highest_hz,
    }
    if part is not None and part.calibration is not None:
        figures["needed_share_least"] = verdict.needed * part.calibration.least
        figures["needed_share_most"] = verdict.needed * part.calibration.most
    if part is not None and part.clock_hz is not None and not tasks:  # whose seconds do not follow the clock
        figures["needed_mhz"] = verdict.needed * part.clock_hz / 10**6
    if verdict.landed is not None:
        figures |= {"achieved_l": verdict.landed, "correction_ms": times.landing_ms(verdict.landed, hr_hz)}
    return figures


KEYS = ("processor", "hr_hz", "needed_mhz", "needed_share", "needed_share_least", "needed_share_most", "load", "slack",
        "fits", "achieved_l", "correction_ms", "highest_hr_hz")  # fmt: skip


def _limit(value: Figure) -> str:
    """A rate that may be as long as it takes to fit, and is then shown so; others are rounded down to four digits."""
    exact = written(value)
    number = Decimal(exact.numerator) / Decimal(exact.denominator)
    if Fraction(number) == exact and len(number.as_tuple().digits) <= MOST_SHOWN_DIGITS:
        return f"{number.normalize():f}"
    if exact.denominator <= MOST_SHOWN_DENOMINATOR:
        return str(exact)
    return down(exact, 4)


HIGHEST_HR_HZ = "highest HR Hz"

MOST_SHOWN_DIGITS, MOST_SHOWN_DENOMINATOR = 12, 1000
"""Of the highest rate."""

WORDS: dict[str, tuple[str, Callable[[Any], str]]] = {
    "needs, MHz": ("needed_mhz", lambda value: up(value, 4)),
    "of its speed": ("needed_share", percent_up),
    "slack": ("slack", lambda value: f"{down(100 * value, 3)} %"),
    "load": ("load", percent_up),
    "lands after, ms": ("correction_ms", lambda value: f"{float(value):.6g}"),
    HIGHEST_HR_HZ: ("highest_hr_hz", _limit),
}
"""Headings, keys of a row, and how their figures are written."""

MEANING = (
    "of its speed: what the tightest deadline takes of the part; slack: the rest; load: the share of time it is busy"
)


def highest_note(tasks: Sequence[Task]) -> str:
    """What the highest rate means where tasks have given offsets; empty where none has."""
    named = [task.name for task in tasks if task.offset != "any"]
    if not named:
        return ""
    period = "its period is" if len(named) == 1 else "the period of one is"
    return (
        f"{HIGHEST_HR_HZ}: with the offset of {', '.join(named)} at rates at which {period} whole HR periods; at "
        f"others the phase drifts, and may be any"
    )


TASKS_ON_PARTS = "the tasks of --tasks take the same seconds on every processor"


def fit_words(
    part: Part | None, hr_hz: Fraction, times: Times, verdict: Fit | None, tasks: bool = False
) -> dict[str, str | None]:
    """A `fit_row` in words."""
    figures = _figures(part, hr_hz, times, verdict, tasks)
    words = {heading: None if figures[key] is None else shown(figures[key]) for heading, (key, shown) in WORDS.items()}
    if part is None or tasks:
        del words["needs, MHz"]
    if figures["fits"] is False:
        words["slack"] = "none"
    return {"fits": {True: "yes", False: "no", None: None}[figures["fits"]], **words}
