"""How a method fits a processor, as a row for scripts and in words."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sched_sim.fit import Fit
    from sched_sim.processor import Processor


def fit_row(part: Processor, found: Fit, hr_hz: Fraction) -> dict[str, Any]:
    """needed_share, load and slack: of the part's speed, its time, its speed. needed_mhz: None if it has no clock."""
    needed = None if part.clock_hz is None else float(found.needed * part.clock_hz / 10**6)
    return {
        "processor": part.name,
        "hr_hz": float(hr_hz),
        "needed_share": float(found.needed),
        "needed_mhz": needed,
        "load": float(found.load),
        "slack": float(found.slack),
        "fits": found.fits,
        "achieved_l": found.landed,
        "correction_ms": None if found.landed is None else float(1000 * found.landed / hr_hz),
        "highest_hr_hz": float(hr_hz / found.needed),
    }


def fit_words(part: Processor, found: Fit, hr_hz: Fraction) -> dict[str, str | None]:
    row = fit_row(part, found, hr_hz)
    landed = row["correction_ms"]
    return {
        "needs, MHz": None if row["needed_mhz"] is None else f"{row['needed_mhz']:.4g}",
        "of its speed": f"{row['needed_share']:.2%}",
        "load": f"{row['load']:.2%}",
        "fits": "yes" if found.fits else "no",
        "lands after, ms": None if landed is None else f"{landed:.4g}",
        "highest HR Hz": f"{row['highest_hr_hz']:.4g}",
    }
