"""The colours of a printed picture on a dark ground: every two stand out from each other as much as they do on paper.

Contrast is the ratio of two luminances, each and 0.05. Where each of them is turned into one over it, and all are scaled
so that white becomes the ground, every ratio stays as it was. The hue stays too: a colour is made darker, or brighter
as far as a screen can, and then paler.
"""

from __future__ import annotations

from functools import cache

from matplotlib.colors import to_rgb

DARK_GROUND = "#12161a"
FLARE = 0.05
"""What is added to each luminance of a contrast."""
SHARES = (0.2126, 0.7152, 0.0722)


@cache
def dark(colour: str) -> str:
    """What `colour`, as hexadecimal, becomes on `DARK_GROUND`."""
    if luminance(colour) == 1:
        return DARK_GROUND
    linear = [_linear(part) for part in to_rgb(colour)]
    wanted = min((luminance(DARK_GROUND) + FLARE) * (1 + FLARE) / (luminance(colour) + FLARE) - FLARE, 1.0)
    most = max(linear)
    full = [part / most for part in linear] if most else [1.0, 1.0, 1.0]
    reached = _luminance(full)
    if wanted <= reached:
        parts = [part * wanted / reached for part in full]
    else:
        white = (wanted - reached) / (1 - reached)
        parts = [part + white * (1 - part) for part in full]
    return "#" + "".join(f"{round(255 * _encoded(part)):02x}" for part in parts)


def luminance(colour: str) -> float:
    """As the Web Content Accessibility Guidelines define it."""
    return _luminance([_linear(part) for part in to_rgb(colour)])


def contrast(one: str, other: str) -> float:
    """From 1, of the same colour, to 21."""
    low, high = sorted(map(luminance, (one, other)))
    return (high + FLARE) / (low + FLARE)


def _luminance(linear: list[float]) -> float:
    return sum(share * part for share, part in zip(SHARES, linear, strict=True))


def _linear(part: float) -> float:
    return part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4


def _encoded(part: float) -> float:
    return 12.92 * part if part <= 0.0031308 else 1.055 * part ** (1 / 2.4) - 0.055
