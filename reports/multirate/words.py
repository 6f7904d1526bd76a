"""Names and ratios of the report on the multirate gain, as it writes them."""

from __future__ import annotations

from collections.abc import Mapping

from reports.drawing.readout import plain_text
from reports.pages.numbers import significant
from studies.multirate.accuracy import ACCELERATION_NOISES, Reading

LEAST_PERCENT = 1e-3
"""Changes of less are not told apart."""

VEHICLES = ("calm", "road", "aircraft")
"""For each of ACCELERATION_NOISES."""

RECEIVERS = {
    f"gps {noise:g}": f"receiver {noise:g}, {vehicle}"
    for noise, vehicle in zip(ACCELERATION_NOISES, VEHICLES, strict=True)
}


def scenario_text(name: str) -> str:
    """A scenario of `studies.multirate.accuracy` in words."""
    return RECEIVERS.get(name, name)


VEHICLE_SYSTEMS = {vehicle: f"gps {noise:g}" for noise, vehicle in zip(ACCELERATION_NOISES, VEHICLES, strict=True)}
"""The scenario of each."""

VEHICLE_TITLES = {"calm": "Calm (hardly manoeuvres)", "road": "Road", "aircraft": "Aircraft (turns)"}

EACH_GAIN = "gain in each step"
READING_NAMES: Mapping[Reading, str] = {
    "averaged": "divided gain, $R/n$",
    "sampled": "divided gain, $R$",
    "skipped": "skipped: one measurement in $n$",
}
"""What is done with the gain, as legends name it."""


def reading_text(reading: Reading) -> str:
    """As legends name it, without their mathtext."""
    return plain_text(READING_NAMES[reading])


KINDS = {"random walk": "random walk", "tracker": "tracker", "gps": "receiver"}
"""By the beginning of a scenario's name."""

SIGNS = {"Phi": "Φ", "Gamma": "Γ", "S^-1": "S⁻¹", "^3": "³", "^2": "²", "'": "ᵀ", " - ": " − "}


def formula_text(text: str) -> str:
    """A formula of `studies.multirate.patent` as a page writes it."""
    for plain, sign in SIGNS.items():
        text = text.replace(plain, sign)
    return text


def signed(number: int) -> str:
    """With its sign, a true minus."""
    return f"{number:+d}".replace("-", "\N{MINUS SIGN}")


def change_text(change: float) -> str:
    """A change of a gain in percent, three digits; what is less than rounding is told so."""
    return f"< {LEAST_PERCENT:g}" if 100 * change < LEAST_PERCENT else significant(100 * change)


def ratio_text(ratio: float) -> str:
    """Three decimals up to 10, one up to 100."""
    return f"{ratio:.3f}" if ratio < 10 else f"{ratio:.1f}" if ratio < 100 else f"{ratio:.0f}"
