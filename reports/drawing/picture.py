"""A figure as the bytes of a file: SVG, PDF or PNG, the same bytes every time.

An SVG has its texts as texts, see `lettering`, and a name for those who do not see it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from html import escape
from io import BytesIO
from pathlib import Path

import matplotlib as mpl
from matplotlib.artist import Artist
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.patheffects import AbstractPathEffect, withStroke
from matplotlib.text import Text

from reports.drawing.lettering import STYLE, lettered
from reports.drawing.readout import plain_text
from reports.drawing.style import TITLE_PT, drawing
from sched_sim.errors import InputError
from sched_sim.files.writable import check_writable, write
from sched_sim.text import visible

METADATA: dict[str, dict[str, str | None]] = {
    "svg": {"Date": None, "Creator": None},
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
    "png": {"Software": None},
}
"""What each format would otherwise write about when and with what it was made."""


def image(figure: Figure, kind: str, name: str = "") -> bytes:
    """The figure as "svg", "pdf" or "png" (300 dots per inch). name: of an SVG; by default what stands above it."""
    buffer = BytesIO()
    with drawing():
        if kind == "svg":
            return _svg(figure, visible(name) or _own_name(figure)).encode()
        figure.savefig(buffer, format=kind, metadata=METADATA[kind])
    return buffer.getvalue()


def _svg(figure: Figure, name: str) -> str:
    buffer = BytesIO()
    with _outlined_texts(figure) as outlines, mpl.rc_context({"svg.fonttype": "none"}):
        figure.savefig(buffer, format="svg", metadata=METADATA["svg"])
    svg = lettered(buffer.getvalue().decode())
    svg = re.sub(r' id="(outlined_\d+)"', lambda group: f'{group[0]} style="{outlines[group[1]]}"', svg)
    svg = re.sub(r"<svg [^>]*", lambda svg: f'{svg[0]} role="img">\n <title>{escape(name)}</title', svg, count=1)
    return svg.replace("</style>", f" {STYLE}</style>", 1)


def _own_name(figure: Figure) -> str:
    """Its titles; without any, the names of its axes."""
    titles = [text.get_text() for text in figure.findobj(_is_title) if isinstance(text, Text)]
    names = [name for axes in figure.axes for name in (axes.get_ylabel(), axes.get_xlabel())]
    return "; ".join(filter(None, dict.fromkeys(map(plain_text, titles or names)))) or "figure"


def _is_title(text: Artist) -> bool:
    return isinstance(text, Text) and text.get_fontsize() == TITLE_PT and bool(text.get_text())


@contextmanager
def _outlined_texts(figure: Figure) -> Iterator[Mapping[str, str]]:
    """Inside it, texts with a rim have none, which would make them outlines, but names; the style by name."""
    rims = [(text, text.get_path_effects(), text.get_gid()) for text in figure.findobj(_has_rim)]
    styles = {}
    for number, (text, (effect,), _) in enumerate(rims):
        name = f"outlined_{number}"
        styles[name] = _rim(effect)
        text.set(path_effects=None, gid=name)
    try:
        yield styles
    finally:
        for text, effects, gid in rims:
            text.set(path_effects=effects, gid=gid)


def _has_rim(artist: Artist) -> bool:
    return isinstance(artist, Text) and [type(effect) for effect in artist.get_path_effects()] == [withStroke]


def _rim(effect: AbstractPathEffect) -> str:
    look = vars(effect)["_gc"]
    return (
        f"paint-order: stroke; stroke: {to_hex(look['foreground'])}; stroke-width: {look['linewidth']}; "
        "stroke-linejoin: round"
    )


def check_picture(path: Path, what: str = "picture") -> str:
    """The format that the suffix of `path` names. what: the option that the path is for. Raises InputError for another
    suffix, and for a path that cannot be written: to be called before the work that makes the picture."""
    kind = path.suffix.lower().removeprefix(".")
    if kind not in METADATA:
        raise InputError(
            f"{what} {str(path)!r}: suffix {path.suffix!r} is no picture format; end the name in .svg, .pdf or .png"
        )
    check_writable(path, what)
    return kind


def save(figure: Figure, path: str | Path, what: str = "picture") -> None:
    """Write the figure to `path`, in the format that its suffix names. what: the option that the path is for.

    Raises InputError for another suffix, for a path that cannot be written, and for arguments that are not these.
    """
    if not isinstance(figure, Figure):
        raise InputError(
            f"figure is a {type(figure).__name__}: give save(figure, path), with a figure such as gantt(...)"
        )
    if not isinstance(path, str | Path):
        raise InputError(f"path is a {type(path).__name__}: give save(figure, path), with the name of a file")
    path = Path(path)
    write(path, image(figure, check_picture(path, what)), what)
