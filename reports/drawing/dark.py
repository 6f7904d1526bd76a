"""The colours of a printed picture on a dark ground, where they stand out from it no less than on paper.

Each keeps its contrast to the ground, the ratio of two luminances, each and 0.05; pale ones get a little more, for on a
dark ground the eye sees less of it. So what is darker on paper is brighter here. The hue stays: a colour is made darker
and purer, or brighter as far as a screen can, and then paler.
"""

from __future__ import annotations

import re
from functools import cache
from math import exp, log

from matplotlib.colors import to_rgb

DARK_GROUND = "#12161a"
FLARE = 0.05
"""What is added to each luminance of a contrast."""
PURER = 0.6
"""Added to a power, as far as a colour is made darker: pale ones are grey to the eye where they are dark."""
SHARES = (0.2126, 0.7152, 0.0722)
COLOUR = re.compile(r"(?<!\()#[0-9a-f]{6}\b")


def themed(style: str) -> str:
    """Declarations of CSS with each colour as it is on paper, and on `DARK_GROUND`."""
    return COLOUR.sub(lambda colour: f"light-dark({colour[0]},{dark(colour[0])})", style)


@cache
def dark(colour: str) -> str:
    """What `colour`, as hexadecimal, becomes on `DARK_GROUND`."""
    if luminance(colour) == 1:
        return DARK_GROUND
    linear = [_linear(part) for part in to_rgb(colour)]
    wanted = min((luminance(DARK_GROUND) + FLARE) * raised(contrast(colour, "#ffffff")) - FLARE, 1.0)
    most = max(linear)
    purer = 1 + PURER * max(1 - wanted / (luminance(colour) or 1), 0)
    full = [(part / most) ** purer for part in linear] if most else [1.0, 1.0, 1.0]
    reached = _luminance(full)
    if wanted <= reached:
        parts = [part * wanted / reached for part in full]
    else:
        white = (wanted - reached) / (1 - reached)
        parts = [part + white * (1 - part) for part in full]
    return "#" + "".join(f"{round(255 * _encoded(part)):02x}" for part in parts)


def raised(ratio: float) -> float:
    """A contrast on white, as it is on `DARK_GROUND`: more by half or so where it is small, and no more than dark text
    on such a fill bears."""
    return float(ratio ** (1 + 0.8 * exp(-((log(ratio) / 0.8) ** 2))))


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
