"""The texts of an SVG of matplotlib's as texts: searched, copied and read aloud, and as wide in every font.

matplotlib writes each text with the font it measured; where that is missing, another would be wider or narrower. Here a
text has its width beside it, and each letter of a formula its place; what a formula takes from a font of signs is an
outline.
"""

from __future__ import annotations

import re
from functools import cache
from html import escape, unescape
from itertools import groupby, pairwise
from typing import NamedTuple

from matplotlib.font_manager import FontProperties, findfont, get_font
from matplotlib.ft2font import Kerning, LoadFlags
from matplotlib.path import Path
from matplotlib.textpath import TextPath

from reports.drawing.style import FAMILY

FAMILIES = f"'{FAMILY}', Verdana, sans-serif"
STYLE = f"text {{font-family: {FAMILIES}; white-space: pre}}"
"""Of all texts."""

TEXT = re.compile(r'<text style="(?P<style>[^"]*)"(?P<place>[^>]*)>(?P<text>[^<]*)</text>')
FORMULA = re.compile(r"<text>\s*(<tspan.*?)\s*</text>", re.DOTALL)
PIECE = re.compile(r'<tspan x="(?P<x>[^"]*)" y="(?P<y>[^"]*)" style="(?P<style>[^"]*)">(?P<text>[^<]*)</tspan>')
LEVEL = re.compile(r' transform="rotate\(-?0 [^)]*\)"')
NO_BREAK = "\N{NO-BREAK SPACE}"
"""matplotlib's between the words of a formula: who searches types another."""


class Letter(NamedTuple):
    """Of a formula."""

    x: float
    y: str
    style: str
    text: str


def lettered(svg: str) -> str:
    """The same picture; `STYLE` is to stand in its style sheet."""
    return FORMULA.sub(_formula, TEXT.sub(_text, svg))


def _text(found: re.Match[str]) -> str:
    style = _declarations(found["style"])
    size = float(style["font-size"].removesuffix("px"))
    width = size * advance(unescape(found["text"]), bold="font-weight" in style, oblique="font-style" in style)
    long = f'textLength="{width:.2f}" lengthAdjust="spacingAndGlyphs"'
    return f'<text style="{_written(style)}"{LEVEL.sub("", found["place"])} {long}>{found["text"]}</text>'


def _formula(found: re.Match[str]) -> str:
    """From left to right, as it is read."""
    letters = sorted((letter for piece in PIECE.finditer(found[1]) for letter in _letters(piece)), key=lambda it: it.x)
    spans = [_span(list(run)) for _, run in groupby(letters, lambda it: (it.y, it.style))]
    return f"<text>{''.join(spans)}</text>" + "".join(_outline(letter) for letter in letters if not _is_plain(letter))


def _letters(piece: re.Match[str]) -> list[Letter]:
    places, text = map(float, piece["x"].split()), unescape(piece["text"]).replace(NO_BREAK, " ")
    return [Letter(x, piece["y"], piece["style"], letter) for x, letter in zip(places, text, strict=True)]


def _span(run: list[Letter]) -> str:
    places = " ".join(f"{letter.x:.4g}" for letter in run)
    text = escape("".join(letter.text for letter in run), quote=False)
    unseen = "" if _is_plain(run[0]) else ' visibility="hidden"'
    style = _written(_declarations(run[0].style))
    return f'<tspan x="{places}" y="{float(run[0].y):.4g}" style="{style}"{unseen}>{text}</tspan>'


def _is_plain(letter: Letter) -> bool:
    return _family(letter) == FAMILY


def _family(letter: Letter) -> str:
    return _declarations(letter.style)["font-family"].strip("'")


def _outline(letter: Letter) -> str:
    size = float(_declarations(letter.style)["font-size"].removesuffix("px"))
    path = TextPath((0, 0), letter.text, size, FontProperties(family=_family(letter)))
    signs = {Path.MOVETO: "M", Path.LINETO: "L", Path.CURVE3: "Q", Path.CURVE4: "C", Path.CLOSEPOLY: "Z"}
    y = float(letter.y)
    drawn = " ".join(
        signs[code]
        + (
            ""
            if code == Path.CLOSEPOLY
            else " ".join(f"{letter.x + a:.3f} {y - b:.3f}" for a, b in points.reshape(-1, 2))
        )
        for points, code in path.iter_segments(simplify=False)
    )
    return f'<path d="{drawn}" style="stroke: none"/>'


def _declarations(style: str) -> dict[str, str]:
    return dict(re.findall(r"([\w-]+): ([^;]*)", style))


def _written(style: dict[str, str]) -> str:
    return "; ".join(f"{name}: {value}" for name, value in style.items() if name != "font-family")


@cache
def advance(text: str, *, bold: bool = False, oblique: bool = False) -> float:
    """Its width in ems, from where it begins to where another text would."""
    properties = FontProperties(
        family=FAMILY, weight="bold" if bold else "normal", style="oblique" if oblique else "normal"
    )
    font = get_font(findfont(properties))
    font.set_size(font.units_per_EM, 72)
    glyphs = [font.get_char_index(ord(letter)) for letter in text]
    wide = sum(font.load_char(ord(letter), flags=LoadFlags.NO_HINTING).linearHoriAdvance / 65536 for letter in text)
    kerned = sum(font.get_kerning(one, other, Kerning.UNSCALED) for one, other in pairwise(glyphs))
    return float(wide + kerned) / font.units_per_EM
