"""Numbers and names of the report on the multirate gain, as it writes them."""

from __future__ import annotations

from fractions import Fraction

from studies.multirate import ACCELERATION_NOISES

VEHICLES = ("calm", "road", "aircraft")
"""For each of ACCELERATION_NOISES."""

RECEIVERS = {
    f"gps {noise:g}": f"receiver {noise:g}, {vehicle}"
    for noise, vehicle in zip(ACCELERATION_NOISES, VEHICLES, strict=True)
}


def scenario_text(name: str) -> str:
    """A scenario of `studies.multirate` in words."""
    return RECEIVERS.get(name, name)


def percent(share: Fraction) -> str:
    """Without the sign, which stands in the heading: two decimals, and four below 0.1 %."""
    value = 100 * float(share)
    return f"{value:.2f}" if abs(value) >= 0.1 else f"{value:.4f}"


def decimal(value: Fraction) -> str:
    return f"{float(value):.2f}"


def ratio_text(ratio: float) -> str:
    """Three decimals up to 10, one up to 100."""
    return f"{ratio:.3f}" if ratio < 10 else f"{ratio:.1f}" if ratio < 100 else f"{ratio:.0f}"


def significant(value: Fraction | float, digits: int = 3) -> str:
    """So many digits, with commas between thousands; such as a rate in Hz."""
    rounded = float(f"{float(value):.{digits}g}")
    return f"{rounded:,.0f}" if rounded >= 10 ** (digits - 1) else f"{rounded:#.{digits}g}"
