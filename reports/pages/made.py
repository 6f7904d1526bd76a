"""When, where and how long a report was made: a file beside it, and the last line of its page.

A report itself is a pure function of its results; this is what differs from one making of it to the next.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from decimal import Decimal
from html import escape
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple

from reports.pages.numbers import duration
from sched_sim.errors import InputError
from sched_sim.files.toml_reader import read_toml
from sched_sim.files.toml_writer import toml_tables, toml_value

FILE = "made.toml"
DATA = (".csv", ".toml")
REMEDY = "delete it, or make the report anew"


class Made(NamedTuple):
    """date: such as 2026-11-29; machine: its processor's name; versions: of what made it, by name; seconds: it took,
    None where it was made from stored results."""

    date: str
    machine: str
    versions: Mapping[str, str]
    seconds: float | None

    @property
    def words(self) -> str:
        """When, where and in how long."""
        how = "from stored results" if self.seconds is None else f"in {duration(self.seconds)}"
        return f"made on {self.date} on {self.machine} {how}"


def made_here(seconds: float | None) -> Made:
    """By this process, today."""
    from studies.measurement.methods import machine, versions

    own = {"sched_sim": version("sched-sim"), **versions()}
    return Made(datetime.now(UTC).date().isoformat(), machine(), own, seconds if seconds is None else round(seconds, 1))


def made_of(folder: Path) -> Made | None:
    """What a report's folder says of it; None if it says nothing. Raises InputError if that cannot be read."""
    path = folder / FILE
    if not path.exists():
        return None
    about = read_toml(path, str(path), REMEDY)
    try:
        return Made(str(about["date"]), str(about["machine"]), about["versions"], _seconds(about, path))
    except KeyError as missing:
        raise InputError(f"{path} lacks {missing}: {REMEDY}") from None


def _seconds(about: Mapping[str, Any], path: Path) -> float | None:
    seconds = about.get("seconds")
    if seconds is None:
        return None
    if isinstance(seconds, bool) or not isinstance(seconds, int | Decimal) or not float(seconds) >= 0:
        raise InputError(f"{path}: seconds is {seconds!s}, which is no duration: {REMEDY}")
    return float(seconds)


def with_made(files: Mapping[str, bytes], made: Made | None) -> dict[str, bytes]:
    """The report's files as they are written: its page says when and where it was made, a file beside it too, and leads
    to all data."""
    if made is None:
        return dict(files)
    before, end, after = files["index.html"].decode().rpartition("</main>")
    further = [name for name in sorted(files) if name.endswith(DATA) and f'href="{name}"' not in before]
    return {**files, "index.html": f"{before}{_footer(made, further)}{end}{after}".encode(), FILE: _toml(made)}


def _footer(made: Made, further: Sequence[str]) -> str:
    """further: files of data that are not linked above."""
    versions = ", ".join(f"{name} {number}" for name, number in made.versions.items())
    said = escape(f"This page was {made.words} ({versions}): ")
    data = f". Data of tables, and what they are made from: {', '.join(map(_link, further))}" if further else ""
    return f'<footer class="files">{said}{_link(FILE)}{data}.</footer>\n'


def _link(name: str) -> str:
    return f'<a href="{name}">{name}</a>'


def _toml(made: Made) -> bytes:
    single = {"date": made.date, "machine": made.machine, "seconds": made.seconds}
    lines = [f"{key} = {toml_value(value)}" for key, value in single.items() if value is not None]
    return "\n".join([*lines, *toml_tables("versions", made.versions), ""]).encode()
