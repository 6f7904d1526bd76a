"""What a reader may ask of the curves of a figure: their names and values, and where they are on the page.

A curve that has a label is told, with its marker if it has one; a curve without is scenery. Where an axis has numbers
of another kind than its data, `fmt_xdata` or `fmt_ydata` of the axes, matplotlib's own, says them in words.
"""

from __future__ import annotations

import re
from typing import Any, Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from filters.arrays import FloatArray
from reports.drawing.dark import themed
from sched_sim.text import visible

MOST_POINTS = 100
"""Of a curve: of more, so many evenly among them."""
DIGITS = 4
NO_MARKER = ("", " ", "none")
INTERVALS = 32
"""Of an axis that is neither linear nor logarithmic."""


def readout(figure: Figure) -> dict[str, Any] | None:
    """As plain data; None if no curve of the figure has a label.

    "plots": "box" (left, top, width and height as shares of the figure), "title", "x" and "y" ("name", "scale", "ends";
    where the scale is neither "linear" nor "log", the values at evenly spaced "places"), "columns" of numbers, of texts
    where an axis has words, and "lines" ("name", "colour" of CSS, "x" and "y": which columns, "said": those of the
    words, "step": whether each value holds until the next).
    """
    plots = [_plot(figure, axes) for axes in figure.axes if any(map(_is_told, axes.lines))]
    return {"plots": plots} if plots else None


def _is_told(line: Line2D) -> bool:
    return not str(line.get_label()).startswith("_")


def _plot(figure: Figure, axes: Axes) -> dict[str, Any]:
    columns: list[list[float] | list[str]] = []
    lines = [line for line in (_line(axes, line, columns) for line in axes.lines if _is_told(line)) if line["name"]]
    box = axes.get_position()
    return {
        "box": [_short(share) for share in (box.x0, 1 - box.y1, box.width, box.height)],
        "title": plain_text(axes.get_title(loc="left")),
        "x": _axis(axes.xaxis, _name(figure, axes, "x")),
        "y": _axis(axes.yaxis, _name(figure, axes, "y")),
        "columns": columns,
        "lines": lines,
    }


def _name(figure: Figure, axes: Axes, which: Literal["x", "y"]) -> str:
    """Of an axis; where it stands at another plot only, that one: of the same column or row, of x at any."""

    def place(of: Axes) -> tuple[float, float]:
        box = of.get_position()
        return (box.x0, box.x1) if which == "x" else (box.y0, box.y1)

    told = [other for other in figure.axes if any(map(_is_told, other.lines))]
    beside = [other for other in told if np.allclose(place(other), place(axes))]
    others = (axes, *beside, *(told if which == "x" else ()))
    names = [(other.get_xlabel() if which == "x" else other.get_ylabel()) for other in others]
    return plain_text(next(filter(None, names), ""))


def _axis(axis: Axis, name: str) -> dict[str, Any]:
    low, high = axis.get_view_interval()
    told: dict[str, Any] = {
        "name": name,
        "scale": axis.get_scale(),
        "ends": [_short(low, 6), _short(high, 6)],
    }
    if axis.get_scale() not in ("linear", "log"):
        transform = axis.get_transform()
        first, last = transform.transform([low, high])
        values = transform.inverted().transform(np.linspace(first, last, INTERVALS + 1))
        told["places"] = [_short(value) for value in values]
    return told


def _line(axes: Axes, line: Line2D, columns: list[list[float] | list[str]]) -> dict[str, Any]:
    across, up = (np.asarray(values, dtype=np.float64) for values in line.get_data())
    is_level = not line.get_transform().contains_branch_seperately(axes.transData)[0]
    is_step = is_level or line.get_drawstyle() == "steps-post"
    across = np.array(sorted(axes.get_xlim())) if is_level else across
    kept = _thinned(np.flatnonzero(_is_inside(axes, across, up)), up, is_step=is_step)
    told: dict[str, Any] = {
        "name": plain_text(str(line.get_label())) if len(kept) else "",
        "colour": themed(to_hex(line.get_color())),
        "x": _number_of(columns, [_short(value) for value in across[kept]]),
        "y": _number_of(columns, [_short(value) for value in up[kept]]),
    }
    said = {
        which: _number_of(columns, [plain_text(say(float(value))) for value in values[kept]])
        for which, values, say in (("x", across, axes.fmt_xdata), ("y", up, axes.fmt_ydata))
        if say is not None
    }
    marker = str(line.get_marker())
    shape = {} if marker.lower() in NO_MARKER else {"marker": marker}
    return {**told, **shape, **({"step": 1} if is_step else {}), **({"said": said} if said else {})}


def _is_inside(axes: Axes, across: FloatArray, up: FloatArray) -> Any:
    """Which points are on the page, of those that are numbers."""
    (left, right), (low, high) = sorted(axes.get_xlim()), sorted(axes.get_ylim())
    with np.errstate(invalid="ignore"):
        return (left <= across) & (across <= right) & (low <= up) & (up <= high)


def _thinned(kept: Any, up: FloatArray, *, is_step: bool) -> Any:
    """Of a step curve, where it steps and its end; of another, `MOST_POINTS` at the most."""
    if is_step and len(kept):
        steps = np.flatnonzero(np.diff(up[kept], prepend=np.nan) != 0)
        return kept[np.unique(np.append(steps, len(kept) - 1))]
    return kept[np.unique(np.linspace(0, len(kept) - 1, min(len(kept), MOST_POINTS)).round().astype(int))]


def _number_of(columns: list[list[float] | list[str]], values: list[float] | list[str]) -> int:
    """Of a column, a new one if there is none of these values."""
    if values not in columns:
        columns.append(values)
    return columns.index(values)


def _short(value: float, digits: int = DIGITS) -> float:
    """To so many digits; whole numbers without a point, which is shorter in JSON."""
    rounded = float(f"{value:.{digits}g}")
    return int(rounded) if rounded.is_integer() and abs(rounded) < 1e15 else rounded


SIGNS = {r"\Phi ": "Φ", r"\Phi": "Φ", r"\Delta ": "Δ", r"\Delta": "Δ", r"\,": " ", r"\to ": "→"}
FORMULA = re.compile(r"(?<!\\)\$(.*?)(?<!\\)\$")


def plain_text(text: str) -> str:
    r"""A label of a figure without its mathtext: "$k+4$" as "k + 4", "$\sqrt{q}$" as "√(q)"."""
    said = FORMULA.sub(lambda formula: _plain_formula(formula[1]), text)
    return visible(" ".join(said.replace(r"\$", "$").split()))


def _plain_formula(formula: str) -> str:
    for sign, letter in SIGNS.items():
        formula = formula.replace(sign, letter)
    formula = formula.replace("''", "″").replace("'", "′")
    formula = formula.replace("^-", "⁻").replace("^+", "⁺").replace("-", "\N{MINUS SIGN}")
    formula = re.sub(r"\\sqrt\{([^}]*)\}", r"√(\1)", formula)
    formula = re.sub(r"_\{([^}]*)\}", r"(\1)", formula)
    formula = re.sub(r"\\[a-z]+\{([^}]*)\}", r"\1", formula)
    formula = re.sub(r"(?<=\w)([+\N{MINUS SIGN}→])(?=\w)", r" \1 ", formula)
    return re.sub(r"[{}]", "", formula).replace("^3", "³").replace("^2", "²")
