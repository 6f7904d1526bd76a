"""Names and ratios of the report on the multirate gain, as it writes them."""

from __future__ import annotations

from studies.multirate.accuracy import ACCELERATION_NOISES

VEHICLES = ("calm", "road", "aircraft")
"""For each of ACCELERATION_NOISES."""

RECEIVERS = {
    f"gps {noise:g}": f"receiver {noise:g}, {vehicle}"
    for noise, vehicle in zip(ACCELERATION_NOISES, VEHICLES, strict=True)
}


def scenario_text(name: str) -> str:
    """A scenario of `studies.multirate.accuracy` in words."""
    return RECEIVERS.get(name, name)


def ratio_text(ratio: float) -> str:
    """Three decimals up to 10, one up to 100."""
    return f"{ratio:.3f}" if ratio < 10 else f"{ratio:.1f}" if ratio < 100 else f"{ratio:.0f}"
