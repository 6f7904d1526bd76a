"""One hand for every picture: print sizes in millimetres, fonts, colours that survive a black-and-white copier."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from io import StringIO
from typing import NamedTuple

import matplotlib.style
from matplotlib.axes import Axes
from matplotlib.cbook import is_math_text
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties, findfont, get_font
from matplotlib.textpath import text_to_path

from sched_sim.errors import InputError
from sched_sim.schedule.labels import MEANINGS
from sched_sim.text import visible

WIDTH_MM = 170.0
"""Text width of a two-column journal page."""
NARROW_MM = 100.0
"""Of what is drawn for a phone, on which its letters are 8 pixels high."""

FONT_PT, SMALL_PT, TITLE_PT = 7.5, 7.0, 8.5
"""Nothing is set smaller than 7 points at print size."""

FAMILY = "DejaVu Sans"
"""Comes with matplotlib, so that every machine sets the same text."""

INK, GREY, PALE = "#1a1a1a", "#6b6b6b", "#d9d9d9"
RED = "#c00000"

SETTINGS = {
    "font.family": FAMILY,
    "font.size": FONT_PT,
    "mathtext.fontset": "dejavusans",
    "axes.titlesize": TITLE_PT,
    "axes.labelsize": FONT_PT,
    "axes.linewidth": 0.6,
    "axes.edgecolor": INK,
    "axes.axisbelow": True,
    "xtick.labelsize": SMALL_PT,
    "ytick.labelsize": SMALL_PT,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.major.size": 2.5,
    "ytick.major.size": 2.5,
    "legend.fontsize": SMALL_PT,
    "legend.frameon": False,
    "hatch.linewidth": 0.5,
    "svg.fonttype": "path",  # looks the same in every viewer; each text stands beside its glyphs as a comment
    "svg.hashsalt": "sched_sim",  # the ids in the file, and so its bytes, are the same every time
    "pdf.fonttype": 42,  # embedded TrueType: text that can be searched and copied
    "savefig.dpi": 300,
}


TALLEST_MM = 4000.0
"""Some 400 lines of a Gantt chart. PNG ends at 65,536 dots, which are 5.5 m."""
MOST_LETTERS = 500
"""A name's: more are never set, however narrow."""


EDGE_PT = 0.5
"""Of the outline of work."""


class Fill(NamedTuple):
    """How one kind of work is drawn and named; hatch and grey level alone tell the kinds of one row apart.

    ink: of hatch, label, and the outline by which a pale fill stands out from the page.
    """

    colour: str
    ink: str
    hatch: str
    meaning: str

    @property
    def edge_pt(self) -> float:
        """Of its outline: none where the ink is the page's."""
        return 0.0 if self.ink == "white" else EDGE_PT


FILLS = {
    label: Fill(*look, MEANINGS[label])
    for label, look in {
        "P": ("#b3d4ee", INK, ""),
        "U": ("#11538c", "white", ""),
        "G": ("#f4e9d8", "#9a6200", "\\\\\\\\"),
        "R": ("#dfe8f0", "#11538c", "\\\\\\\\"),
        "ST": ("#5b93c4", "white", ""),
        "CA": ("#e3edf5", "#11538c", "...."),
        "LA": ("#5b93c4", "white", "////"),
        "HRP": ("#b3d4ee", INK, ""),
        "HRU": ("#11538c", "white", ""),
        "LRP": ("#fbe3b5", "#9a6200", "////"),
        "LRG": ("#f4e9d8", "#9a6200", "\\\\\\\\"),
        "LRU": ("#bd7b05", INK, ""),
        "SU": ("#b3d4ee", INK, ""),
        "CG": ("#bd7b05", INK, ""),
        "OC": ("#f4e9d8", "#9a6200", "\\\\\\\\"),
        "IP": ("#b3d4ee", INK, ""),
        "RS": ("#bd7b05", INK, ""),
        "PR": ("#b3d4ee", INK, ""),
        "CO": ("#11538c", "white", ""),
        "RP": ("#dfe8f0", "#11538c", "\\\\\\\\"),
        "CU": ("#fbe3b5", "#9a6200", "////"),
        "switch": ("#1a1a1a", "white", ""),
    }.items()
}

TASK_FILLS = (
    Fill("#dcdcdc", GREY, "----", "user task"),
    Fill("#b7cfbc", "#2e5937", "\\\\\\\\", "user task"),
    Fill("#8f8f8f", INK, "", "user task"),
    Fill("#d5c3dc", "#5c3a6b", "++++", "user task"),
)
"""For the user's tasks, in turn."""


class Line(NamedTuple):
    """How one method, or one source of numbers, is drawn in a plot: colour, dashes and marker all differ."""

    colour: str
    dashes: str | tuple[int, tuple[float, ...]]
    marker: str
    size: float = 3.8


METHOD_LINES = {
    "standard": Line(GREY, (0, (1.0, 1.2)), "s"),
    "recalculate": Line("#8a3b73", (0, (5.0, 1.5, 1.0, 1.5)), "D"),
    "larsen": Line("#b8700a", (0, (4.0, 1.5)), "^"),
    "dual-rate": Line("#11538c", "-", "o"),
    "clone": Line("#2e7d4f", (0, (6.0, 1.5)), "v"),
    "clone-split": Line("#1d8a8a", (0, (2.5, 1.0)), "<"),
    "carried-gain": Line("#b3382f", (0, (6.0, 1.5, 1.0, 1.5, 1.0, 1.5)), "P"),
    "delayed-horizon": Line("#5c3a6b", (0, (9.0, 1.2, 1.5, 1.2)), ">"),
    "px4-predictor": Line("#c2477f", (0, (3.5, 1.0, 1.0, 1.0)), "p", 4.2),
    "augmentation": Line("#6b5b1e", (0, (8.0, 2.5)), "h", 4.2),
    "fuse-as-fresh": Line("#7d7d7d", (0, (1.0, 2.4)), "X", 4.2),
}

NOISE_LINES = {
    "sum": Line("#4a90c8", (0, (7.0, 1.5)), "d", 4.2),
    "euler": Line("#7b5fc4", (0, (3.0, 1.2, 3.0, 1.2, 1.0, 1.2)), "H", 4.2),
}
"""The dual-rate filter with an approximate process noise: "Dual-rate, Q′" and "Dual-rate, Q″"."""

SOURCES = {
    "printed": Line(INK, "-", "|", 6.0),
    "counted": Line("#11538c", (0, (7.0, 2.0)), "o"),
    "measured": Line("#bd7b05", (0, (2.0, 1.5)), "^"),
    "emulated": Line("#2e7d4f", (0, (5.0, 1.5, 1.0, 1.5)), "s"),
    "analysis": Line("#8a3b73", (0, (10.0, 2.0, 2.0, 2.0)), "D"),
}
"""Where a number comes from: the same in each figure. Printed: in the document that is regenerated."""

SOURCE_LINES = tuple(SOURCES.values())
"""For what else is told apart, in turn."""


@contextmanager
def drawing() -> Iterator[None]:
    """Inside it, matplotlib has this project's settings, whatever the user's own matplotlibrc says."""
    with matplotlib.style.context(["default", SETTINGS]):
        yield


def page(height_mm: float, width_mm: float = WIDTH_MM) -> Figure:
    """An empty figure of a size in millimetres. Raises InputError for one that nobody could look at or print."""
    if height_mm > TALLEST_MM:
        raise InputError(
            f"the picture would be {height_mm / 1000:.3g} m high: at most {TALLEST_MM / 1000:g} m are drawn; leave out "
            f"tasks, sensors or methods"
        )
    return Page(figsize=(width_mm / 25.4, height_mm / 25.4))


class Page(Figure):
    """A figure that a notebook shows as SVG."""

    def _repr_svg_(self) -> str:
        text = StringIO()
        with drawing():
            self.savefig(text, format="svg")
        return text.getvalue()


def axes_at(figure: Figure, left: float, top: float, width: float, height: float) -> Axes:
    """Axes placed in millimetres from the figure's left and top edge."""
    across, down = (inches * 25.4 for inches in figure.get_size_inches())
    return figure.add_axes((left / across, 1 - (top + height) / down, width / across, height / down))


@cache
def drawable(text: str) -> str:
    """Text of the user's as matplotlib takes it: `visible`, a dollar sign begins no formula, and what the font has no
    glyph for is an escape. No more than MOST_LETTERS of it."""
    seen = visible(text if len(text) <= MOST_LETTERS else text[:MOST_LETTERS] + "…")
    return "".join(letter if _has_glyph(letter) else ascii(letter)[1:-1] for letter in seen).replace("$", r"\$")


@cache
def _has_glyph(letter: str) -> bool:
    return all(
        get_font(findfont(FontProperties(family=FAMILY, weight=weight))).get_char_index(ord(letter))
        for weight in ("normal", "bold")
    )


@cache
def text_width_mm(text: str, points: float = FONT_PT, *, bold: bool = False) -> float:
    """The printed width of `text`, which may hold mathtext between dollar signs."""
    font = FontProperties(family=FAMILY, size=points, weight="bold" if bold else "normal")
    formula = is_math_text(text)
    shown = text if formula else text.replace(r"\$", "$")
    with drawing():
        width, _, _ = text_to_path.get_text_width_height_descent(shown, font, ismath=formula)
    return width / 72 * 25.4
