"""How a method fits a processor, as a row for scripts and in words."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sched_sim.fit import Fit
    from sched_sim.processor import Processor


def fit_row(part: Processor, hr_hz: Fraction, found: Fit | None) -> dict[str, Any]:
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

WORDS = {
    "needs, MHz": ("needed_mhz", "{:.4g}"),
    "of its speed": ("needed_share", "{:.1%}"),
    "slack": ("slack", "{:.1%}"),
    "load": ("load", "{:.2%}"),
    "lands after, ms": ("correction_ms", "{:.6g}"),
    "highest HR Hz": ("highest_hr_hz", "{:.5g}"),
}


def fit_words(row: dict[str, Any]) -> dict[str, str | None]:
    """Of a `fit_row`."""
    words = {
        heading: None if row[key] is None else pattern.format(row[key]) for heading, (key, pattern) in WORDS.items()
    }
    if row["fits"] is False:
        words["slack"] = "none"
    return {"fits": {True: "yes", False: "no", None: None}[row["fits"]], **words}
