"""A figure as the bytes of a file: SVG, PDF or PNG, the same bytes every time."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

from matplotlib.figure import Figure

from reports.drawing.style import drawing
from sched_sim.errors import InputError
from sched_sim.files.writable import check_writable, write

METADATA: dict[str, dict[str, str | None]] = {
    "svg": {"Date": None, "Creator": None},
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
    "png": {"Software": None},
}
"""What each format would otherwise write about when and with what it was made."""


def image(figure: Figure, kind: str) -> bytes:
    """The figure as "svg", "pdf" or "png" (300 dots per inch)."""
    buffer = BytesIO()
    with drawing():
        figure.savefig(buffer, format=kind, metadata=METADATA[kind])
    return buffer.getvalue()


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
